"""What is made before the first picture, and what only after it."""

import subprocess
import sys

import pytest
from PySide6.QtWidgets import QLabel, QWidget

from gui.frame.splash import splash
from gui.frame.window import Window


@pytest.fixture
def fresh(qtbot, appearance, settings):
    window = Window(appearance, settings)
    qtbot.addWidget(window)
    return window


def test_only_what_is_seen_is_made_before_the_first_picture(fresh):
    made = fresh._page_set.made
    assert list(made) == ["run"]
    assert [fresh.tabs.tabText(k) for k in range(6)] == list(fresh.page_titles.values())


def test_the_other_pages_are_made_while_nobody_waits(qtbot, fresh):
    fresh.show()
    qtbot.waitUntil(lambda: list(fresh._page_set.made) != ["run"] and not fresh._undrawn)
    shown = [fresh.tabs.widget(k) for k in range(fresh.tabs.count())]
    assert shown == list(fresh.pages)
    assert fresh.tabs.currentWidget() is fresh.pages[0]


def test_a_tab_chosen_early_is_made_then(fresh):
    fresh.tabs.setCurrentIndex(3)
    assert fresh.tabs.currentWidget() is fresh._page_set.made["material"]
    assert "sweep" not in fresh._page_set.made


def test_what_is_opened_early_reaches_every_page(fresh, session_path):
    fresh.open(session_path)
    assert set(fresh._page_set.made) == set(fresh.page_titles)


def test_a_picture_stands_in_until_the_window_comes(qtbot, appearance):
    first = splash()
    qtbot.addWidget(first)
    assert isinstance(first, QWidget)
    assert not isinstance(first, QLabel)
    image = first.pixmap().toImage()
    colors = {image.pixelColor(x, y).name() for x in range(0, 400, 4) for y in range(0, 170, 2)}
    assert len(colors) > 5


def test_the_window_loads_nothing_that_only_fits_need():
    done = subprocess.run(
        [sys.executable, "-c", "import sys, gui.frame.window; print(*sys.modules)"],
        capture_output=True, text=True, timeout=120, check=True,
    )  # fmt: skip
    assert not {"scipy.signal", "scipy.stats", "matplotlib", "jinja2", "pandas"} & set(done.stdout.split())
