"""How each candidate of a diagnosis stands: found, not told from others, or other; what its law is with."""

from collections.abc import Mapping, Sequence
from itertools import product
from math import isnan
from typing import Literal

from fitting.diagnosis.verdict.kin import UNLISTED
from fitting.diagnosis.verdict.names import split
from fitting.diagnosis.verdict.shares import holding
from instrument.facts.diagnosis import STAGES, DiagnosisResult, StageFitted, StageName

Standing = Literal["found", "equal", "none", "other"]
_LEAST_WHOLE = 1e-300
"""Where the listed ones have nothing left to share."""


def standing(name: str, found: DiagnosisResult) -> Standing:
    """Of a candidate by its name."""
    groups, together = found.equivalent, set(split(name))
    if not together:
        return "none"
    if groups and together == set(groups):
        return "equal" if none_is_likelier(found) else "found"
    if not groups or found.verdict != "ambiguous":
        return "other"
    named = set[str]().union(*groups.values())
    if not together <= named:
        # Likely as it may be, the verdict does not name it.
        return "other"
    if name == UNLISTED or len(groups) == len(together) == 1:
        return "equal"
    group = _group(found)
    if group is None:
        # Nothing was weighed: one stands for another, effect by effect.
        return "equal" if any(together == set(names) for names in product(*groups.values())) else "other"
    return "equal" if name in group else "other"


def none_is_likelier(found: DiagnosisResult) -> bool:
    """Whether the likeliest is no effect, and what is named is only not excluded."""
    return not found.by_hand and none_leads(
        found.equivalent, {c.name: c.probability for c in found.candidates}
    )


def none_leads(equivalent: Mapping[str, Sequence[str]], probability: Mapping[str, float]) -> bool:
    """Whether no effect is likeliest: by names with what is not told from each, and candidates' shares."""
    if not any("none" in group for group in equivalent.values()):
        return False
    shares = {frozenset(split(name)): p for name, p in probability.items()}
    return shares.get(frozenset(), 0.0) > shares.get(frozenset(equivalent), 0.0)


def law_words(found: DiagnosisResult) -> str:
    """What the law is with, after "with": the likeliest, and what cannot be told from it.

    Empty where no effect is at issue.
    """
    if none_is_likelier(found):
        return fit_words(found)
    several = len(found.equivalent) > 1
    each = [_or_others(name, group) for name, group in found.equivalent.items()]
    return " and ".join(f"({one})" if several and " or " in one else one for one in each)


def fit_words(found: DiagnosisResult) -> str:
    """What the fit after is with, whose residual and response are shown: of a group the likeliest.

    Empty where no effect is at issue.
    """
    effects = " and ".join(found.equivalent)
    return f"no effect, or {effects}" if none_is_likelier(found) else effects


def is_one_of_several(found: DiagnosisResult) -> bool:
    """Whether the law that stands is over explanations that the data cannot tell apart."""
    return any(set(group) - {name} for name, group in found.equivalent.items())


def stage_before(found: DiagnosisResult) -> StageFitted | None:
    """The fit before the effects, where the law that stands is another one for them."""
    if not found.equivalent or (none_is_likelier(found) and found.before.law == found.after.law):
        return None
    return found.before


def stages_apart(found: DiagnosisResult) -> tuple[StageName, ...]:
    """The fits that differ: before and after what is accepted, or before alone where that is nothing."""
    return STAGES if stage_before(found) is not None else STAGES[:1]


def laws_apart(found: DiagnosisResult) -> tuple[StageName, ...]:
    """The fits whose laws differ; the law that stands alone where nothing is accepted: that of the group."""
    return STAGES if stage_before(found) is not None else STAGES[1:]


def one_fit_words(found: DiagnosisResult) -> str:
    """Why there is one fit where nothing comes after it."""
    return "no effect is the likeliest" if found.equivalent else "no effect is accepted"


def _or_others(name: str, group: Sequence[str]) -> str:
    others = [n for n in group if n != name]
    if len(others) > 1 and "none" in others:
        return f"{name}, no effect or {len(others) - 1} more"
    if len(others) > 1:
        return f"{name} or {len(others)} others"
    said = {"none": "no effect", UNLISTED: "another of its kind"}
    return " or ".join([name, *(said.get(n, n) for n in others)])


def _group(found: DiagnosisResult) -> set[str] | None:
    """The likeliest that hold 95 %; None without probabilities."""
    if found.by_hand or any(isnan(c.probability) for c in found.candidates):
        return None
    listed = [c for c in found.candidates if c.name != UNLISTED]
    ranked, whole = sorted(listed, key=lambda c: -c.probability), sum(c.probability for c in listed)
    return {c.name for c in ranked[: holding([c.probability / max(whole, _LEAST_WHOLE) for c in ranked])]}
