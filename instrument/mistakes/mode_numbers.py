"""Tables whose mode numbers are all one too low or too high: no core takes a mode that far.

Told from the stated specimen alone, before any fit: a beam's mode lies between where the softest and the
stiffest core would have it, and these ranges hardly overlap.
"""

from collections.abc import Sequence

import numpy as np

from fitting.arrays import Array
from fitting.errors import OutsideModel
from fitting.laws.constant import ConstantModulus
from fitting.mode_tables.build import member_of
from fitting.mode_tables.table import ModalTable
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen

_SOFTEST_PA, _STIFFEST_PA = 1e3, 1e10
"""Of a core, far beyond gels and glasses."""
_LOSSLESS = 1e-6
_BEYOND, _WITHIN = 0.15, 0.07
"""Of ln f: how far outside its range a mode has to lie, as no clamp that yields and no wrong length takes it;
and how far all may lie outside under the other number. Choices."""


def numbers_doubt(tables: Sequence[ModalTable], specimens: Sequence[AnySpecimen]) -> str:
    """What to ask of tables, each with its specimen; empty where their numbers may be right.

    Of plates nothing is asked: their modes lie too close, and cost too much.
    """
    of = {id(s): s for s in specimens if s.core is not None and not isinstance(s, PlateSpecimen)}
    for key, specimen in of.items():
        its = [t for t, s in zip(tables, specimens, strict=True) if id(s) == key]
        number = np.concatenate([t.mode for t in its]).astype(int)
        found = _doubt(number, np.concatenate([t.frequency_hz for t in its]), specimen)
        if found:
            return found
    return ""


def _doubt(number: Array, frequency_hz: Array, specimen: AnySpecimen) -> str:
    """Of all modes of one specimen, shape (modes,) each."""
    most = int(number.max()) + 1
    try:
        lowest, highest = (_ln_f(specimen, most, G) for G in (_SOFTEST_PA, _STIFFEST_PA))
    except OutsideModel:
        return ""
    ln_f = np.log(frequency_hz)

    def off(by: int) -> Array:
        """How far each lies outside the range of the mode with another number, in ln f."""
        at = number + by - 1
        return np.maximum(np.maximum(lowest[at] - ln_f, ln_f - highest[at]), 0.0)

    worst = int(np.argmax(off(0)))
    if off(0)[worst] <= _BEYOND:
        return ""
    by = next((k for k in (1, -1) if number.min() + k >= 1 and off(k).max() <= _WITHIN), None)
    if by is None:
        return ""
    n = int(number[worst])
    low, high = np.exp([lowest[n - 1], highest[n - 1]])
    return (
        f"mode numbers seem shifted by one: no core brings mode {n} to {frequency_hz[worst]:.4g} Hz "
        f"({low:.4g} to {high:.4g} Hz), with all numbers one {'higher' if by > 0 else 'lower'} a core may: "
        "is it so?"
    )


def _ln_f(specimen: AnySpecimen, most: int, G_pa: float) -> Array:
    """Of the modes up to a number, under one core. Shape (most,).

    Raises `OutsideModel` where it has fewer.
    """
    number = np.arange(1.0, most + 1)
    member = member_of(ModalTable(number, np.ones(most), np.ones(most)), specimen)
    return member.logs(ConstantModulus(G_pa, _LOSSLESS), np.zeros(len(member.stated))).real
