"""An axis whose numbers do not lie upon each other where it is logarithmic."""

from collections.abc import Sequence

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QRectF

_NAMED = (1, 2, 5)
_MOST_DECADES = 3
"""With lines between the decades."""
_WITHOUT_POWER = 0.9e-4, 0.9e4
_NARROW = 0.6
"""Decades below which lines stand evenly in the value: one of 1, 2 and 5 in view is no scale."""
_EVEN = 6
"""Lines then, at most."""
_SLACK = 1e-6
"""Of a step: a line at the very edge is one."""
_STEPS = (1.0, 2.0, 5.0, 10.0)


class LogAxis(pg.AxisItem):  # type: ignore[misc]
    """Of a decade only 1, 2 and 5 have their number; of much less than one evenly spaced values have."""

    _said = ""
    """Beside the axis."""
    _is_narrow = False
    beyond_px = 0.0
    """How far a number may stand beyond either end of an axis below: further, it is not said."""

    def boundingRect(self) -> QRectF:
        """The library lets none stand beyond an axis with a grid."""
        rect: QRectF = super().boundingRect()
        return rect.adjusted(-self.beyond_px, 0.0, self.beyond_px, 0.0)

    def _updateLabel(self) -> None:
        """Laid out only where it says something else: the library asks forty times while a plot is made."""
        said = self.labelString()
        if said != self._said:
            self._said = said
            super()._updateLabel()
        else:
            self.picture = None
            self.update()

    def logTickValues(
        self, minVal: float, maxVal: float, size: float, stdTicks: Sequence[tuple[float, Sequence[float]]]
    ) -> list[tuple[float | None, Sequence[float]]]:
        """Over many decades only whole ones have a line: more would be grey, and slow to draw."""
        self._is_narrow = maxVal - minVal < _NARROW
        if self._is_narrow:
            return [(None, _even(10.0**minVal, 10.0**maxVal))]
        ticks: list[tuple[float | None, Sequence[float]]] = super().logTickValues(
            minVal, maxVal, size, stdTicks
        )
        if maxVal - minVal <= _MOST_DECADES:
            return ticks
        return [(spacing, values) for spacing, values in ticks if spacing is not None]

    def logTickStrings(self, values: Sequence[float], scale: float, spacing: float) -> list[str]:
        """Empty where a line goes without a number."""
        if self._is_narrow:
            return [f"{float(f'{scale * 10**value:.6g}'):g}" for value in values]
        powers = super().logTickStrings(values, scale, spacing)
        said = [_plain(scale * 10**value) or power for value, power in zip(values, powers, strict=True)]
        return [text if _digit(value) in _NAMED else "" for text, value in zip(said, values, strict=True)]


def _even(low: float, high: float) -> list[float]:
    """Logarithms of round values between two others, as far apart as each other."""
    about = (high - low) / _EVEN
    power = 10.0 ** np.floor(np.log10(about))
    step = next(s * power for s in _STEPS if s * power >= about * (1 - 1e-9))
    numbers = np.arange(np.ceil(low / step - _SLACK), np.floor(high / step + _SLACK) + 1)
    return np.log10(numbers * step).tolist()


def _plain(value: float) -> str:
    """Without a power of ten where people would write none; empty otherwise."""
    low, high = _WITHOUT_POWER
    return f"{float(f'{value:.1g}'):g}" if low <= value < high else ""


def _digit(exponent: float) -> int:
    return round(10 ** (exponent - np.floor(exponent + 1e-9)))
