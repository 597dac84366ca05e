"""The plot every page uses: axes with units, legend, readout, export, colours of the theme.

Curves are named; the same name again replaces what it shows. So a page calls `line`, `points` and `band` with
all it has at every refresh, and never keeps a curve.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import Any, Literal

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QWidget

from fitting.arrays import Array
from gui.plots.axis import Axis
from gui.plots.cursors import Cursors
from gui.plots.export import add_export_menu
from gui.plots.log_axis import LogAxis
from gui.plots.readout import Readout
from gui.plots.view import View
from gui.theme import Role, current_theme

Symbol = Literal["o", "s", "t", "t1", "d", "+", "x", "star"]

_SMOOTH = 5000
"""Curves of more points are drawn without smoothed edges, which would cost several times as much."""
_BAND_ALPHA = 0.25
_LEGEND_ALPHA = 0.6
"""Of the ground behind the legend."""
_BELOW = -1
"""What is faint lies below everything else, whenever it came."""
_RING_WIDTH = 2.0
_TITLE_ROOM_PX = 44
"""Of a plot's side that its axis does not have: the other axis, and the edge."""
_EDGE_PX = 12
"""The edge alone, where the other axis has no numbers."""
_LABEL_AT = 0.08  # of a vertical line's height


@dataclass
class _Curve:
    """A curve and how it is drawn, so that it can be drawn in other colours."""

    items: tuple[Any, ...]
    role: Role
    kind: Literal["line", "points", "band", "trace"]
    columns: dict[str, Array]
    symbol: Symbol = "o"
    width: float = 1.5
    dashed: bool = False
    size: float = 8.0
    hollow: bool = False
    look: tuple[Any, ...] = ()
    """As it was last styled."""


@dataclass
class _Marks:
    """Vertical lines of one meaning."""

    role: Role
    lines: Sequence[pg.InfiniteLine]
    wanted: tuple[Any, ...]
    """What they were asked for with: the same again changes nothing."""


_NO_MARKS = _Marks("faint", (), ())


