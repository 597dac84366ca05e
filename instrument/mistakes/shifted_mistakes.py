"""Tables of several temperatures that fit far better if they are read otherwise, each under a law of its own.

One shifted law is not asked: where losses are half of what they are at some temperatures, all others bend it.
"""

from collections.abc import Callable, Sequence

import numpy as np

from fitting.arrays import Array
from fitting.errors import FittingError
from fitting.mode_tables.table import ModalTable
from instrument.mistakes.modal_look import modal_doubt
from instrument.mistakes.modal_mistakes import BETTER, FITS, GROSS, in_other_units

_FITS_ALONE = 2.0
"""Chi-square per number up to which one temperature follows its own law. A choice."""

Left = Callable[[Sequence[ModalTable]], Array]
"""Chi-square that each table by itself leaves. Shape (tables,)."""


def doubt_at_temperatures(
    tables: Sequence[ModalTable],
    temperatures_c: Sequence[float],
    chi2: Array,
    predicted_hz: Array,
    left_by: Left,
) -> str:
    """What to ask of tables, one a temperature, that as they are leave `chi2`; empty where nothing is better.

    `predicted_hz` by a law of each. Shapes (tables,) and (all modes,).
    """
    if far := modal_doubt(np.concatenate([t.frequency_hz for t in tables]), predicted_hz):
        return far
    numbers = np.array([2.0 * len(t.mode) for t in tables])
    if not chi2.sum() > BETTER:
        return ""
    gross = bool(chi2.sum() > GROSS * numbers.sum())
    asked = []
    for words, other, part in in_other_units(tables, gross=gross):
        try:
            left = left_by(other)
        except FittingError:
            continue
        whole = float(left.sum())
        if chi2.sum() - whole > BETTER and whole < min(part * chi2.sum(), FITS * numbers.sum()):
            asked.append((whole, words, float(chi2.sum())))
            continue
        # One among many may come nearer by chance: it has to fit better than all of them together.
        better = (chi2 - left > BETTER) & (left < np.minimum(part * chi2, _FITS_ALONE * numbers))
        if better.any():
            at = ", ".join(
                f"{T:g}" for T in sorted({temperatures_c[k] for k in np.flatnonzero(better).tolist()})
            )
            rest = float(np.where(better, left, chi2).sum())
            asked.append((rest, f"at {at} degC {words}", float(chi2.sum())))
    if not asked:
        return ""
    rest, words, before = min(asked)
    return (
        f"a law of each temperature follows the modes far better (chi-square {rest:.3g}, not {before:.3g}) "
        f"if {words}: is it so?"
    )
