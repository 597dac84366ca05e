"""What a diagnosis leaves open: what would tell its explanations apart, and what may be there unseen."""

from instrument.facts.diagnosis import DiagnosisResult
from instrument.finding.diagnosis import Diagnosed
from instrument.planning.follow_up import Possible, with_follow_ups
from instrument.planning.unseen import with_unseen


def with_open_questions(
    result: DiagnosisResult, diagnosed: Diagnosed, possible: Possible | None = None
) -> DiagnosisResult:
    """The result of a diagnosis with both: what every command, run and notebook says."""
    return with_unseen(with_follow_ups(result, diagnosed, possible), diagnosed)
