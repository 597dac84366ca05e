"""A campaign on beams: cases identified and diagnosed in processes, a line kept of each.

It goes on after a kill: `python -m campaign beams FOLDER`, or `run_beams` with functions of one's own.
"""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from campaign.beams.cases import KINDS, NONE, BeamCase, draw_case
from campaign.beams.hidden import ON_REQUEST
from campaign.plates.answers import PlateOutcome, outcome_from
from campaign.plates.asked import Asked, run_asked
from campaign.plates.score import named
from campaign.plates.tables import summary
from campaign.run import Job, keep_summary
from campaign.tables import markdown
from instrument.progress import Progress, quiet

ROTATION = (*(kind for kind in KINDS if kind not in ON_REQUEST), *(NONE,) * 5)
"""Kinds of successive cases: each effect once, clean ones six times."""


def run_beams(
    jobs: Sequence[Job],
    folder: Path,
    asked: Asked[BeamCase],
    *,
    exact: bool = False,
    workers: int = 2,
    progress: Progress = quiet,
) -> list[dict[str, Any]]:
    """Lines of all jobs, with those an earlier run left. Raises `BadInput`, `StoppedByUser`."""
    draw = partial(draw_case, exact=exact)
    options = {"of": "beams", "exact": exact}
    return run_asked(draw, asked, jobs, folder, options, workers=workers, progress=progress)


def write_beam_summary(lines: Sequence[dict[str, Any]], folder: Path) -> str:
    """The score as Markdown, kept in the folder."""
    outcomes = [outcome_from(line) for line in lines]
    return keep_summary(f"{summary(outcomes, 'beams')}\n## Each\n\n{_each(outcomes)}\n", folder)


def _each(outcomes: Sequence[PlateOutcome]) -> str:
    """Every case with its largest error over standard error, and what is left of chi-square."""
    rows = []
    for o in outcomes:
        if o.said is None:
            continue
        chi2 = "" if o.said.chi2_after is None else f"{o.said.chi2_after:.2f}"
        said = " + ".join(named(o)) or o.said.verdict
        shows = "" if o.visible_chi2 is None else f"{o.visible_chi2:.0f}"
        rows.append([o.kind, str(o.seed), o.plate, shows, said, *_pulls(o), chi2, f"{o.said.seconds:.0f}"])
    columns = ["hidden", "seed", "beam", "trace", "said", "pulls of G'", "of eta", "chi-square after", "s"]
    return markdown(columns, rows)


def _pulls(o: PlateOutcome) -> tuple[str, str]:
    """Signed, at each resonance: error over standard error."""
    band = o.said.after if o.said is not None else None
    if band is None:
        return "", ""
    pairs = (
        (o.storage_pa, band.storage_pa, band.storage_error_pa),
        (o.loss, band.loss, band.loss_error),
    )
    storage, loss = ((np.array(found) - np.array(true)) / np.array(error) for true, found, error in pairs)
    return " ".join(f"{p:+.1f}" for p in storage), " ".join(f"{p:+.1f}" for p in loss)
