"""What is to be said of laws that were compared, a sentence each."""

from collections.abc import Sequence

from fitting.digits import band, two_digits
from instrument.interchange.questions import kelvin_doubt
from instrument.material.alike import alike_in, stated_unlike
from instrument.material.comparing import Comparison
from instrument.material.found_law import MaterialLaw

_WARMER = 1.0
"""K between two laws, from which it is said: a damping polymer is another one."""


def remarks_on_law(law: MaterialLaw, *, beside_spread: bool) -> list[str]:
    """How far one of them is to be believed; `beside_spread` where a spread between all is told as well."""
    said, beside = [], ", and is not in the spread" if beside_spread else ""
    if law.verdict == "unknown":
        said.append(f"verdict unknown: this law may be biased beyond what is known of it{beside}")
    elif law.is_doubted:
        said.append(f"its fit says that this law may be biased beyond its band{beside}")
    elif law.verdict == "ambiguous":
        said.append(f"verdict ambiguous ({law.found}): its band spans the laws of all of these")
    if not law.converged:
        said.append("its fit has not come to its end: values and their errors are provisional")
    if law.hardly_known:
        said.append(law.hardly_known)
    if doubt := kelvin_doubt(law.temperature_c):
        said.append(doubt)
    return said


def remarks_on_pair(c: Comparison) -> list[str]:
    """Of two of them: temperatures apart, where they differ, or what difference would have been seen."""
    said = []
    if (warm := _unlike_temperatures(c)) is not None:
        said.append(f"of {warm[0]:.4g} and {warm[1]:.4g} degC, which alone makes laws differ")
    for what, z in (("G'", c.storage_z), ("eta", c.loss_factor_z)):
        ranges = ", ".join(band(low, high) for low, high in c.where(z))
        if ranges:
            said.append(f"{what} differs beyond 1.96 joint standard errors at {ranges}")
    if c.differs is False and (seen := c.would_be_seen) is not None:
        at, storage, eta = seen
        said.append(
            f"not told apart; at {at:.3g} Hz G' would be seen to differ by "
            f"{two_digits(100 * storage)} %, eta by {two_digits(eta)}"
        )
    return said


def remarks_on_one_specimen(
    laws: Sequence[MaterialLaw], found: Sequence[Comparison], *, said: bool
) -> list[str]:
    """Whether the files bear it out, where it was `said`; else what saying so would tell."""
    if not said:
        if any(c.differs is False and len(alike_in((c.a, c.b))) for c in found):
            return ["Of one specimen, measured again? --same-specimen then tells smaller differences apart."]
        return []
    if unlike := stated_unlike(laws):
        return [
            f"said to be of one specimen, but the files state {' and '.join(unlike)} as different numbers: "
            "their laws differ by that already"
        ]
    if any(law.stated for law in laws) and not all(c.alike for c in found):
        return [
            "what one specimen's stated numbers make alike is not known of all of these laws: where it is "
            "not, the comparison is cautious"
        ]
    return []


def _unlike_temperatures(c: Comparison) -> tuple[float, float] | None:
    a, b = c.a.temperature_c, c.b.temperature_c
    return (a, b) if a is not None and b is not None and abs(a - b) > _WARMER else None
