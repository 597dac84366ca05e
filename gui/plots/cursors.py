"""Cursors of a plot: two with the difference between them, and one with its harmonics."""

from collections.abc import Mapping
from typing import Any, Literal

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QMenu

from fitting.arrays import Array
from gui.style.theme import Theme, current_theme

Kind = Literal["", "delta", "harmonic"]
_HARMONICS = 10
_PLACES = (0.35, 0.65)
"""Of the view's width, where two cursors begin."""
_FIRST = 0.1
"""Of the view's width, where a fundamental begins."""


class Cursors(QObject):
    """Chosen in the plot's menu, dragged with the mouse; their numbers stand at the plot's foot."""

    def __init__(self, plot: Any) -> None:
        super().__init__(plot)
        self._plot = plot
        self.kind: Kind = ""
        self._lines: list[pg.InfiniteLine] = []
        self._text: pg.TextItem | None = None
        plot.getViewBox().fills.append(self._fill)

    def _fill(self, menu: QMenu) -> None:
        for said, slot in (
            ("Two cursors", self._choose_delta),
            ("Cursor with harmonics", self._choose_harmonic),
            ("No cursor", self._choose_none),
        ):
            menu.addAction(said).triggered.connect(slot)

    @property
    def text(self) -> str:
        """As it stands in the plot; empty without a cursor."""
        return str(self._text.toPlainText()) if self._text is not None and self.kind else ""

    @property
    def x(self) -> list[float]:
        """Where the lines are, in the plot's own unit."""
        log = self._plot.x.log
        return [float(10 ** line.value() if log else line.value()) for line in self._lines]

    def choose(self, kind: Kind) -> None:
        """Other ones, or none."""
        for line in self._lines:
            self._plot.removeItem(line)
        self._lines, self.kind = [], kind
        if not kind:
            if self._text is not None:
                self._text.hide()
            return
        self._shown()
        low, high = self._plot.viewRange()[0]
        if kind == "delta":
            for share in _PLACES:
                self._add(low + share * (high - low), movable=True)
        else:
            first = low + _FIRST * (high - low)
            at = first if self._plot.x.log or first > 0 else _FIRST * max(high, 0.0)
            for number in range(1, _HARMONICS + 1):
                self._add(at, movable=number == 1, label=str(number) if number > 1 else "")
        self.paint(current_theme())
        self._moved()

    def move(self, number: int, x: float) -> None:
        """One of the lines that can be dragged to a place in the plot's own unit."""
        self._lines[number].setValue(np.log10(x) if self._plot.x.log else x)

    def forget(self) -> None:
        """The axes are others now."""
        self.choose("")

    def paint(self, theme: Theme) -> None:
        """In these colours."""
        if self._text is not None:
            self._text.setColor(theme.text)
        for line in self._lines:
            style = Qt.PenStyle.SolidLine if line.movable else Qt.PenStyle.DotLine
            line.setPen(pg.mkPen(theme.accent, style=style))
            if hasattr(line, "label"):
                line.label.setColor(theme.faint)

    def _add(self, at: float, *, movable: bool, label: str = "") -> None:
        options = {"label": label, "labelOpts": {"position": 0.95}} if label else {}
        line = pg.InfiniteLine(at, angle=90, movable=movable, **options)
        line.sigPositionChanged.connect(self._moved)
        self._plot.addItem(line, ignoreBounds=True)
        self._lines.append(line)

    def _moved(self) -> None:
        if self.kind == "harmonic":
            self._follow()
        text = self._shown()
        text.setPos(6, self._plot.getViewBox().height() - 2)
        text.setText(self._words())

    def _shown(self) -> pg.TextItem:
        """Where the numbers stand; made for the first cursor."""
        if self._text is None:
            self._text = pg.TextItem(anchor=(0, 1))
            self._text.setParentItem(self._plot.getViewBox())
        self._text.show()
        return self._text

    def _follow(self) -> None:
        """Multiples of the first one."""
        first = self.x[0]
        for number, line in enumerate(self._lines[1:], start=2):
            at = number * first
            shown = (np.log10(at) if at > 0 else 0.0) if self._plot.x.log else at
            line.blockSignals(True)
            line.setValue(shown)
            line.blockSignals(False)

    def _words(self) -> str:
        unit = self._plot.x.unit
        if self.kind == "harmonic":
            return f"1: {self.x[0]:.6g} {unit}, with harmonics to {len(self._lines)}".strip()
        if len(self._lines) < 2:
            return ""
        a, b = self.x
        said = [f"{a:.6g} and {b:.6g} {unit}, \u0394 {b - a:.6g} {unit}"]
        name, y = _values_at(self._plot.curves, (a, b))
        if name:
            ratio = f", ratio {y[1] / y[0]:.4g}" if y[0] else ""
            change = f"\u0394 {y[1] - y[0]:.5g} {self._plot.y.unit}".strip()
            said.append(f"{name}: {y[0]:.5g} and {y[1]:.5g}, {change}{ratio}")
        return "\n".join(said)

    def _choose_delta(self) -> None:
        self.choose("delta")

    def _choose_harmonic(self) -> None:
        self.choose("harmonic")

    def _choose_none(self) -> None:
        self.choose("")


def _values_at(curves: Mapping[str, tuple[Array, Array]], x: tuple[float, float]) -> tuple[str, Array]:
    """Of the curve with most points that reaches over both places; an empty name where there is none."""
    best: tuple[str, Array] = "", np.zeros(0)
    most = 1
    for name, (f, y) in curves.items():
        known = np.isfinite(f) & np.isfinite(y)
        if known.sum() > most and f[known].min() <= min(x) and max(x) <= f[known].max():
            order = np.argsort(f[known], kind="stable")
            best, most = (name, np.interp(x, f[known][order], y[known][order])), int(known.sum())
    return best
