"""Lines right across a plot, each group of them under a name of its own: limits, peaks, moments."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import Any

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt

from gui.style.theme import Role, current_theme

LABEL_AT = 0.08
"""Of the way up a vertical line."""


@dataclass
class _Group:
    """Lines of one meaning."""

    role: Role
    lines: Sequence[pg.InfiniteLine]
    wanted: tuple[Any, ...]
    """What they were asked for with: the same again changes nothing."""


_NONE = _Group("faint", (), ())


class Marks:
    """The marks of points in one plot."""

    def __init__(self, plot: Any) -> None:
        self._plot = plot
        self.groups: dict[str, _Group] = {}

    def show(
        self,
        name: str,
        at: Iterable[float],
        role: Role,
        labels: Sequence[str],
        label_at: float,
        *,
        level: bool,
    ) -> None:
        """Instead of those there were under this name: up and down at values of x, or `level` ones of y."""
        wanted = role, tuple(zip_longest(at, labels)), label_at, level
        log = self._plot.y.log if level else self._plot.x.log
        if name in self.groups and self.groups[name].wanted == wanted:
            return
        for old in self.groups.pop(name, _NONE).lines:
            self._plot.removeItem(old)
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
        self.groups[name] = _Group(role, drawn, wanted)
        for line in drawn:
            self._plot.addItem(line, ignoreBounds=True)
        self.style()

    def empty(self) -> None:
        """Take away all."""
        for name in tuple(self.groups):
            self.show(name, (), "faint", (), LABEL_AT, level=False)

    def style(self) -> None:
        """In the colours and the type of the moment."""
        for group in self.groups.values():
            color = current_theme().color(group.role)
            # In pixels of the screen, as a curve's.
            pen = pg.mkPen(color, width=self._plot.devicePixelRatioF(), style=Qt.PenStyle.DashLine)
            for line in group.lines:
                line.setPen(pen)
                if hasattr(line, "label"):
                    line.label.setColor(color)
                    line.label.setFont(self._plot.font())
