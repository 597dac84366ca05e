"""The numbers that are drawn beside an axis of a plot."""

from PySide6.QtGui import QPainter, QPicture


def plot_numbers(plot, side="left"):
    """As they are seen: those that would be cut are left out."""
    axis, picture = plot.getAxis(side), QPicture()
    painter = QPainter(picture)
    painter.setFont(plot.font())
    _, _, said = axis.generateDrawSpecs(painter)
    painter.end()
    return [text for _, _, text in said]
