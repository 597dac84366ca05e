"""How each candidate of a diagnosis stands: found, not told from it, or other."""

from itertools import product
from math import isnan
from typing import Literal

from fitting.diagnosis.verdict import holding
from instrument.facts.diagnosis import DiagnosisResult

Standing = Literal["found", "equal", "none", "other"]


def standing(name: str, found: DiagnosisResult) -> Standing:
    """Of a candidate by its name; two effects have theirs joined by " + "."""
    if name == "none":
        return "none"
    groups = found.equivalent
    together = set(name.split(" + "))
    if groups and together == set(groups):
        return "found"
    if not groups or found.verdict != "ambiguous":
        return "other"
    group = _group(found)
    if group is None:
        # Nothing was weighed: one stands for another, effect by effect.
        return "equal" if any(together == set(names) for names in product(*groups.values())) else "other"
    return "equal" if name in group else "other"


def _group(found: DiagnosisResult) -> set[str] | None:
    """The likeliest that hold 95 %; None without probabilities."""
    if found.by_hand or any(isnan(c.probability) for c in found.candidates):
        return None
    ranked = sorted(found.candidates, key=lambda c: -c.probability)
    return {c.name for c in ranked[: holding([c.probability for c in ranked])]}
