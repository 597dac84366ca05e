"""Tab goes through the window as it is seen, and stops everywhere something can be done."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtWidgets import (
    QApplication,
    QHBoxLayout,
    QLineEdit,
    QPushButton,
    QSplitter,
    QTableView,
    QTabWidget,
    QWidget,
)

from gui.frame.tab_order import in_order, neighbour
from gui.plots import Axis, Plot

pytestmark = pytest.mark.pages("run", "material")


def part(*widgets):
    whole = QWidget()
    row = QHBoxLayout(whole)
    for widget in widgets:
        row.addWidget(widget)
    return whole


def test_parts_come_one_after_the_other_and_tabs_before_what_is_below_them(made):
    tabs = QTabWidget()
    inside = QLineEdit()
    tabs.addTab(part(inside), "one")
    first, off, last = QPushButton("first"), QPushButton("off"), QPushButton("last")
    off.setEnabled(False)
    above, below = part(first, off), part(tabs, last)
    whole = made(part(below, above))
    whole.show()
    assert in_order([above, below]) == [first, tabs.tabBar(), inside, last]


def test_a_splitter_is_walked_from_left_to_right(made):
    split = made(QSplitter())
    one, two = QLineEdit(), QLineEdit()
    split.addWidget(one)
    split.addWidget(two)
    split.show()
    assert in_order([split]) == [one, two]


def test_the_last_is_followed_by_the_first(made):
    one, two = QLineEdit(), QLineEdit()
    whole = made(part(one, two))
    whole.show()
    assert neighbour([whole], two, forward=True) is one
    assert neighbour([whole], one, forward=False) is two
    assert neighbour([whole], None, forward=True) is one
    assert neighbour([whole], None, forward=False) is two
    two.setEnabled(False)
    assert neighbour([whole], one, forward=True) is None


def walked(qtbot, window):
    """What has the keyboard, Tab by Tab from the row of pages, until it is there again."""
    first = window.tabs.tabBar()
    first.setFocus()
    found = []
    while (at := QApplication.focusWidget()) not in found:
        found.append(at)
        qtbot.keyClick(at, Qt.Key.Key_Tab)
    assert at is first
    return found


@pytest.mark.parametrize("name", ["run", "material"])
def test_tab_reaches_everything_of_a_page_and_comes_back(qtbot, opened, name):
    opened.activateWindow()
    opened.show_page(name)
    page = opened.tabs.currentWidget()
    qtbot.waitUntil(lambda: bool(page.findChildren(QTableView)))
    found = walked(qtbot, opened)
    wanted = [
        widget
        for widget in page.findChildren(QWidget)
        if isinstance(widget, (QPushButton, QLineEdit, QTableView, Plot))
        and widget.isVisible()
        and widget.isEnabled()
        and widget.focusPolicy() & Qt.FocusPolicy.TabFocus
    ]
    assert wanted
    assert set(wanted) <= set(found)
    # The page first, then the recording below it, then the log.
    assert max(map(found.index, wanted)) < found.index(opened.replay.play)
    assert found[-1].window() is opened
    assert opened.log.isAncestorOf(found[-1])
    qtbot.keyClick(found[0], Qt.Key.Key_Tab, Qt.KeyboardModifier.ShiftModifier)
    assert QApplication.focusWidget() is found[-1]


def test_the_menu_key_opens_a_plots_menu(qtbot, made):
    plot = made(Plot(Axis("Frequency", "Hz"), Axis("Level")))
    plot.show()
    at = plot.rect().center()
    event = QContextMenuEvent(QContextMenuEvent.Reason.Keyboard, at, plot.mapToGlobal(at))
    QApplication.sendEvent(plot, event)
    menu = plot.plotItem.vb.menu
    qtbot.waitUntil(menu.isVisible)
    assert any("Export" in action.text() for action in menu.actions())
    menu.close()
