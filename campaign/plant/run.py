"""The campaign on the published plate: cases diagnosed in processes, a line kept of each.

It goes on after a kill: `python -m campaign plant FOLDER`.
"""

from collections.abc import Callable, Sequence
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

from campaign.plant.cases import KINDS, NONE, PAIR, Case, draw
from campaign.plant.outcome import Outcome, Said, line_of, outcome_of, said_of
from campaign.plant.severities import OF_THE_CHANNELS_ALONE
from campaign.plant.tables import summary
from campaign.plant.visible import visible_chi2
from campaign.run import Job, keep_summary, run_campaign, why_not
from instrument.progress import Progress, quiet

ROTATION = (*KINDS, NONE, NONE, PAIR, PAIR)
"""Kinds of successive cases: each effect once, clean ones and pairs three times."""


def judge(job: Job, taken_out: bool) -> dict[str, Any]:
    """Draw, diagnose, compare. `taken_out`: once more without a single effect that leaves a residual.

    A diagnosis that raises is an outcome without an answer; the next run tries it again.
    """
    # Loaded here: cases and scores are of use without it.
    diagnose = import_module("instrument.finding.diagnosis").diagnose
    case = draw(job.kind, job.seed)
    said: Said | None = None
    without: Said | None = None
    error = ""
    try:
        said = _diagnosed(diagnose, case, frozenset())
        if taken_out and job.kind not in (NONE, PAIR, *OF_THE_CHANNELS_ALONE):
            without = _diagnosed(diagnose, case, frozenset(case.truth.names))
    except Exception as raised:
        error = why_not(raised)
    outcome = Outcome(
        kind=job.kind,
        seed=job.seed,
        truth=case.truth.names,
        hammer=case.hammer is not None,
        levels=len({float(level) for level in case.sweep.commanded_m_s2}),
        visible_chi2=visible_chi2(case),
        said=said,
        without=without,
        error=error,
    )
    return line_of(outcome)


def _diagnosed(diagnose: Callable[..., Any], case: Case, without: frozenset[str]) -> Said:
    from instrument.models.files import File

    found = diagnose([File(case.sweep, case.specimen)], hammer=case.hammer, without=without)
    return said_of(case, found.result, found.seconds, found.setup_seconds)


def run_plant(
    jobs: Sequence[Job],
    folder: Path,
    *,
    taken_out: bool = True,
    workers: int = 2,
    progress: Progress = quiet,
) -> list[dict[str, Any]]:
    """Lines of all jobs, with those an earlier run left. Raises `BadInput`, `StoppedByUser`."""
    judged_by = partial(judge, taken_out=taken_out)
    options = {"taken_out": taken_out}
    return run_campaign(jobs, folder, judged_by, options, workers=workers, progress=progress)


def write_plant_summary(lines: Sequence[dict[str, Any]], folder: Path) -> str:
    """The score as Markdown, kept in the folder."""
    return keep_summary(summary([outcome_of(line) for line in lines]), folder)
