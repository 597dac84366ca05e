"""What is asked of every case of a campaign on solids, in processes, a line kept of each."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Generic, TypeVar

from campaign.plates.answers import Answer, Band, JudgedCase, line_of, outcome_of
from campaign.run import Job, run_campaign, why_not
from instrument.progress import Progress

_Case = TypeVar("_Case", bound=JudgedCase)


@dataclass(frozen=True)
class Asked(Generic[_Case]):
    """Functions of a module: they go to other processes."""

    identify: Callable[[_Case], Band] | None = None
    diagnose: Callable[[_Case], Answer] | None = None
    visible: Callable[[_Case], float | None] | None = None
    """How plainly what is hidden shows."""
    least: float | None = None
    """Where it shows by less nothing else is asked."""

    @property
    def options(self) -> dict[str, Any]:
        """The options by which outcomes differ."""
        return {
            "least": self.least,
            "by": [f.__name__ for f in (self.identify, self.diagnose) if f is not None],
        }

    def line(self, case: _Case) -> dict[str, Any]:
        """A case identified, diagnosed, compared. What raises leaves no answer and is tried again."""
        band: Band | None = None
        said: Answer | None = None
        error, shows = "", None
        try:
            shows = self.visible(case) if self.visible is not None else None
            if self.least is None or shows is None or shows >= self.least:
                band = self.identify(case) if self.identify is not None else None
                said = self.diagnose(case) if self.diagnose is not None else None
        except Exception as raised:
            error = why_not(raised)
        return line_of(outcome_of(case, band, said, error, shows))


def run_asked(
    draw: Callable[[str, int], _Case],
    asked: Asked[_Case],
    jobs: Sequence[Job],
    folder: Path,
    options: Mapping[str, Any],
    *,
    workers: int,
    progress: Progress,
) -> list[dict[str, Any]]:
    """Lines of all jobs, with those an earlier run left. Raises `BadInput`, `StoppedByUser`.

    `draw` makes a case of kind and seed, and goes to other processes too; `options` are those that it has.
    """
    judged_by = partial(_judged, draw, asked)
    return run_campaign(
        jobs, folder, judged_by, {**options, **asked.options}, workers=workers, progress=progress
    )


def _judged(draw: Callable[[str, int], _Case], asked: Asked[_Case], job: Job) -> dict[str, Any]:
    return asked.line(draw(job.kind, job.seed))
