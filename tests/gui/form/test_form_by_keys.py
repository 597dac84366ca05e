"""A form without a mouse: rows, tables that are ticked, fields."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QComboBox

from gui.form.draft import Draft
from gui.form.form import Form
from instrument.files.experiment_file import ExperimentDocument
from instrument.simulated_case import case_file

SPACE, DOWN, ENTER, ESCAPE = Qt.Key.Key_Space, Qt.Key.Key_Down, Qt.Key.Key_Return, Qt.Key.Key_Escape


@pytest.fixture
def form(qtbot, made):
    form = made(Form(Draft.of(case_file("experiment.toml"), ExperimentDocument)))
    form.resize(500, 300)
    form.show()
    form.activateWindow()
    qtbot.waitUntil(form.isActiveWindow)
    form.setFocus()
    return form


def go_to(qtbot, form, *place):
    for _ in range(200):
        if form.currentItem() is form.item(*place):
            return
        qtbot.keyClick(form, DOWN)
    pytest.fail(f"no key leads to {place}")


def test_space_ticks_a_table_and_the_keyboard_stays_at_its_row(qtbot, form):
    go_to(qtbot, form, "hammer")
    assert form.draft.given(("hammer",))
    before = form.item("hammer")
    qtbot.keyClick(form, SPACE)
    assert not form.draft.given(("hammer",))
    qtbot.waitUntil(lambda: form.item("hammer") is not before)
    assert form.hasFocus()
    assert form.currentItem() is form.item("hammer")


def test_arrow_keys_fold_a_table(qtbot, form):
    go_to(qtbot, form, "mounting")
    qtbot.keyClick(form, Qt.Key.Key_Left)
    assert not form.item("mounting").isExpanded()
    qtbot.keyClick(form, Qt.Key.Key_Right)
    assert form.item("mounting").isExpanded()


def test_enter_goes_into_a_field_and_escape_back_to_its_row(qtbot, form):
    go_to(qtbot, form, "mounting", "bolts")
    qtbot.keyClick(form, ENTER)
    editor = form.editor("mounting", "bolts")
    assert QApplication.focusWidget() is editor
    editor.selectAll()
    qtbot.keyClicks(editor, "6")
    qtbot.keyClick(editor, ESCAPE)
    assert form.hasFocus()
    assert form.currentItem() is form.item("mounting", "bolts")
    assert form.draft.value(("mounting", "bolts")) == 6


def test_a_field_that_tab_goes_to_is_scrolled_into_sight(qtbot, form):
    form.resize(500, 120)
    last = form.editor("sweep", "segments", 2, "range")
    last.setFocus(Qt.FocusReason.TabFocusReason)
    assert form.viewport().rect().intersects(form.visualItemRect(form.item("sweep", "segments", 2, "range")))


def test_a_choice_that_makes_the_rows_anew_keeps_the_keyboard(qtbot, form):
    def plan():
        return form.editor("sweep", "plan")

    assert isinstance(plan(), QComboBox)
    plan().setFocus()
    before = plan()
    form._build_later()
    qtbot.waitUntil(lambda: plan() is not before)
    assert QApplication.focusWidget() is plan()


def test_a_form_without_faults_is_not_scrolled_sideways(form):
    form.resize(600, 300)
    QApplication.processEvents()
    assert form.said == []
    assert form.horizontalScrollBar().maximum() == 0
