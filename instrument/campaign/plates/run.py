"""A campaign on many plates: cases identified and diagnosed in processes, a line kept of each.

It goes on after a kill: `viscorig campaign plates FOLDER`, or `run_plates` with functions of one's own.
"""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from instrument.campaign.plates.answers import Answer, Band, judged, outcome_from
from instrument.campaign.plates.cases import KINDS, NONE, PAIR, PlateCase, draw_case
from instrument.campaign.plates.hidden import ON_REQUEST
from instrument.campaign.plates.tables import summary
from instrument.campaign.run import Job, keep_summary, run_campaign
from instrument.progress import Progress, quiet

ROTATION = (*(kind for kind in KINDS if kind not in ON_REQUEST), *(NONE,) * 8, *(PAIR,) * 4)
"""Kinds of successive cases: each effect once, clean ones nine times, pairs five."""

Identify = Callable[[PlateCase], Band]
Diagnose = Callable[[PlateCase], Answer]
Visible = Callable[[PlateCase], float | None]


def judge_plate(
    job: Job,
    exact: bool,
    identify: Identify | None,
    diagnose: Diagnose | None,
    visible: Visible | None,
    least: float | None = None,
    one_piece: bool = False,
) -> dict[str, Any]:
    """Draw, identify, diagnose, compare. What raises leaves no answer and is tried again."""
    case = draw_case(job.kind, job.seed, exact, one_piece=one_piece)
    return judged(case, identify, diagnose, visible, least)


def run_plates(
    jobs: Sequence[Job],
    folder: Path,
    *,
    exact: bool = False,
    identify: Identify | None = None,
    diagnose: Diagnose | None = None,
    visible: Visible | None = None,
    least: float | None = None,
    one_piece: bool = False,
    workers: int = 2,
    progress: Progress = quiet,
) -> list[dict[str, Any]]:
    """Lines of all jobs, with those an earlier run left. Raises `BadInput`, `StoppedByUser`.

    `visible` says how plainly what is hidden shows; where that is less than `least`, nothing else is asked.
    All three go to other processes: functions of a module. `one_piece`: sweeps of one segment each.
    """
    judged_by = partial(
        judge_plate,
        exact=exact,
        identify=identify,
        diagnose=diagnose,
        visible=visible,
        least=least,
        one_piece=one_piece,
    )
    options = {
        "exact": exact,
        "least": least,
        "one_piece": one_piece,
        "by": [f.__name__ for f in (identify, diagnose) if f is not None],
    }
    return run_campaign(jobs, folder, judged_by, options, workers=workers, progress=progress)


def write_plate_summary(lines: Sequence[dict[str, Any]], folder: Path) -> str:
    """The score as Markdown, kept in the folder."""
    return keep_summary(summary([outcome_from(line) for line in lines]), folder)
