"""What a person does on the page Sweep, and what it then shows."""

import pytest
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


def sweep_page(window):
    """The page of a window, its resonances in one plot."""
    window.resize(1366, 768)
    window.show_page("sweep")
    page = window.pages[1]
    page.response.apart.setChecked(False)
    return page


def as_first_shown(window):
    """The same in a window that others have looked at too: nothing chosen yet."""
    page = sweep_page(window)
    page.response.quantity.setCurrentIndex(0)
    for box in (page.response.log_amplitude, page.response.log_frequency):
        box.setChecked(False)
    page.tabs.setCurrentIndex(0)
    page.chooser.choose(None)
    page._looked_at = None
    page.seen = page.seen.but(chosen=None)
    page._draw_all()
    return page


@pytest.fixture
def page(opened):
    """Of the session at its end."""
    return sweep_page(opened)


@pytest.fixture
def looked_at(kept):
    """The same, in the window of the whole module."""
    return as_first_shown(kept)
