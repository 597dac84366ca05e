"""The rows of a form by themselves: no file, no faults."""

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication, QComboBox, QLineEdit

from gui.form.keys import KeyedRows
from gui.form.rows import FAULT, VALUE, FormRows


def filled(rows, editors):
    """A table with two fields in it."""
    above = rows.add_row(None, ("core",), "core", "")
    for key, editor in editors.items():
        rows.setItemWidget(rows.add_row(above, ("core", key), key, ""), VALUE, editor)
        rows._editors["core", key] = editor
    return rows


def test_a_row_is_known_by_its_place_and_the_place_by_its_row(made):
    rows = filled(made(FormRows()), {"poisson": QLineEdit()})
    item = rows.item("core", "poisson")
    assert item.parent() is rows.item("core")
    assert rows.place_of(item) == ("core", "poisson")
    assert rows.place_of(None) == ()
    with pytest.raises(KeyError):
        rows.editor("core", "none")


def test_what_is_typed_into_a_place_is_told_as_a_persons_word(made):
    field, typed = QLineEdit(), []
    rows = filled(made(FormRows()), {"poisson": field, "kind": QComboBox()})
    field.textEdited.connect(typed.append)
    rows.type_into(("core", "poisson"), "0.49")
    rows.type_into(("core", "kind"), "no field to type into")
    assert (typed, field.text()) == (["0.49"], "0.49")


def test_a_fault_takes_room_from_the_fields(made):
    rows = filled(made(FormRows()), {"poisson": QLineEdit()})
    rows.resize(500, 200)
    rows.show()
    rows.fit_values()
    before = rows.header().sectionSize(VALUE)
    rows.item("core", "poisson").setText(FAULT, "expected below 0.5")
    rows.fit_values()
    assert rows.header().sectionSize(VALUE) < before


def test_a_row_inside_a_folded_table_is_unfolded(made):
    rows = filled(made(FormRows()), {"poisson": QLineEdit()})
    assert not rows.item("core").isExpanded()
    rows.unfold(rows.item("core", "poisson"))
    assert rows.item("core").isExpanded()


@pytest.fixture
def keyed(qtbot, made):
    rows = filled(made(KeyedRows()), {"poisson": QLineEdit(), "kind": QComboBox()})
    for editor in rows._editors.values():
        rows.hear_keys_of(editor)
    rows.item("core").setExpanded(True)
    rows.show()
    rows.activateWindow()
    qtbot.waitUntil(rows.isActiveWindow)
    rows.setFocus()
    return rows


def test_the_keyboard_goes_into_a_field_and_comes_back_to_its_row(qtbot, keyed):
    assert keyed.place_of(keyed.currentItem()) == ("core",)
    assert keyed.place_with_keyboard() is None
    qtbot.keyClick(keyed, Qt.Key.Key_Down)
    qtbot.keyClick(keyed, Qt.Key.Key_Return)
    assert keyed.place_with_keyboard() == ("core", "poisson")
    qtbot.keyClick(QApplication.focusWidget(), Qt.Key.Key_Escape)
    assert keyed.hasFocus()
    assert keyed.place_of(keyed.currentItem()) == ("core", "poisson")


def test_rows_made_anew_give_the_keyboard_back_where_it_was(keyed):
    keyed.show_place(("core", "kind"))
    assert keyed.place_with_keyboard() == ("core", "kind")
    keyed.give_keyboard_back(("core",), None)
    assert keyed.hasFocus()
    assert keyed.place_of(keyed.currentItem()) == ("core",)
    keyed.give_keyboard_back(("core",), ("core", "poisson"))
    assert keyed.place_with_keyboard() == ("core", "poisson")


def test_a_wheel_turned_above_a_choice_changes_nothing(keyed):
    choice = keyed.editor("core", "kind")
    choice.addItems(["a", "b"])
    at, none = QPointF(5, 5), Qt.KeyboardModifier.NoModifier
    turned = QWheelEvent(
        at, at, QPoint(), QPoint(0, -120), Qt.MouseButton.NoButton, none, Qt.ScrollPhase.NoScrollPhase, False
    )
    QApplication.sendEvent(choice, turned)
    assert turned.type() == QEvent.Type.Wheel
    assert choice.currentText() == "a"
