"""What a run measured after its diagnoses: the group before, the measurement, the verdict after."""

from collections.abc import Sequence

from instrument.facts.follow_up import FollowedUp, FollowUp
from instrument.results.diagnosis_words import verdict_line
from instrument.results.next_words import apart_words
from instrument.stream.derived import DiagnosisFound
from instrument.stream.event import Event
from instrument.stream.raw import FollowUpDecided, FollowUpProposed


def followed_of(events: Sequence[Event]) -> tuple[FollowedUp, ...]:
    """From a session's events, in order."""
    verdict, proposed = "", None
    found: list[FollowedUp] = []
    for event in events:
        match event:
            case DiagnosisFound():
                verdict = _verdict(event)
                if found and not found[-1].verdict_after:
                    found[-1] = found[-1].but(verdict_after=verdict)
            case FollowUpProposed():
                proposed = event
            case FollowUpDecided() if event.agreed and proposed is not None:
                found.append(
                    FollowedUp(
                        measured=proposed.offers[event.offer], agreed_by=event.by, verdict_before=verdict
                    )
                )
    return tuple(found)


def followed_lines(followed: Sequence[FollowedUp]) -> list[str]:
    """For people: three lines each."""
    lines = []
    for k, one in enumerate(followed, start=1):
        lines += [
            f"before: {one.verdict_before}",
            f"measured, {apart_words(one.measured.between)} ({k} of {len(followed)}): "
            f"{measured_words(one.measured)}",
            f"after: {one.verdict_after or 'not diagnosed'}",
        ]
    return lines


def measured_words(one: FollowUp) -> str:
    """What was done, in a line."""
    steps = f"; {len(one.frequencies_hz)} steps" if one.frequencies_hz else ""
    return f"{one.todo.rstrip('.')}{steps}"


def _verdict(event: DiagnosisFound) -> str:
    if event.result is None:
        return f"no diagnosis: {event.message}"
    return verdict_line(event.result).removeprefix("verdict: ")
