"""What is to be borne in mind beside a verdict."""

from collections.abc import Sequence

from fitting.diagnosis.checks.stretches import words_of_stretches
from fitting.diagnosis.inference.freer_law import freedom_of
from fitting.diagnosis.search.catalogue_search import ScoredFit, Search
from fitting.diagnosis.verdict.judgement import Judgement
from fitting.diagnosis.verdict.refusing import against_by_checks
from fitting.diagnosis.verdict.result import Verdict
from fitting.identification.adjusted import Adjusted
from fitting.identification.doubt import BIASED, Doubt
from fitting.identification.result import pulled_too_far

_NO_TIME, _NO_SECONDS = "the points carry no time", "the points' times are all one or no seconds"
_NOT_CONSIDERED = (
    "that the specimen warmed or cooled during the sweep was not considered, expected a column time_s"
)
NO_DRIFT = f"{_NO_TIME}: {_NOT_CONSIDERED}"
"""Of sweeps too long for an even pace to be supposed."""
NO_SECONDS = f"{_NO_SECONDS}: {_NOT_CONSIDERED} of seconds"
"""The same where there is a column of times."""


def at_its_limit(accepted: ScoredFit) -> tuple[Doubt, ...]:
    """Where the size of one of its effects ends at the limit of what is plausible."""
    if not accepted.too_large:
        return ()
    what = f"{accepted.too_large} ends at the limit of what is plausible"
    return (Doubt(f"{what}: there is more of it, or it is something else, and {BIASED}"),)


def moved_beside(verdict: Verdict, numbers: Sequence[Adjusted]) -> tuple[Doubt, ...]:
    """Where what is named, or nothing, holds only by stated numbers that lie far outside their tolerances."""
    said = "" if verdict == "unknown" else pulled_too_far(numbers)
    return (Doubt(f"{said}: they are stated wrongly or more is amiss, and {BIASED}"),) if said else ()


def warnings_of(search: Search, judgement: Judgement) -> tuple[str, ...]:
    """Of a rare material, an implausible size, missing times, and what someone accepted against the data.

    And of what is held out, where that is no segments.
    """
    said, problem = list[str](), search.problem
    accepted = judgement.accepted
    if accepted is not None and accepted.names:
        times = freedom_of(accepted.fitted.law) / freedom_of(search.stated)
        if times > 1:
            said.append(
                f"beside {' and '.join(accepted.names)} the law may bend {times:g} times as far from its "
                "formula as materials usually do, as the data ask: the core follows another law, or more is "
                "amiss"
            )
        said += at_its_limit(accepted)
        said += [e.caution for e in accepted.fitted.effects if e.caution]
    names = {n for group in judgement.equivalent.values() for n in group}
    if not problem.points.timed:
        stated = problem.sweep.time_s is not None
        lacking = problem.files_without_time
        of = f"file{'s' * (len(lacking) > 1)} {', '.join(map(str, lacking))}: " if lacking else ""
        if any(e.name in names for e in search.effects if e.needs_time):
            why = _NO_SECONDS if stated else _NO_TIME
            said.append(f"{of}{why}: the drift assumes an even sweep upwards in frequency")
        elif not judgement.by_hand and any(e.needs_time for e in search.objected):
            said.append(of + (NO_SECONDS if stated else NO_DRIFT))
    by_hand = judgement.group[0][0] if judgement.by_hand else None
    if by_hand is not None and (why := against_by_checks(by_hand)):
        what = f"{' and '.join(by_hand.names)}, your word," if by_hand.names else "no effect"
        said.append(Doubt(f"{what} {why}: something else is missing, and {BIASED}"))
    return (*said, *words_of_stretches(problem.sweep, search.work.parts))
