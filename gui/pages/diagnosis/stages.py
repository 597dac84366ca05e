"""The fit without and with the effects, in rows. No Qt."""

from dataclasses import dataclass
from typing import Any

from fitting.identification.result import REFERENCE_FREQUENCIES_HZ
from gui.pages.law.curve import LawCurve

Facts = dict[str, Any]


@dataclass(frozen=True)
class Compared:
    """One measure of the fit, before and after; `noise` is what noise alone would give."""

    what: str
    unit: str
    before: float | None
    after: float | None
    noise: float | None = None
    held_out: bool = False


def compared(facts: Facts) -> list[Compared]:
    """Held-out data first: they say what a fit is worth."""
    before, after = facts["before"], facts["after"]
    rows = [
        Compared(
            f"segment {b['segment']}, predicted from the others",
            "% rms",
            b["rms_percent"],
            a["rms_percent"],
            b["noise_percent"],
            held_out=True,
        )
        for b, a in zip(before["held_out"], after["held_out"], strict=False)
    ]
    one_by_one = "leave_one_out_rms_percent"
    if before[one_by_one] is not None:
        what = "each point, predicted from the others"
        rows.append(Compared(what, "% rms", before[one_by_one], after[one_by_one], held_out=True))
    pairs = (
        ("difference in amplitude, all points fitted", "% rms", "rms_percent"),
        ("largest difference in amplitude", "%", "max_percent"),
    )
    rows += [Compared(what, unit, before[key], after[key]) for what, unit, key in pairs]
    chi2 = "chi2_per_dof"
    rows.append(Compared("chi² per degree of freedom", "", before[chi2], after[chi2], 1.0))
    return rows


def laws(facts: Facts) -> tuple[LawCurve, LawCurve]:
    """Before and after."""
    return LawCurve.of(facts["before"]["law"]), LawCurve.of(facts["after"]["law"])


def references_hz(facts: Facts) -> list[float]:
    """Where both laws are stated in numbers."""
    curves = laws(facts)
    return [f for f in REFERENCE_FREQUENCIES_HZ if all(c.at(f) is not None for c in curves)]
