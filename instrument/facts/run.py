"""The results of `viscorig run`, `hammer`, `sweep` and `demo`, and of `viscorig replay`."""

from instrument.facts.damping import DampingResult
from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.follow_up import FollowedUp
from instrument.facts.identification import IdentificationResult
from instrument.facts.result import Result
from instrument.facts.session_result import SessionResult


class RunResult(Result):
    """A finished run; None for what was not measured or not found."""

    session: str
    """Path of its file."""
    points: int
    damping: DampingResult | None = None
    identify: IdentificationResult | None = None
    """Before the diagnosis, where there is one."""
    diagnose: DiagnosisResult | None = None
    """The last one, of everything that was measured."""
    followed: tuple[FollowedUp, ...] = ()
    """What was measured because a diagnosis before it ended in a group."""
    result: SessionResult | None = None
    """The law to sign; None without a sweep."""
    report: str | None = None
    """Path of its page; of `demo` alone."""


class ReplayResult(Result):
    """A recorded session computed again."""

    identify: IdentificationResult | None = None
    """Before the diagnosis, where there is one."""
    diagnose: DiagnosisResult | None = None
    result: SessionResult | None = None
    """The law to sign; None without a sweep."""
    equal_to_recorded: bool
    derived_events: int
    """Computed again."""
    differences: tuple[str, ...] = ()
    """The first few differences from the recording."""
    words: tuple[str, ...] = ()
    """The first few places that say the same in other words: no difference."""
