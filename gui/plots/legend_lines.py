"""Names in a legend: in more lines than one where there is no room for it."""

import pyqtgraph as pg
from PySide6.QtCore import QSizeF, Qt
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QGraphicsGridLayout

_BREAK = "<br>"


def break_names(legend: pg.LegendItem, room_px: float, metrics: QFontMetrics) -> None:
    """Break names between words where the legend would be wider than `room_px`, and make it small.

    A word that is too long by itself stays whole.
    """
    labels = [label for _, label in legend.items]
    if not labels:
        return
    beside = _least(legend).width() - max(label.minimumWidth() for label in labels)
    margin = max(label.minimumWidth() - _width(label.text, metrics) for label in labels)
    for label in labels:
        said = in_lines(label.text.replace(_BREAK, " "), room_px - beside - margin, metrics)
        if said != label.text:
            label.setText(said)
    legend.resize(_least(legend))


def in_lines(name: str, room_px: float, metrics: QFontMetrics) -> str:
    """As few lines as have room, each as long as it can be."""
    lines: list[str] = []
    for word in name.split(" "):
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and metrics.horizontalAdvance(longer) <= room_px:
            lines[-1] = longer
        else:
            lines.append(word)
    return _BREAK.join(lines)


def _least(legend: pg.LegendItem) -> QSizeF:
    layout: QGraphicsGridLayout = legend.layout
    layout.activate()
    return layout.effectiveSizeHint(Qt.SizeHint.MinimumSize)


def _width(said: str, metrics: QFontMetrics) -> int:
    return max(metrics.horizontalAdvance(line) for line in said.split(_BREAK))
