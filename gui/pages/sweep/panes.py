"""What the panes of the page are made of: plots whose points are points of the sweep."""

from collections.abc import Iterable
from dataclasses import replace
from typing import TypedDict

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from fitting.arrays import Array
from gui.files.short_name import short_name
from gui.pages.sweep.points import Group, Index
from gui.plots import Axis, Plot
from gui.plots.curve import Symbol
from gui.style.theme import Role, current_theme

CHOSEN = "point looked at"
_MARGIN = 0.04
"""Beside a band, as a share of it."""
_RING_PX = 17.0


class _Look(TypedDict):
    role: Role
    symbol: Symbol
    hollow: bool


_BESIDE: tuple[_Look, ...] = (
    {"role": "third", "symbol": "d", "hollow": True},
    {"role": "fourth", "symbol": "t1", "hollow": True},
    {"role": "second", "symbol": "s", "hollow": True},
    {"role": "third", "symbol": "star", "hollow": True},
)
_HOLLOW = {"d": "\u25c7", "t1": "\u25b3", "s": "\u25a1", "star": "\u2606"}


def beside_look(number: int) -> _Look:
    """How sweeps of other files are drawn, by their number from 0."""
    return _BESIDE[number % len(_BESIDE)]


def beside_key(names: Iterable[str]) -> list[tuple[str, Role, str]]:
    """Of a key: name, colour and sign of each."""
    looks = ((name, beside_look(k)) for k, name in enumerate(names))
    return [(name, look["role"], _HOLLOW[look["symbol"]]) for name, look in looks]


class Pointed(Plot):
    """A plot that knows which points of the sweep it shows.

    Signals
    -------
    chosen : int
        A point was clicked: its number among the sweep's points.
    """

    chosen = Signal(int)

    def __init__(self, x: Axis, y: Axis, parent: QWidget | None = None, *, legend: bool = True) -> None:
        super().__init__(x, y, parent, legend=legend)
        self._index: dict[str, Index] = {}
        self._framed: tuple[tuple[float, float] | None, bool] | None = None
        self.picked.connect(self._picked)

    def show_points(self, group: Group, x: Array, y: Array) -> None:
        """A group under its name. Shape (points,), as of its index."""
        self._index[group.name] = group.index
        self.points(group.name, x, y, group.role, symbol=group.symbol, hollow=group.hollow)

    def frame(self, band_hz: tuple[float, float] | None) -> None:
        """Bring a whole band into view, points there or not; None: all there is. Once for each."""
        wanted = band_hz, self.x.log
        if wanted == self._framed:
            return
        self._framed = wanted
        self.enableAutoRange()
        if band_hz is not None:
            low, high = np.log10(band_hz) if self.x.log else band_hz
            self.setXRange(low, high, padding=_MARGIN)

    def point_out(self, x: float | None, y: float | None) -> None:
        """A ring around the point looked at; None: nowhere."""
        if x is None or y is None:
            self.keep(name for name in self.names if name != CHOSEN)
            return
        at = np.array([x]), np.array([y])
        self.points(CHOSEN, *at, "text", size=_RING_PX, listed=False, hollow=True)

    def _picked(self, name: str, number: int) -> None:
        if name in self._index:
            self.chosen.emit(int(self._index[name][number]))


SIGNS = {
    "o": "\u25cf",
    "s": "\u25a0",
    "d": "\u25c6",
    "star": "\u2605",
    "t1": "\u25b2",
    "t": "\u25bd",
    "x": "\u2716",
    "+": "\u271a",
}
"""Of symbols, as letters."""


class Key(QLabel):
    """A legend in one line, for plots too low to hold one."""

    def show_key(self, entries: Iterable[tuple[str, Role, str]]) -> None:
        """Name, colour and sign of each."""
        theme = current_theme()
        said = []
        for name, role, sign in entries:
            color = theme.color(role).name()
            words = _unbroken(short_name(name))
            said.append(f"<span style='color:{color}'>{_unbroken(sign)}</span>&nbsp;{words}")
        self.setText("&ensp; ".join(said))
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.setWordWrap(True)

    def show_groups(self, groups: Iterable[Group]) -> None:
        """Show a sign and a name for each group, as the plots draw it."""
        self.show_key((g.name, g.role, SIGNS[g.symbol]) for g in groups)


def _unbroken(words: str) -> str:
    """A hyphen too: a dashed line's sign has some."""
    return words.replace(" ", "&nbsp;").replace("-", "\u2011")


def keyed(key: Key, plot: Plot) -> QWidget:
    """A plot with its key above it."""
    both = QWidget()
    column = QVBoxLayout(both)
    column.setContentsMargins(0, 0, 0, 0)
    column.setSpacing(0)
    column.addWidget(key)
    column.addWidget(plot, 1)
    return both


def hide_foot(plot: Plot) -> None:
    """Without numbers along x: a plot below has the same."""
    plot.getAxis("bottom").setStyle(showValues=False)
    plot.show_axes(replace(plot.x, titled=False), plot.y)


def span(plot: Plot, x: Array) -> None:
    """The whole of a trace in view along x. Shape (points,).

    Not left to the plot: linked plots that draw only what is in view would move each other for ever.
    """
    if x.size:
        plot.setXRange(float(x[0]), float(x[-1]), padding=0.02)


def align(*plots: Plot) -> None:
    """Plots above each other begin at the same place, whatever their numbers are."""
    metrics = plots[0].fontMetrics()
    width = metrics.horizontalAdvance("-000.0") + 2 * metrics.height()
    for plot in plots:
        plot.getAxis("left").setWidth(width)


def channel(name: str, role: Role, second: bool, index: Index) -> Group:
    """Points of one channel: two of them in a plot differ in colour and symbol."""
    return Group(name, role, "s" if second else "o", index)
