"""Which files the window takes together, and with which specimens: chosen, dropped, moved, remembered."""

import pytest
from openers import press
from pair_files import two_masses
from PySide6.QtCore import QEvent, QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QFileDialog
from together_views import chosen as chosen
from together_views import page as page

from gui.pages.together import TogetherPage
from gui.pages.together.chosen import ChosenFiles

pytestmark = pytest.mark.pages("run", "material", "diagnosis", "together")

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture(scope="module")
def masses(tmp_path_factory):
    """A light one and a heavy one."""
    return list(two_masses(tmp_path_factory.mktemp("masses")))


def test_a_page_without_files_says_what_to_do(page):
    assert isinstance(page, TogetherPage)
    assert "or one alone" in page.empty.text()
    assert page.chosen.fault.said == "Add a file, or several of one core."
    assert not page.identify.isEnabled()


def test_which_file_is_which_is_seen_before_anything_is_fitted(chosen):
    assert isinstance(chosen.chosen, ChosenFiles)
    table = chosen.chosen.table
    assert table.texts(1) == ["light.csv", "heavy.csv"]
    assert table.texts(2) == ["light.toml", "heavy.toml"]
    assert table.texts(3)[1].startswith("shear pair, 1.196 kg; 24 points, ")
    assert not chosen.chosen.fault.isVisible()
    assert chosen.identify.isEnabled()


def test_a_hammer_test_is_named_on_its_button_and_taken_away_by_its_cross(qtbot, chosen, tmp_path):
    files = chosen.chosen
    assert files.hammer.isEnabled()
    assert not files.bare.isVisible()
    chosen.together.strike(tmp_path / "bare plate of the fourth of May, hung by threads.h5")
    assert files.hammer.text().startswith("bare plate")
    assert files.hammer.text().endswith(".h5")
    assert len(files.hammer.text()) < 25
    assert "threads.h5" in files.hammer.toolTip()
    qtbot.mouseClick(files.bare, LEFT)
    assert chosen.together.hammer is None
    assert files.hammer.text() == "Hammer test..."
    assert not files.bare.isVisible()


def test_a_file_is_taken_away_and_moved_by_keys(qtbot, chosen, masses):
    window, table = chosen.window(), chosen.chosen.table
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    table.setFocus()
    table.selectRow(0)
    qtbot.keyClick(table, Qt.Key.Key_Down)
    assert table.selected == 1
    assert chosen.chosen.specimen.text() == "Specimen of 2..."
    chosen.chosen.up.click()
    assert table.texts(1) == ["heavy.csv", "light.csv"]
    qtbot.keyClick(table, Qt.Key.Key_Return)
    (dialog,) = chosen.findChildren(QFileDialog)
    assert dialog.windowTitle() == "Specimen of file 1, heavy.csv"
    dialog.close()
    window.activateWindow()
    table.setFocus()
    qtbot.waitUntil(window.isActiveWindow)
    press(table, Qt.Key.Key_Delete)
    assert table.texts(1) == ["light.csv"]


def test_the_work_begins_by_keys(qtbot, chosen):
    window = chosen.window()
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    for key in (Qt.Key.Key_I, Qt.Key.Key_D):
        QTest.keyClick(window.windowHandle(), key, Qt.KeyboardModifier.ControlModifier)
        # A button pressed by its key is seen to go down first.
        qtbot.waitUntil(lambda: chosen.together.work == "identifying")
        chosen.together.cancel()


def test_what_is_dropped_is_added_and_a_specimen_goes_to_all(qtbot, page, masses, tmp_path):
    for name in ("a.csv", "b.csv"):
        (tmp_path / name).write_bytes(masses[0].read_bytes())
    drop(page, [tmp_path / "a.csv", tmp_path / "b.csv"])
    assert page.chosen.table.texts(2) == ["✖ none"] * 2
    assert page.chosen.fault.said.startswith("File 1, a.csv: no specimen")
    assert not page.identify.isEnabled()
    drop(page, [masses[0].with_suffix(".toml")])
    assert page.chosen.table.texts(2) == ["light.toml"] * 2
    qtbot.waitUntil(lambda: "..." not in page.chosen.table.texts(3))
    assert page.identify.isEnabled()


def drop(page, paths):
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path)) for path in paths])
    none = Qt.KeyboardModifier.NoModifier
    page.dropEvent(QDropEvent(QPointF(5, 5), Qt.DropAction.CopyAction, data, LEFT, none))


def test_a_damaged_file_is_said_before_anything_is_fitted(qtbot, chosen, tmp_path):
    bad = tmp_path / "bad.csv"
    bad.write_text("frequency_hz\n10\n")
    chosen.together.add([bad])
    qtbot.waitUntil(lambda: "..." not in chosen.chosen.table.texts(3))
    assert chosen.chosen.table.texts(3)[2].startswith("✖ ")
    assert chosen.chosen.fault.said.startswith("File 3: bad.csv: header")
    assert str(bad) in chosen.chosen.fault.toolTip()
    assert "\n" not in chosen.chosen.fault.said


def test_while_a_file_has_a_fault_nothing_is_begun_and_mending_it_is_seen(qtbot, window, chosen, tmp_path):
    bad = tmp_path / "bad.csv"
    bad.write_text("")
    chosen.together.add([bad])
    qtbot.waitUntil(lambda: "the file is empty" in chosen.chosen.fault.said)
    assert not chosen.identify.isEnabled()
    assert not chosen.diagnose.isEnabled()
    bad.write_bytes(chosen.together.files[0].data.read_bytes())
    chosen.changeEvent(QEvent(QEvent.Type.ActivationChange))
    qtbot.waitUntil(chosen.identify.isEnabled)
    assert chosen.diagnose.isEnabled()
    assert not window.notice.text


def test_what_was_said_of_one_file_goes_when_others_are_chosen(window, chosen, tmp_path):
    for asked in (lambda: drop(chosen, [tmp_path / "other.csv"]), lambda: chosen.together.remove(2)):
        chosen.together.failed.emit("bad.csv: the file is empty")
        assert window.notice.text
        asked()
        assert not window.notice.text


def test_the_menu_asks_for_files_on_the_page(qtbot, window):
    action = next(a for m in window.menuBar().actions() for a in m.menu().actions() if "together" in a.text())
    action.trigger()
    assert window.tabs.currentWidget().objectName() == "together"
    (dialog,) = window.findChildren(QFileDialog)
    assert dialog.windowTitle() == "Files to fit together"
    dialog.close()


def test_a_pairing_is_remembered_by_the_next_window(window, settings, masses, tmp_path):
    other = tmp_path / "other.toml"
    other.write_text(masses[0].with_suffix(".toml").read_text())
    window.controller.together.add(masses)
    window.controller.together.pair(1, other)
    assert settings.specimens == {masses[1].resolve(): other.resolve()}