class Plot(pg.PlotWidget):  # type: ignore[misc]
    """One plot.

    Signals
    -------
    picked : (str, int)
        A point was clicked: the name of its curve and its number in it.
    """

    picked = Signal(str, int)

    def __init__(self, x: Axis, y: Axis, parent: QWidget | None = None, *, legend: bool = True) -> None:
        super().__init__(parent, axisItems={at: LogAxis(at) for at in ("bottom", "left")}, viewBox=View())
        self.x, self.y = x, y
        self._curves: dict[str, _Curve] = {}
        self._marks: dict[str, _Marks] = {}
        self._legend = self.addLegend(offset=(-8, 8)) if legend else None
        self.setLogMode(x.log, y.log)
        for side in ("bottom", "left", "top", "right"):
            self.getAxis(side).enableAutoSIPrefix(False)
        self.showGrid(x=True, y=True, alpha=0.25)
        self.setMinimumSize(120, 80)
        self._readout, self.cursors = Readout(self), Cursors(self)
        add_export_menu(self)
        self._paint()

    # What is shown

    def line(
        self, name: str, x: Array, y: Array, role: Role = "model", *, width: float = 1.5, dashed: bool = False
    ) -> None:
        """A line through points in order of x."""
        curve = self._curve(name, "line", role)
        curve.width, curve.dashed = width, dashed
        self._set(curve, x, y)

    def trace(self, name: str, x: Array, y: Array, role: Role = "data", *, listed: bool = True) -> None:
        """A line through many points evenly spaced in x: drawn by its extremes, two a pixel.

        One of many alike need not be `listed` in the legend.
        """
        curve = self._curve(name, "trace", role, listed=listed)
        curve.width = 1.0
        self._set(curve, x, y)

    def points(
        self,
        name: str,
        x: Array,
        y: Array,
        role: Role = "data",
        *,
        symbol: Symbol = "o",
        size: float = 8.0,
        listed: bool = True,
        hollow: bool = False,
    ) -> None:
        """Points that can be clicked (`picked`)."""
        curve = self._curve(name, "points", role, listed=listed)
        curve.symbol, curve.size, curve.hollow = symbol, size, hollow
        self._set(curve, x, y)

    def band(self, name: str, x: Array, low: Array, high: Array, role: Role = "model") -> None:
        """The area between two lines."""
        curve = self._curve(name, "band", role)
        for item, edge in zip(curve.items, (low, high), strict=False):
            item.setData(np.asarray(x, dtype=float), np.asarray(edge, dtype=float))
        curve.columns = {"": np.asarray(x), f"{name} low": np.asarray(low), f"{name} high": np.asarray(high)}
        self._style(curve)

    def mark(
        self,
        at: Iterable[float],
        role: Role = "faint",
        *,
        name: str = "",
        labels: Sequence[str] = (),
        label_at: float = _LABEL_AT,
        level: bool = False,
    ) -> None:
        """Vertical lines, instead of those there were under this name; each with its label, if any.

        A label stands beside its line, `label_at` of the way up. `level` ones lie across, at values of y.
        None of them moves the axes.
        """
        wanted = role, tuple(zip_longest(at, labels)), label_at, level
        log = self.y.log if level else self.x.log
        if name in self._marks and self._marks[name].wanted == wanted:
            return
        for old in self._marks.pop(name, _NO_MARKS).lines:
            self.removeItem(old)
        drawn = [
            pg.InfiniteLine(
                np.log10(x) if log else x,
                angle=0 if level else 90,
                label=label,
                labelOpts={"position": label_at},
            )
            for x, label in wanted[1]
            if x > 0 or not log
        ]
        if not drawn:
            return
        self._marks[name] = _Marks(role, drawn, wanted)
        for line in drawn:
            self.addItem(line, ignoreBounds=True)
        self._style_marks()

    def show_axes(self, x: Axis, y: Axis) -> None:
        """Other quantities or scales from now on; what is shown is to be given again."""
        if (x, y) == (self.x, self.y):
            return
        self.empty()
        self.cursors.forget()
        self.x, self.y = x, y
        self.setLogMode(x.log, y.log)
        self.enableAutoRange()
        self._paint()

    def keep(self, names: Iterable[str]) -> None:
        """Take away every curve of another name."""
        for name in set(self._curves) - set(names):
            for item in self._curves.pop(name).items:
                self.removeItem(item)

    def empty(self) -> None:
        """Take away everything."""
        self.keep(())
        for name in tuple(self._marks):
            self.mark((), name=name)

    @property
    def names(self) -> tuple[str, ...]:
        """Of the curves there are."""
        return tuple(self._curves)

    def columns(self) -> dict[str, Array]:
        """Everything shown, as exported: a column of x before each curve's own."""
        found: dict[str, Array] = {}
        for name, curve in self._curves.items():
            for key, values in curve.columns.items():
                found[f"{name}: {self.x.column}" if key == "" else f"{key}: {self.y.column}"] = values
        return found

    @property
    def curves(self) -> dict[str, tuple[Array, Array]]:
        """Shown, by name, without bands: x and y. Shape (points,) each."""
        return {n: (c.columns[""], c.columns[n]) for n, c in self._curves.items() if n in c.columns}

    # How

    def changeEvent(self, event: QEvent) -> None:
        """Colours and type follow the window's."""
        super().changeEvent(event)
        if event.type() in (QEvent.Type.PaletteChange, QEvent.Type.FontChange) and hasattr(self, "cursors"):
            self._paint()

    def _curve(
        self, name: str, kind: Literal["line", "points", "band", "trace"], role: Role, *, listed: bool = True
    ) -> _Curve:
        known = self._curves.get(name)
        if known is not None and known.kind == kind:
            known.role = role
            return known
        if known is not None:
            self.keep(n for n in self._curves if n != name)
        curve = _Curve(self._items(name if listed else None, kind), role, kind, {})
        for item in curve.items:
            item.setZValue(_BELOW if role == "faint" else 0)
            self.addItem(item)
        self._curves[name] = curve
        return curve

    def _items(self, name: str | None, kind: str) -> tuple[Any, ...]:
        if kind == "band":
            edges = pg.PlotDataItem(), pg.PlotDataItem()
            return (*edges, pg.FillBetweenItem(*edges))
        item = pg.PlotDataItem(name=name)
        if kind == "points":
            item.sigPointsClicked.connect(self._clicked)
        return (item,)

    def _set(self, curve: _Curve, x: Array, y: Array) -> None:
        x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        name = next(n for n, c in self._curves.items() if c is curve)
        curve.columns = {"": x, name: y}
        self._style(curve)
        few = len(x) <= _SMOOTH
        if curve.kind == "trace":
            # Extremes of a few samples each would make stairs of a slope.
            _thin_out(curve.items[0], few)
        curve.items[0].setData(x, y, antialias=few)

    def _style(self, curve: _Curve) -> None:
        shape = (curve.symbol, curve.size, curve.width, curve.dashed, curve.hollow)
        look = (curve.role, *shape, current_theme())
        if look == curve.look:
            # Styling again costs as much as drawing again.
            return
        curve.look = look
        color = current_theme().color(curve.role)
        if curve.kind == "band":
            for edge in curve.items[:2]:
                edge.setPen(None)
            curve.items[2].setBrush(current_theme().color(curve.role, _BAND_ALPHA))
        elif curve.kind == "points":
            item = curve.items[0]
            item.setPen(None)
            item.setSymbol(curve.symbol)
            item.setSymbolSize(curve.size)
            item.setSymbolPen(pg.mkPen(color, width=_RING_WIDTH if curve.hollow else 1.0))
            item.setSymbolBrush(None if curve.hollow else current_theme().color(curve.role, 0.6))
        else:
            style = Qt.PenStyle.DashLine if curve.dashed else Qt.PenStyle.SolidLine
            # In pixels of the screen: at scale 2 a line of one would be half as thick.
            wide = curve.width * (self.devicePixelRatioF() if curve.kind == "line" else 1.0)
            curve.items[0].setPen(pg.mkPen(color, width=wide, style=style))

    def _paint(self) -> None:
        theme = current_theme()
        self.setBackground(theme.base)
        size = f"{self.font().pointSizeF():g}pt"
        for side, shown in (("bottom", self.x), ("left", self.y)):
            axis = self.getAxis(side)
            axis.setPen(pg.mkPen(theme.faint))
            axis.setTextPen(pg.mkPen(theme.text))
            axis.setStyle(tickFont=self.font())
            axis.setLabel(self._title(side, shown), **{"font-size": size, "color": theme.text})
            axis.resizeEvent()
        if self._legend is not None:
            self._legend.setBrush(theme.color("base", _LEGEND_ALPHA))
            self._legend.setLabelTextColor(theme.text)
            self._legend.setLabelTextSize(size)
            for _, label in self._legend.items:
                label.setText(label.text)
        self._readout.paint(theme)
        self.cursors.paint(theme)
        for curve in self._curves.values():
            self._style(curve)
        self._style_marks()

    def resizeEvent(self, event: QResizeEvent | None) -> None:
        """A title that has not room enough beside its axis is shortened to the unit."""
        super().resizeEvent(event)
        if event is None or not hasattr(self, "cursors") or self.plotItem is None:
            return
        for side, shown in (("bottom", self.x), ("left", self.y)):
            axis, title = self.getAxis(side), self._title(side, shown)
            if axis.labelText != title:
                axis.setLabel(title, **axis.labelStyle)
            axis.resizeEvent()  # or the title stays where another one had its middle

    def _title(self, side: str, shown: Axis) -> str:
        room = self.width() if side == "bottom" else self.height()
        beside = self.getAxis("left" if side == "bottom" else "bottom")
        room -= _TITLE_ROOM_PX if beside.style["showValues"] else _EDGE_PX
        for title in (shown.title, shown.unit if shown.titled else ""):
            if self.fontMetrics().horizontalAdvance(title) <= room:
                return title
        return ""

    def _style_marks(self) -> None:
        for marks in self._marks.values():
            color = current_theme().color(marks.role)
            for line in marks.lines:
                line.setPen(pg.mkPen(color, style=Qt.PenStyle.DashLine))
                if hasattr(line, "label"):
                    line.label.setColor(color)

    def _clicked(self, item: Any, points: Any) -> None:
        name = next((n for n, c in self._curves.items() if c.items[0] is item), "")
        if name and len(points):
            self.picked.emit(name, int(points[0].index()))


def _thin_out(item: pg.PlotDataItem, few: bool) -> None:
    """Two points a pixel of many; after it is in the plot, which sets its own wishes on what is added."""
    if item.opts["autoDownsample"] == few or not item.opts["clipToView"]:
        item.setDownsampling(auto=not few, method="peak")
        item.opts["autoDownsampleFactor"] = 1.0
        item.setClipToView(True)
