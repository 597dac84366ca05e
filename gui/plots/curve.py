"""A curve of a plot: what it shows, and how it is drawn in the colours of the moment."""

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt

from fitting.arrays import Array
from gui.files.short_name import short_name
from gui.style.theme import Role, current_theme

Symbol = Literal["o", "s", "t", "t1", "d", "+", "x", "star"]
Kind = Literal["line", "points", "band", "trace"]

_SMOOTH = 5000
"""Curves of more points are drawn without smoothed edges, which would cost several times as much."""
_BAND_ALPHA, _POINT_ALPHA = 0.25, 0.6
_LEGEND_LETTERS = 44
"""Of a name: a law with one effect and its doubt has 41."""
_RING_WIDTH = 2.0


@dataclass
class Curve:
    """A curve and how it is drawn, so that it can be drawn in other colours."""

    items: tuple[Any, ...]
    role: Role
    kind: Kind
    columns: dict[str, Array]
    """As exported, x under no name. Shape (points,) each."""
    symbol: Symbol = "o"
    width: float = 1.5
    dashed: bool = False
    size: float = 8.0
    hollow: bool = False
    look: tuple[Any, ...] = ()
    """As it was last styled."""

    def show(self, name: str, x: Array, y: Array) -> None:
        """These points from now on; shape (points,) each."""
        x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        self.columns = {"": x, name: y}
        few = len(x) <= _SMOOTH
        if self.kind == "trace":
            # Extremes of a few samples each would make stairs of a slope.
            _thin_out(self.items[0], few)
        self.items[0].setData(x, y, antialias=few)

    def show_between(self, name: str, x: Array, low: Array, high: Array) -> None:
        """The area between two lines from now on; shape (points,) each."""
        for item, edge in zip(self.items, (low, high), strict=False):
            item.setData(np.asarray(x, dtype=float), np.asarray(edge, dtype=float))
        self.columns = {"": np.asarray(x), f"{name} low": np.asarray(low), f"{name} high": np.asarray(high)}

    def style(self, pixels_a_point: float) -> None:
        """In the colours of the moment."""
        look = (
            self.role,
            self.symbol,
            self.size,
            self.width,
            self.dashed,
            self.hollow,
            pixels_a_point,
            current_theme(),
        )
        if look == self.look:
            # Styling again costs as much as drawing again.
            return
        self.look = look
        color = current_theme().color(self.role)
        item = self.items[0]
        if self.kind == "band":
            for edge in self.items[:2]:
                edge.setPen(None)
            self.items[2].setBrush(current_theme().color(self.role, _BAND_ALPHA))
        elif self.kind == "points":
            item.setPen(None)
            item.setSymbol(self.symbol)
            item.setSymbolSize(self.size)
            item.setSymbolPen(pg.mkPen(color, width=_RING_WIDTH if self.hollow else 1.0))
            item.setSymbolBrush(None if self.hollow else current_theme().color(self.role, _POINT_ALPHA))
        else:
            style = Qt.PenStyle.DashLine if self.dashed else Qt.PenStyle.SolidLine
            # In pixels of the screen: at scale 2 a line of one would be half as thick.
            wide = self.width * (pixels_a_point if self.kind == "line" else 1.0)
            item.setPen(pg.mkPen(color, width=wide, style=style))


def items_of(name: str | None, kind: Kind) -> tuple[Any, ...]:
    """What a curve is drawn with; without a name the legend does not list it."""
    if kind == "band":
        edges = pg.PlotDataItem(), pg.PlotDataItem()
        return (*edges, pg.FillBetweenItem(*edges))
    return (pg.PlotDataItem(name=short_name(name, _LEGEND_LETTERS) if name is not None else None),)


def _thin_out(item: pg.PlotDataItem, few: bool) -> None:
    """Two points a pixel of many; after it is in the plot, which sets its own wishes on what is added."""
    if item.opts["autoDownsample"] == few or not item.opts["clipToView"]:
        item.setDownsampling(auto=not few, method="peak")
        item.opts["autoDownsampleFactor"] = 1.0
        item.setClipToView(True)
