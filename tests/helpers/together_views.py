"""The page of files that are taken together, with the files of a test."""

import pytest


@pytest.fixture
def page(window):
    """Without any file."""
    window.show_page("together")
    return window.tabs.currentWidget()


@pytest.fixture
def chosen(qtbot, page, masses):
    """With those that a module calls `masses`, looked at."""
    page.together.add(masses)
    qtbot.waitUntil(lambda: "..." not in page.chosen.table.texts(3))
    return page
