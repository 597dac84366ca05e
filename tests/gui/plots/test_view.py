"""A plot's menu, made when it is opened."""

import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication

from gui.plots import Axis, Plot
from gui.plots.view import View

RIGHT, NO_KEY = Qt.MouseButton.RightButton, Qt.KeyboardModifier.NoModifier
ENTRIES = ["Two cursors", "Cursor with harmonics", "No cursor"]
ENTRIES += ["Export PNG...", "Export SVG...", "Export data CSV..."]


@pytest.fixture
def plot(qtbot, appearance):
    plot = Plot(Axis("frequency", "Hz"), Axis("velocity", "m/s"))
    qtbot.addWidget(plot)
    plot.resize(400, 300)
    plot.show()
    qtbot.waitExposed(plot)
    return plot


def said(menu):
    return [action.text() for action in menu.actions() if action.text()]


def test_a_right_click_opens_the_menu_with_cursors_and_exports_below_the_librarys_own(plot):
    view = plot.getViewBox()
    assert isinstance(view, View)
    assert view.menu is None  # a window of thirty plots opens sooner
    middle = plot.mapFromScene(view.sceneBoundingRect().center())
    for kind in (QEvent.Type.MouseButtonPress, QEvent.Type.MouseButtonRelease):
        held = RIGHT if kind == QEvent.Type.MouseButtonPress else Qt.MouseButton.NoButton
        event = QMouseEvent(kind, QPointF(middle), plot.mapToGlobal(QPointF(middle)), RIGHT, held, NO_KEY)
        QApplication.sendEvent(plot.viewport(), event)
    assert view.menu.isVisible()
    entries = said(view.menu)
    view.menu.close()
    assert entries[-6:] == ENTRIES
    assert "View All" in entries


def test_opened_again_it_is_the_same_menu(plot):
    view = plot.getViewBox()
    assert view.getMenu() is view.getMenu()
    assert [action.text() for action in view.getContextMenus(None)] == [
        action.text() for action in view.getMenu().actions()
    ]
