"""A campaign on many plates: cases identified and diagnosed in processes, a line kept of each.

It goes on after a kill: `python -m campaign plates FOLDER`, or `run_plates` with functions of one's own.
"""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

from campaign.plates.answers import outcome_from
from campaign.plates.asked import Asked, run_asked
from campaign.plates.cases import KINDS, NONE, PAIR, PlateCase, draw_case
from campaign.plates.hidden import ON_REQUEST
from campaign.plates.tables import summary
from campaign.run import Job, keep_summary
from instrument.progress import Progress, quiet

ROTATION = (*(kind for kind in KINDS if kind not in ON_REQUEST), *(NONE,) * 8, *(PAIR,) * 4)
"""Kinds of successive cases: each effect once, clean ones nine times, pairs five."""


def run_plates(
    jobs: Sequence[Job],
    folder: Path,
    asked: Asked[PlateCase],
    *,
    exact: bool = False,
    one_piece: bool = False,
    workers: int = 2,
    progress: Progress = quiet,
) -> list[dict[str, Any]]:
    """Lines of all jobs, with those an earlier run left. Raises `BadInput`, `StoppedByUser`.

    `one_piece`: sweeps of one segment each.
    """
    draw = partial(draw_case, exact=exact, one_piece=one_piece)
    options = {"exact": exact, "one_piece": one_piece}
    return run_asked(draw, asked, jobs, folder, options, workers=workers, progress=progress)


def write_plate_summary(lines: Sequence[dict[str, Any]], folder: Path) -> str:
    """The score as Markdown, kept in the folder."""
    return keep_summary(summary([outcome_from(line) for line in lines]), folder)
