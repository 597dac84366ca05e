"""An axis whose numbers do not lie upon each other where it is logarithmic."""

from collections.abc import Sequence

import numpy as np
import pyqtgraph as pg

_NAMED = (1, 2, 5)
_MOST_DECADES = 3
"""With lines between the decades."""
_WITHOUT_POWER = 0.9e-4, 0.9e4


class LogAxis(pg.AxisItem):  # type: ignore[misc]
    """Of a decade only 1, 2 and 5 have their number."""

    _said = ""
    """Beside the axis."""

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
        ticks: list[tuple[float | None, Sequence[float]]] = super().logTickValues(
            minVal, maxVal, size, stdTicks
        )
        if maxVal - minVal <= _MOST_DECADES:
            return ticks
        return [(spacing, values) for spacing, values in ticks if spacing is not None]

    def logTickStrings(self, values: Sequence[float], scale: float, spacing: float) -> list[str]:
        """Empty where a line goes without a number."""
        powers = super().logTickStrings(values, scale, spacing)
        said = [_plain(scale * 10**value) or power for value, power in zip(values, powers, strict=True)]
        return [text if _digit(value) in _NAMED else "" for text, value in zip(said, values, strict=True)]


def _plain(value: float) -> str:
    """Without a power of ten where people would write none; empty otherwise."""
    low, high = _WITHOUT_POWER
    return f"{float(f'{value:.1g}'):g}" if low <= value < high else ""


def _digit(exponent: float) -> int:
    return round(10 ** (exponent - np.floor(exponent + 1e-9)))
