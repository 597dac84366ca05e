"""What a person does on the page Sweep, and what it then shows."""

from PySide6.QtCore import QPointF, Qt

LEFT = Qt.MouseButton.LeftButton


def click_segment(qtbot, page, row):
    where = page.chooser.visualItemRect(page.chooser.item(row)).center()
    qtbot.mouseClick(page.chooser.viewport(), LEFT, pos=where)


def click_point(qtbot, plot, x, y):
    """A real click on a place in the plot's own units."""
    at = plot.mapFromScene(plot.getViewBox().mapViewToScene(QPointF(x, y)))
    qtbot.mouseMove(plot.viewport(), at)
    qtbot.mouseClick(plot.viewport(), LEFT, pos=at)


def value(page, name):
    return next(line.value for line in page.record.lines if line.name == name)


def shown(plot, name):
    return plot.columns()[f"{name}: {plot.x.column}"], plot.columns()[f"{name}: {plot.y.column}"]


def fed(page, state, events):
    for event in events:
        state.take(event)
        page.show_state(state)
