"""Pages that another package adds to the window; what they break is theirs alone."""

import logging

import pytest
from PySide6.QtCore import Qt

import gui.frame.page_set
from fitting.plugins import Registry
from gui.frame.window import Window
from gui.pages import PAGES

PAGE = """
from gui.page import Page

class Good(Page):
    title, hint = "Another", "What another package shows"
    def refresh(self, state):
        pass

class Unmade(Good):
    def __init__(self, controller):
        raise RuntimeError("not today")

class Failing(Good):
    def show_state(self, state):
        raise RuntimeError("no more")

class Nameless(Page):
    pass
"""
OURS = ["run", "sweep", "hammer", "material", "diagnosis", "together"]


@pytest.fixture
def opened(package, monkeypatch, qtbot, appearance, settings, caplog):
    """The window with a package's pages."""
    caplog.set_level(logging.WARNING)

    def open_with(**pages):
        package("pages-one", PAGE, pages=pages)
        fresh = Registry(PAGES.group, PAGES._own, PAGES._judge)
        monkeypatch.setattr(gui.frame.page_set, "PAGES", fresh)
        window = Window(appearance, settings)
        qtbot.addWidget(window)
        window.show()
        qtbot.waitUntil(window.isActiveWindow)
        return window

    return open_with


def names(window):
    return [page.objectName() for page in window.pages]


def test_another_packages_page_comes_last_and_has_its_key(opened, qtbot):
    window = opened(another="Good")
    assert names(window) == [*OURS, "another"]
    assert window.tabs.tabText(6) == "Another"
    qtbot.keyClick(window, Qt.Key.Key_7, Qt.KeyboardModifier.ControlModifier)
    assert window.tabs.currentWidget().objectName() == "another"


def test_the_page_shown_is_remembered_by_its_name(opened, settings):
    window = opened(another="Good")
    window.show_page("another")
    window.close()
    assert settings.arrangement.page == "another"


def test_a_page_that_is_no_longer_there_gives_way_to_the_first(opened, settings):
    settings._kept.setValue("page", "another")
    window = opened()
    assert window.tabs.currentWidget().objectName() == "run"


@pytest.mark.parametrize("wrong", ["Unmade", "Nameless", "Missing"])
def test_a_page_that_cannot_be_made_is_left_out_and_said_in_the_window(opened, wrong):
    window = opened(another=wrong)
    assert names(window) == OURS
    assert "plugin 'another' of package pages-one (viscorig.pages) is left out" in window.notice.text


def test_a_page_that_fails_leaves_the_others_alone(opened, caplog):
    window = opened(another="Failing", last="Good")
    window.turn()
    window.turn()
    said = [r.getMessage() for r in caplog.records if r.name == "fitting.plugins"]
    assert [line.rpartition(": ")[2] for line in said] == ["no more"]
    failing, good = window.pages[6:]
    assert (failing.isEnabled(), good.isEnabled()) == (False, True)


def test_keys_go_to_the_first_nine(opened):
    window = opened(**{f"p{k}": "Good" for k in range(6)})
    assert len(window.pages) == 12
    assert "(Ctrl+9)" in window.tabs.tabToolTip(8)
    assert "Ctrl" not in window.tabs.tabToolTip(9)
