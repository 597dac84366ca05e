"""The plot every page uses: axes with units, legend, readout, export, colours of the theme.

Curves are named; the same name again replaces what it shows. So a page calls `line`, `points` and `band` with
all it has at every refresh, and never keeps a curve.
"""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QEvent, Signal
from PySide6.QtGui import QContextMenuEvent, QFont, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QWidget

from fitting.arrays import Array
from gui.plots.axis import Axis
from gui.plots.corner import emptiest_corner
from gui.plots.cursors import Cursors
from gui.plots.curve import Curve, Kind, Symbol, items_of
from gui.plots.export import add_export_menu
from gui.plots.log_axis import LogAxis
from gui.plots.marks import LABEL_AT, Marks
from gui.plots.readout import Readout
from gui.plots.view import View
from gui.style.theme import Role, current_theme

_LEGEND_ALPHA = 0.6
"""Of the ground behind the legend."""
_BELOW = -1
"""What is faint lies below everything else, whenever it came."""
_TITLE_ROOM_PX = 44
"""Of a plot's side that its axis does not have: the other axis, before it is laid out, and the edge."""
_EDGE_PX = 12
"""The edge alone."""
_LEAST_LETTERS, _LEAST_LINES = 15, 5
"""Width and height below which a plot shows nothing, in letters and lines of its numbers."""


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
        self._curves: dict[str, Curve] = {}
        self.least_lines: float = _LEAST_LINES
        self.marks = Marks(self)
        self._legend = self.addLegend(offset=(-8, 8)) if legend else None
        self.setLogMode(x.log, y.log)
        for side in ("bottom", "left", "top", "right"):
            self.getAxis(side).enableAutoSIPrefix(False)
        self.showGrid(x=True, y=True, alpha=0.25)
        self._readout, self.cursors = Readout(self), Cursors(self)
        add_export_menu(self)
        self._paint()
        # Its axes take what room their numbers need, once these are known.
        self.getViewBox().sigResized.connect(self._say_titles)

    # What is shown

    def line(
        self,
        name: str,
        x: Array,
        y: Array,
        role: Role = "model",
        *,
        width: float = 1.5,
        dashed: bool = False,
        listed: bool = True,
    ) -> None:
        """A line through points in order of x; one that goes with points need not be `listed`."""
        curve = self._curve(name, "line", role, listed=listed)
        curve.width, curve.dashed = width, dashed
        self._set(name, curve, x, y)

    def trace(self, name: str, x: Array, y: Array, role: Role = "data", *, listed: bool = True) -> None:
        """A line through many points evenly spaced in x: drawn by its extremes, two a pixel.

        One of many alike need not be `listed` in the legend.
        """
        curve = self._curve(name, "trace", role, listed=listed)
        curve.width = 1.0
        self._set(name, curve, x, y)

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
        self._set(name, curve, x, y)

    def band(self, name: str, x: Array, low: Array, high: Array, role: Role = "model") -> None:
        """The area between two lines."""
        curve = self._curve(name, "band", role)
        curve.show_between(name, x, low, high)
        self._style(curve)

    def mark(
        self,
        at: Iterable[float],
        role: Role = "faint",
        *,
        name: str = "",
        labels: Sequence[str] = (),
        label_at: float = LABEL_AT,
        level: bool = False,
    ) -> None:
        """Vertical lines, instead of those there were under this name; each with its label, if any.

        A label stands beside its line, `label_at` of the way up. `level` ones lie across, at values of y.
        None of them moves the axes.
        """
        self.marks.show(name, at, role, labels, label_at, level=level)

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
        self.marks.empty()

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

    def need_lines(self, lines: float) -> None:
        """Be no lower than so many lines of the plot's numbers, however large these are."""
        self.least_lines, letters = lines, self.fontMetrics()
        self.setMinimumSize(_LEAST_LETTERS * letters.averageCharWidth(), round(lines * letters.lineSpacing()))

    # How

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """The menu key opens what a right click does."""
        if event.reason() == QContextMenuEvent.Reason.Keyboard:
            self.plotItem.vb.getMenu().popup(self.mapToGlobal(self.rect().center()))
        else:
            super().contextMenuEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """A frame where the keyboard is; inside, because the library counts on all of the widget's room."""
        super().paintEvent(event)
        if self.hasFocus():
            painter = QPainter(self.viewport())
            painter.setPen(current_theme().color("data"))
            painter.drawRect(self.viewport().rect().adjusted(0, 0, -1, -1))
            painter.end()

    def changeEvent(self, event: QEvent) -> None:
        """Colours and type follow the window's."""
        super().changeEvent(event)
        if event.type() in (QEvent.Type.PaletteChange, QEvent.Type.FontChange) and hasattr(self, "cursors"):
            self._paint()

    def _curve(self, name: str, kind: Kind, role: Role, *, listed: bool = True) -> Curve:
        known = self._curves.get(name)
        if known is not None and known.kind == kind:
            known.role = role
            return known
        if known is not None:
            self.keep(n for n in self._curves if n != name)
        curve = Curve(items_of(name if listed else None, kind), role, kind, {})
        if kind == "points":
            curve.items[0].sigPointsClicked.connect(self._clicked)
        for item in curve.items:
            item.setZValue(_BELOW if role == "faint" else 0)
            self.addItem(item)
        self._curves[name] = curve
        return curve

    def _set(self, name: str, curve: Curve, x: Array, y: Array) -> None:
        self._style(curve)
        curve.show(name, x, y)

    def _style(self, curve: Curve) -> None:
        curve.style(self.devicePixelRatioF())

    def _paint(self) -> None:
        theme = current_theme()
        self.need_lines(self.least_lines)
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
            _fit(self._legend, self.font())
        self._readout.paint(theme)
        self.cursors.paint(theme)
        for curve in self._curves.values():
            self._style(curve)
        self.marks.style()

    def place_legend(self) -> None:
        """Where it hides least of the curves that are shown."""
        if self._legend is not None:
            self._legend.setOffset(emptiest_corner([self._drawn(x, y) for x, y in self.curves.values()]))

    def _drawn(self, x: Array, y: Array) -> tuple[Array, Array]:
        """As the axes have them; what a logarithmic one cannot show is no number."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.log10(x) if self.x.log else x, np.log10(y) if self.y.log else y

    def resizeEvent(self, event: QResizeEvent | None) -> None:
        """A title that has not room enough beside its axis is shortened, to the unit at last."""
        super().resizeEvent(event)
        if event is not None and hasattr(self, "cursors") and self.plotItem is not None:
            self._say_titles()

    def _say_titles(self) -> None:
        for side, shown in (("bottom", self.x), ("left", self.y)):
            axis, title = self.getAxis(side), self._title(side, shown)
            if axis.labelText != title:
                axis.setLabel(title, **axis.labelStyle)
            axis.resizeEvent()  # or the title stays where another one had its middle

    def _title(self, side: str, shown: Axis) -> str:
        room = self.width() if side == "bottom" else self.height()
        beside = self.getAxis("left" if side == "bottom" else "bottom")
        laid_out = beside.width() if side == "bottom" else beside.height()
        room -= max(_TITLE_ROOM_PX, laid_out + _EDGE_PX) if beside.style["showValues"] else _EDGE_PX
        for title in shown.titles:
            if self.fontMetrics().horizontalAdvance(title) <= room:
                return title
        return ""

    def _clicked(self, item: Any, points: Any) -> None:
        name = next((n for n, c in self._curves.items() if c.items[0] is item), "")
        if name and len(points):
            self.picked.emit(name, int(points[0].index()))


def _fit(legend: pg.LegendItem, font: QFont) -> None:
    """No larger than its names in this type: a text keeps the height of the type that it was made in."""
    for _, label in legend.items:
        label.item.setFont(font)
        label.setText(label.text)
    legend.resize(0, 0)
    legend.updateSize()
