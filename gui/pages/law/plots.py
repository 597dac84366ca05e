"""Storage modulus and loss factor over frequency, side by side."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QSplitter, QVBoxLayout, QWidget

from fitting.arrays import Array
from fitting.numerics.chances import Z_95
from gui.pages.law.curve import LawCurve
from gui.plots import Axis, Plot
from gui.plots.corner import emptiest_corner
from gui.plots.legend_lines import break_names
from gui.style.theme import Role

_BANDS = {"± 1 standard error": 1.0, "95 % (± 1.96 standard errors)": Z_95}


@dataclass(frozen=True)
class LawLine:
    """A law to draw."""

    name: str
    curve: LawCurve
    role: Role
    dashed: bool = False
    width: float = 2.0


class LawPlots(QWidget):
    """Two plots with the same lines. The shaded bands are as wide as a person chooses."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        # Both have the same lines: the legend of one says them, where its curves leave room.
        self.storage = Plot(Axis("Frequency", "Hz"), Axis("Storage modulus G'", "MPa"), legend=False)
        self.loss = Plot(Axis("Frequency", "Hz"), Axis("Loss factor η"))
        self.loss.setXLink(self.storage)
        self._lines: tuple[LawLine, ...] = ()
        self.bands = QComboBox()
        for name, factor in _BANDS.items():
            self.bands.addItem(name, factor)
        self.bands.setToolTip(
            "Width of the shaded bands: noise, model error and tolerances, as the fit states them"
        )
        self.bands.currentIndexChanged.connect(self._draw)
        self.above = QHBoxLayout()
        self.above.addStretch(1)
        self.above.addWidget(QLabel("shaded"))
        self.above.addWidget(self.bands)
        self.loss.getViewBox().sigResized.connect(self._place_legend)
        both = QSplitter(Qt.Orientation.Horizontal)
        for plot in (self.storage, self.loss):
            both.addWidget(plot)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(self.above)
        column.addWidget(both, 1)

    def show_lines(self, lines: Sequence[LawLine], resonances_hz: Sequence[float] = ()) -> None:
        """Instead of those there were; `resonances_hz` are marked."""
        self._lines = tuple(lines)
        self._draw()
        for plot in (self.storage, self.loss):
            plot.mark(resonances_hz)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the lines that are shown."""
        return tuple(line.name for line in self._lines)

    def _draw(self) -> None:
        factor = float(self.bands.currentData())
        shown: set[str] = set()
        for line in self._lines:
            shown |= self._draw_line(line, factor)
        for plot in (self.storage, self.loss):
            plot.keep(shown)
        self._place_legend()

    def _place_legend(self) -> None:
        legend, room = self.loss.getPlotItem().legend, self.loss.getViewBox().width()
        across, up = emptiest_corner(self._losses(float(self.bands.currentData())))
        break_names(legend, room - 2 * abs(across), self.loss.fontMetrics())
        # Where one word has too little room, its end is cut and not the sign before it.
        legend.setOffset((abs(across) if legend.width() + abs(across) > room else across, up))

    def _losses(self, factor: float) -> list[tuple[Array, Array]]:
        """What is drawn of them: the lines, and the edges of their bands where they have some."""
        curves = [line.curve for line in self._lines]
        sides = (-factor, 0.0, factor)
        return [(c.frequency_hz, c.loss + k * np.nan_to_num(c.loss_error)) for c in curves for k in sides]

    def _draw_line(self, line: LawLine, factor: float) -> set[str]:
        c, band = line.curve, f"{line.name}, band"
        banded = bool(np.isfinite(c.storage_error_mpa).all()) and len(c.frequency_hz) > 0
        for plot, value, error in (
            (self.storage, c.storage_mpa, c.storage_error_mpa),
            (self.loss, c.loss, c.loss_error),
        ):
            if banded:
                plot.band(band, c.frequency_hz, value - factor * error, value + factor * error, line.role)
            plot.line(line.name, c.frequency_hz, value, line.role, width=line.width, dashed=line.dashed)
        return {line.name, band} if banded else {line.name}
