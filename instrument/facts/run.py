"""The results of `viscorig run`, `hammer`, `sweep` and `demo`, and of `viscorig replay`."""

from instrument.facts.damping import DampingResult
from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.identification import IdentificationResult
from instrument.facts.result import Result


class RunResult(Result):
    """A finished run; None for what was not measured or not found."""

    session: str
    """Path of its file."""
    points: int
    damping: DampingResult | None = None
    identify: IdentificationResult | None = None
    diagnose: DiagnosisResult | None = None
    report: str | None = None
    """Path of its page; of `demo` alone."""


class ReplayResult(Result):
    """A recorded session computed again."""

    identify: IdentificationResult | None = None
    diagnose: DiagnosisResult | None = None
    equal_to_recorded: bool
    derived_events: int
    """Computed again."""
    differences: tuple[str, ...] = ()
    """The first few."""
