"""The rows of a form: one for each place of a file, with its field, and how wide the fields are."""

from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QComboBox, QLineEdit, QTreeWidget, QTreeWidgetItem, QWidget

from gui.form.fields import Place

NAME, VALUE, UNIT, FAULT = range(4)
"""Columns."""
_LEAST_LETTERS, _LETTERS, _FAULT_LETTERS, _WORDS = 20, 42, 4, 38
"""Width of a field, at least and at most, and what is left beside it: a little, or room for a fault."""

Editor = QLineEdit | QComboBox


class FormRows(QTreeWidget):
    """Rows by their places."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._items: dict[Place, QTreeWidgetItem] = {}
        self._editors: dict[Place, Editor] = {}
        self.setColumnCount(4)
        self.setHeaderLabels(["", "value", "unit", ""])
        # Its last column takes the room that is left, but no less than it has had.
        self.header().resizeSection(FAULT, self.header().minimumSectionSize())
        self.setSelectionMode(QTreeWidget.SelectionMode.NoSelection)
        self.setVerticalScrollMode(QTreeWidget.ScrollMode.ScrollPerPixel)
        self.setIndentation(self.fontMetrics().averageCharWidth() * 2)

    def editor(self, *place: str | int) -> Editor:
        """The field of a place. Raises `KeyError`."""
        return self._editors[place]

    def item(self, *place: str | int) -> QTreeWidgetItem:
        """The row of a place. Raises `KeyError`."""
        return self._items[place]

    def place_of(self, item: QTreeWidgetItem | None) -> Place:
        """Of a row; empty for none."""
        return next((place for place, one in self._items.items() if one is item), ())

    def type_into(self, place: Place, text: str) -> None:
        """As a person would; nothing where there is no such field."""
        editor = self._editors.get(place)
        if isinstance(editor, QLineEdit):
            editor.setText(text)
            editor.textEdited.emit(text)

    def add_row(self, above: QTreeWidgetItem | None, place: Place, label: str, tip: str) -> QTreeWidgetItem:
        """Below another one, or at the top level."""
        item = QTreeWidgetItem([label, "", "", ""])
        if above is None:
            self.addTopLevelItem(item)
        else:
            above.addChild(item)
        item.setToolTip(NAME, tip)
        self._items[place] = item
        return item

    def fit_values(self) -> None:
        """Fields as wide as leaves room for what stands beside them; not narrower than a number."""
        letter = self.fontMetrics().averageCharWidth()
        beside = sum(self.sizeHintForColumn(column) for column in (NAME, UNIT))
        faulty = any(item.text(FAULT) for item in self._items.values())
        # What is wrong needs words; a number needs little.
        words = max((_WORDS if faulty else _FAULT_LETTERS) * letter, self.header().minimumSectionSize())
        room = self.viewport().width() - beside - words
        self.header().resizeSection(VALUE, max(_LEAST_LETTERS * letter, min(_LETTERS * letter, room)))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """More room for the fields, or less."""
        super().resizeEvent(event)
        self.fit_values()

    @staticmethod
    def unfold(item: QTreeWidgetItem) -> None:
        """So that the row is seen."""
        above = item.parent()
        while above is not None:
            above.setExpanded(True)
            above = above.parent()
