"""The place under the mouse, in the plot's own units."""

from typing import Any

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QObject, QPointF, Qt

from gui.style.theme import Theme, current_theme

_TURNS_1_S = 30


class Readout(QObject):
    """Two thin lines through the mouse and the numbers there."""

    def __init__(self, plot: Any) -> None:
        super().__init__(plot)
        self._plot = plot
        self._theme = current_theme()
        self._lines: list[pg.InfiniteLine] = []
        self._text: pg.TextItem | None = None
        self._moves = pg.SignalProxy(plot.scene().sigMouseMoved, rateLimit=_TURNS_1_S, slot=self._moved)
        plot.installEventFilter(self)

    @property
    def text(self) -> str:
        """As it stands in the plot; empty while the mouse is elsewhere."""
        return str(self._text.toPlainText()) if self._text is not None and self._text.isVisible() else ""

    def paint(self, theme: Theme) -> None:
        """In these colours."""
        self._theme = theme
        if self._text is None:
            return
        for line in self._lines:
            line.setPen(pg.mkPen(theme.faint, style=Qt.PenStyle.DotLine))
        self._text.setColor(theme.text)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Hide the readout when the mouse leaves the plot."""
        if event.type() == QEvent.Type.Leave:
            self._show(False)
        return False

    def at(self, place: QPointF) -> None:
        """Show the numbers at a place of the scene."""
        box = self._plot.getViewBox()
        inside = bool(box.sceneBoundingRect().contains(place))
        text = self._made() if inside else None
        self._show(inside)
        if text is None:
            return
        point = box.mapSceneToView(place)
        for line, value in zip(self._lines, (point.x(), point.y()), strict=True):
            line.setValue(value)
        said = [
            f"{10**value if axis.log else value:.5g} {axis.unit}".strip()
            for axis, value in ((self._plot.x, point.x()), (self._plot.y, point.y()))
        ]
        text.setText(",  ".join(said))

    def _made(self) -> pg.TextItem:
        """Lines and text: the mouse is never over most plots, which are made sooner without them."""
        if self._text is None:
            self._text = pg.TextItem(anchor=(0, 0))
            self._text.setParentItem(self._plot.getViewBox())
            self._text.setPos(6, 2)
            self._lines = [pg.InfiniteLine(angle=angle, movable=False) for angle in (90, 0)]
            for line in self._lines:
                self._plot.addItem(line, ignoreBounds=True)
            self.paint(self._theme)
        return self._text

    def _moved(self, arguments: tuple[QPointF]) -> None:
        self.at(arguments[0])

    def _show(self, shown: bool) -> None:
        if self._text is not None:
            for item in (*self._lines, self._text):
                item.setVisible(shown)
