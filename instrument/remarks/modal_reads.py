"""How the numbers of a table of modes were read, where that matters to the law."""

from collections.abc import Sequence

import numpy as np

from fitting.digits import two_digits
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.mode_tables.member import Member

_MATTERS = 0.5
"""By how many standard deviations of its own another reading moves a number, from which on it is said."""


def remark_on_reading(members: Sequence[Member], laws: Sequence[CoreLaw]) -> tuple[str, ...]:
    """By how much peaks and half-power widths differ from the model's modes, where nobody says what was read.

    `laws` are the members', one each. Empty where every table says so, or where it hardly matters.
    """
    moved_f, moved_eta, matters = list[float](), list[float](), False
    for m, law in zip(members, laws, strict=True):
        if m.table.read is not None:
            continue
        try:
            f, eta = m.reads_otherwise(law, np.zeros(len(m.stated)), "half-power")
        except OutsideModel:
            continue
        std_f, std_eta = m.table.relative_std
        matters |= bool(max(np.abs(f / std_f).max(), np.abs(eta / std_eta).max()) > _MATTERS)
        moved_f += f.tolist()
        moved_eta += eta.tolist()
    if not matters:
        return ()
    exact = any(m.specimen.exact for m in members)
    own = "the model's own, the core as it is at each frequency ('viscorig modes')"
    taken = (
        f"as {own}"
        if exact
        else f"half way between {own}, and peaks and half-power widths, and either left open"
    )
    return (
        f"how the modes were read is not said: taken {taken}; peaks and half-power widths of an FRF are "
        f"{_over(moved_f)} % in frequency and {_over(moved_eta)} % in loss factor beside the model's: say "
        "which they are by a line '# read: half-power' in the table, '# read: poles' (a curve fit) or "
        "'# read: model'",
    )


def _over(values: Sequence[float]) -> str:
    low, high = (f"{'+' if v > 0 else ''}{two_digits(100 * v)}" for v in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"
