"""The menus over a window of a few lines: what each entry does, and what can be done when."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMenu

from gui.actions.controller import AppController
from gui.frame import menus as module
from gui.frame.log_pane import LogPane
from gui.frame.menus import Menus
from gui.frame.notice import Notice
from gui.frame.shell import Shell
from instrument.files.acceleration import UNITS, acceleration_unit


class Looks:
    """Mode and size of type, as chosen last."""

    def __init__(self):
        self.mode, self.scale, self.waiting = "light", 1.0, False

    def choose(self, mode):
        self.mode = mode

    def resize(self, scale):
        self.scale = scale


class Small(Shell):
    """What the menus know of a window, and what they asked of it."""

    def __init__(self):
        super().__init__()
        self.controller, self.notice, self.log = AppController(self), Notice(self), LogPane(self)
        self.settings, self.appearance = SimpleNamespace(recent=[]), Looks()
        self.asked = []

    @property
    def pages(self):
        return ()

    @property
    def page_titles(self):
        return {"run": "Run", "hammer": "Hammer"}

    def show_acceleration_in(self, name):
        self.asked.append(("acceleration", name))

    def open(self, path):
        self.asked.append(("open", path))

    def show_page(self, name):
        self.asked.append(("page", name))


@pytest.fixture
def window(made):
    return made(Small())


@pytest.fixture
def menus(window):
    return Menus(window)


def action(window, text):
    """The entry of a text, in whichever menu."""
    (found,) = (a for a in window.findChildren(QAction) if a.text().replace("&", "") == text)
    return found


def test_every_page_has_an_entry_and_a_key(window, menus):
    for text, name, key in (("Run", "run", "Ctrl+1"), ("Hammer", "hammer", "Ctrl+2")):
        entry = action(window, text)
        assert entry.shortcut() == QKeySequence(key)
        entry.trigger()
        assert window.asked[-1] == ("page", name)


OF_A_SESSION = ("Close session", "Save report...", "Save report as PDF...", "Print report...", "CSV...")


@pytest.mark.parametrize("recorded", [False, True])
def test_what_is_of_a_session_can_be_done_with_one_only(window, menus, monkeypatch, recorded):
    session = SimpleNamespace(path=Path("a.h5")) if recorded else None
    monkeypatch.setattr(AppController, "recorded", property(lambda controller: session))
    menus.refresh()
    assert {action(window, text).isEnabled() for text in OF_A_SESSION} == {recorded}
    assert action(window, "Open...").isEnabled()


def test_what_was_opened_before_is_opened_again_by_its_path(window, menus):
    recent = next(m for m in window.findChildren(QMenu) if m.title() == "Open &recent")
    assert not recent.isEnabled()
    window.settings.recent = [Path("a.h5"), Path("b & c.toml")]
    menus.refresh()
    assert recent.isEnabled()
    menus.refresh()
    assert len(recent.actions()) == 2
    recent.actions()[1].trigger()
    assert window.asked == [("open", Path("b & c.toml"))]


def test_a_file_is_asked_for_by_every_ending_that_can_be_opened(window, menus, monkeypatch):
    asked = []
    monkeypatch.setattr(module, "ask_open", lambda *given: asked.append(given))
    action(window, "Open...").trigger()
    ((_, title, _, kinds, then),) = asked
    assert title == "Open"
    for ending in ("*.h5", "*.toml", "*.uff", "*.mat", "*.csv"):
        assert ending in kinds
    then(Path("a.uff"))
    assert window.asked == [("open", Path("a.uff"))]


def test_light_and_dark_exclude_each_other_and_the_one_there_is_is_marked(window, menus):
    light, dark = action(window, "Light"), action(window, "Dark")
    assert light.isChecked()
    dark.trigger()
    assert window.appearance.mode == "dark"
    assert (light.isChecked(), dark.isChecked()) == (False, True)


def test_type_grows_and_shrinks_step_by_step_within_its_sizes(window, menus):
    larger, smaller = action(window, "Larger type"), action(window, "Smaller type")
    sizes = sorted(module.SCALES)
    window.appearance.scale = sizes[0]
    seen = []
    for _ in range(len(sizes) + 1):
        seen.append(window.appearance.scale)
        larger.trigger()
    assert seen == [*sizes, sizes[-1]]
    smaller.trigger()
    assert window.appearance.scale == sizes[-2]
    for _ in sizes:
        smaller.trigger()
    assert window.appearance.scale == sizes[0]
    action(window, "Usual type").trigger()
    assert window.appearance.scale == 1.0


def test_looks_that_wait_for_a_run_are_said_to(window, menus):
    action(window, "Dark").trigger()
    assert window.notice.text == ""
    window.appearance.waiting = True
    for one in ("Light", "Larger type"):
        window.notice.hide()
        action(window, one).trigger()
        assert "once the run has ended" in window.notice.text


def test_acceleration_is_shown_in_the_unit_chosen_of_which_one_is_marked(window, menus):
    entries = {name: action(window, f"Acceleration in {unit.symbol}") for name, unit in UNITS.items()}
    marked = [name for name, entry in entries.items() if entry.isChecked()]
    assert [UNITS[name] for name in marked] == [acceleration_unit()]
    for name, entry in entries.items():
        entry.trigger()
        assert window.asked[-1] == ("acceleration", name)


def test_every_key_that_is_listed_is_said_with_what_it_does(window, menus, monkeypatch):
    told = []
    monkeypatch.setattr(module, "tell", lambda window, title, text: told.append(text))
    action(window, "Keys").trigger()
    (text,) = told
    assert text.count("<tr") == len(module._KEYS.splitlines())
    for key in ("F12", "F9", "Ctrl+Return", "Ctrl+P"):
        assert key in text


def test_what_an_export_says_stands_on_the_window(window, menus):
    menus._export.began.emit("being written")
    assert "being written" in window.notice.text
    menus._export.done.emit("saved a.html")
    assert "saved a.html" in window.notice.text
    menus._printing.failed.emit("no printer")
    assert "no printer" in window.notice.text


def test_the_window_itself_says_what_stands_behind_each_word(made):
    bare = made(Shell())
    for asked in (
        lambda: bare.pages,
        lambda: bare.page_titles,
        lambda: bare.open(Path("a")),
        lambda: bare.show_page("run"),
        lambda: bare.show_acceleration_in("g"),
    ):
        with pytest.raises(NotImplementedError):
            asked()
