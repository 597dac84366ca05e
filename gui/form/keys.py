"""Rows that are walked and filled in by keys: up and down, into a field and out again."""

from PySide6.QtCore import QEvent, QModelIndex, QObject, QPersistentModelIndex, Qt
from PySide6.QtGui import QFocusEvent, QKeyEvent, QPainter
from PySide6.QtWidgets import QApplication, QComboBox, QStyleOptionViewItem, QWidget

from gui.form.fields import Place
from gui.form.rows import NAME, VALUE, Editor, FormRows
from gui.style.theme import current_theme


class KeyedRows(FormRows):
    """Arrow keys walk along the rows and fold them, space ticks a table, Enter goes into a field."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)

    def hear_keys_of(self, editor: Editor) -> None:
        """Escape in a field, the wheel above it, and Tab into it are the form's matter too."""
        editor.installEventFilter(self)

    def show_place(self, place: Place) -> None:
        """Scroll there, and give the keyboard to its field where it has one."""
        self.scrollToItem(self._items[place], FormRows.ScrollHint.PositionAtCenter)
        if place in self._editors:
            self._editors[place].setFocus()

    def focusInEvent(self, event: QFocusEvent) -> None:
        """The keyboard is at some row, always."""
        super().focusInEvent(event)
        first = self.topLevelItem(0)
        if self.currentItem() is None and first is not None:
            self.setCurrentItem(first, NAME)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter goes into the row's field; Escape there comes back."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            editor = self._editors.get(self.place_of(self.currentItem()))
            if editor is not None:
                editor.setFocus(Qt.FocusReason.TabFocusReason)
                return
        super().keyPressEvent(event)

    def drawRow(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        """The row that keys act on has a frame."""
        super().drawRow(painter, option, index)
        if self.hasFocus() and self.itemFromIndex(index) is self.currentItem():
            painter.setPen(current_theme().color("data"))
            painter.drawRect(option.rect.adjusted(0, 0, -1, -1))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """The wheel is the form's, Escape goes back to the rows, and Tab scrolls to where it goes."""
        if event.type() == QEvent.Type.Wheel and isinstance(watched, QComboBox):
            event.ignore()
            return True
        if isinstance(event, QFocusEvent) and event.type() == QEvent.Type.FocusIn:
            self._see(watched, event.reason())
        elif isinstance(event, QKeyEvent) and _is_escape(event):
            self._leave_field(watched)
            return True
        return False

    def place_with_keyboard(self) -> Place | None:
        """Of the field, or the row of the button, that has it; None where that is elsewhere."""
        held = QApplication.focusWidget()
        if held is None or held is self or not self.isAncestorOf(held):
            return None
        inside = self.viewport()
        for place, item in self._items.items():
            row = self.itemWidget(item, VALUE)
            if row is not None and inside.isAncestorOf(row) and (row is held or row.isAncestorOf(held)):
                return place
        return None

    def give_keyboard_back(self, row: Place, typed: Place | None) -> None:
        """To what is where it was: a table that is ticked makes all rows anew."""
        if row in self._items:
            self.setCurrentItem(self._items[row], NAME)
        if typed is not None and typed in self._editors:
            self._editors[typed].setFocus()
        else:
            if typed is not None and typed in self._items:
                self.setCurrentItem(self._items[typed], NAME)
            self.setFocus()

    def _see(self, editor: QObject, why: Qt.FocusReason) -> None:
        item = self._items.get(self._place_of_editor(editor))
        if item is not None and why in (Qt.FocusReason.TabFocusReason, Qt.FocusReason.BacktabFocusReason):
            self.scrollToItem(item)

    def _leave_field(self, editor: QObject) -> None:
        item = self._items.get(self._place_of_editor(editor))
        if item is not None:
            self.setCurrentItem(item, NAME)
        self.setFocus(Qt.FocusReason.TabFocusReason)

    def _place_of_editor(self, editor: QObject) -> Place:
        return next((place for place, one in self._editors.items() if one is editor), ())


def _is_escape(event: QKeyEvent) -> bool:
    return event.type() == QEvent.Type.KeyPress and event.key() == Qt.Key.Key_Escape
