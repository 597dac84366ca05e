"""One file as a form: a tree of its tables, a field for each value, and faults beside them as one types."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from PySide6.QtCore import QEvent, QSignalBlocker, Qt, QTimer, Signal
from PySide6.QtGui import QBrush
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QHeaderView, QLineEdit, QTreeWidgetItem, QWidget

from gui.form.draft import Draft
from gui.form.fields import FILES, Field, FormSection, Place, device_fields, law_fields
from gui.form.keys import KeyedRows
from gui.form.rows import FAULT, NAME, UNIT, VALUE, Editor
from gui.style.theme import current_theme
from gui.widgets.asking import ask_open
from gui.widgets.basic import tool
from instrument.files.acceleration import said_beside

_OPEN = (
    "mounting",
    "hammer",
    "segments",
    "core",
    "law",
    "plate",
    "beam",
    "shear-pair",
    "sweep",
    "shaker",
    "front_end",
    "vibrometer",
)
"""Tables shown unfolded from the start; one with a fault is too."""
_FAULTY = "\u2716 "


class Form(KeyedRows):
    """The form of one file.

    Signals
    -------
    edited
        A value was changed.
    """

    edited = Signal()

    def __init__(self, draft: Draft, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.draft = draft
        self._fields: dict[Place, tuple[QTreeWidgetItem, Field]] = {}
        self.itemChanged.connect(self._switched)
        self._build()

    @property
    def said(self) -> list[str]:
        """What is wrong, as it stands beside the fields."""
        found = [item.text(FAULT) for item in self._items.values() if item.text(FAULT)]
        return [said.removeprefix(_FAULTY) for said in found]

    def say_units(self) -> None:
        """Beside every field, with its value in the unit of acceleration that is shown elsewhere."""
        with QSignalBlocker(self):
            for place, (item, field) in self._fields.items():
                said = said_beside(field.key, _number_of(self.draft.value(place), field))
                item.setText(UNIT, f"{field.unit} {said}".rstrip())

    def judge(self) -> None:
        """Say what is wrong, each fault at its place or at the next one around it."""
        said: dict[Place, str] = {}
        for place, words in self.draft.faults().items():
            while place and place not in self._items:
                place = place[:-1]
            said.setdefault(place, words)
        color = QBrush(current_theme().color("bad"))
        with QSignalBlocker(self):
            for place, item in self._items.items():
                words = said.get(place, "")
                item.setText(FAULT, f"{_FAULTY}{words}" if words else "")
                item.setToolTip(FAULT, words)
                item.setForeground(FAULT, color)
                if words:
                    self.unfold(item)
        self.headerItem().setText(FAULT, f"{_FAULTY}{said[()]}" if () in said else "")
        self.fit_values()

    def show_fault(self) -> None:
        """Go to the first one, and let it be mended."""
        for place, item in self._items.items():
            if item.text(FAULT):
                self.show_place(place)
                return

    def changeEvent(self, event: QEvent) -> None:
        """Colours follow the window's."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_items"):
            self.judge()

    # Rows

    def _build(self) -> None:
        folded = {place for place, item in self._items.items() if item.childCount() and not item.isExpanded()}
        known, at = bool(self._items), self.verticalScrollBar().value()
        row, typed = self.place_of(self.currentItem()), self.place_with_keyboard()
        here = self.hasFocus() or typed is not None
        if typed is not None:
            # A field that goes while it has the keyboard hands it to the next one that goes.
            self.setFocus()
        with QSignalBlocker(self):
            self._items, self._editors, self._fields = {}, {}, {}
            self.clear()
            whole = self.draft.asks
            for field in whole.fields:
                self._field(None, (field.key,), field)
            for section in whole.sections:
                self._section(None, (section.key,), section)
            for place, item in self._items.items():
                item.setExpanded(place not in folded if known else str(place[-1]) in _OPEN or len(place) == 3)
            self.say_units()
            header = self.header()
            for column in (NAME, UNIT):
                header.setSectionResizeMode(column, QHeaderView.ResizeMode.ResizeToContents)
            header.setStretchLastSection(True)
            self.fit_values()
        self.verticalScrollBar().setValue(at)
        self.judge()
        if here:
            self.give_keyboard_back(row, typed)

    def _section(self, above: QTreeWidgetItem | None, place: Place, section: FormSection) -> None:
        item = self.add_row(above, place, section.label, section.tip)
        font = item.font(NAME)
        font.setBold(True)
        item.setFont(NAME, font)
        if section.repeated:
            self._tables(item, place, section)
            return
        if section.off != "never":
            item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable)
            item.setCheckState(
                NAME, Qt.CheckState.Checked if self._is_on(place, section) else Qt.CheckState.Unchecked
            )
            item.setData(NAME, Qt.ItemDataRole.UserRole, section.off)
            if not self._is_on(place, section):
                return
        self._inside(item, place, section)

    def _inside(self, item: QTreeWidgetItem, place: Place, section: FormSection) -> None:
        for field in section.fields:
            self._field(item, (*place, field.key), field)
        if section.key == "law":
            for field in law_fields(self.draft.value((*place, "kind"))):
                self._field(item, (*place, field.key), field)
        for field in device_fields(section, self.draft.value((*place, "kind"))):
            self._field(item, (*place, field.key), field)
        for inner in section.sections:
            self._section(item, (*place, inner.key), inner)

    def _tables(self, item: QTreeWidgetItem, place: Place, section: FormSection) -> None:
        self.setItemWidget(item, VALUE, self._button("plus", "Another one, like the last", self._add, place))
        given = self.draft.value(place)
        for number in range(len(given) if isinstance(given, list) else 0):
            one = (*place, number)
            row = self.add_row(item, one, f"{section.label.removesuffix('s')} {number + 1}", section.tip)
            self.setItemWidget(row, VALUE, self._button("minus", "Take it away", self._take_away, one))
            self._inside(row, one, section)

    def _field(self, above: QTreeWidgetItem | None, place: Place, field: Field) -> None:
        item = self.add_row(above, place, field.label, field.tip)
        self._fields[place] = item, field
        given = self.draft.shown(place, field.kind)
        editor: Editor
        choices = ("yes", "no") if field.kind == "switch" else field.choices
        if choices:
            editor = QComboBox()
            # A wheel turned over the form scrolls it and changes nothing.
            editor.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
            editor.addItems([*choices] if given in choices or not given else [given, *choices])
            editor.setCurrentText(given or field.default)
            if not given and field.default not in choices:
                editor.setCurrentIndex(-1)
            editor.textActivated.connect(partial(self._chosen, place, field))
        else:
            editor = QLineEdit(given)
            editor.setCursorPosition(0)
            editor.setPlaceholderText(field.default or ("needed" if field.needed else ""))
            editor.textEdited.connect(partial(self._typed, place, field))
        self.hear_keys_of(editor)
        editor.setToolTip(field.tip)
        editor.setAccessibleName(".".join(str(key) for key in place))
        self.setItemWidget(item, VALUE, self._with_picker(place, editor) if field.kind == "file" else editor)
        self._editors[place] = editor

    def _with_picker(self, place: Place, editor: QWidget) -> QWidget:
        """The field, and a button that asks for a file."""
        pick = tool("open", "Choose the file")
        pick.clicked.connect(partial(self._pick_clicked, place))
        pick.setAccessibleName(f"choose {'.'.join(str(key) for key in place)}")
        holder = QWidget()
        row = QHBoxLayout(holder)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        row.addWidget(editor, 1)
        row.addWidget(pick)
        return holder

    def _pick_clicked(self, place: Place, _: bool = False) -> None:
        self.pick(*place)

    def pick(self, *place: str | int) -> None:
        """Ask for the file whose name stands at this place."""
        folder = self.draft.path.parent
        known = folder / self.draft.shown(place)
        start = str(known if known.is_file() else folder)
        kinds = f"{FILES.get(str(place[-1]), 'Files (*.toml *.csv)')};;All files (*)"
        ask_open(self, "Choose a file", start, kinds, partial(self._picked, place))

    def _picked(self, place: Place, path: Path) -> None:
        """Named as seen from the file that names it, where it lies beside or below."""
        folder = self.draft.path.parent.resolve()
        inside = path.resolve().is_relative_to(folder)
        self.type_into(place, str(path.resolve().relative_to(folder) if inside else path.resolve()))

    def _button(self, sign: str, tip: str, slot: Callable[[Place, bool], None], place: Place) -> QWidget:
        made = tool(sign, tip)
        made.clicked.connect(partial(slot, place))
        made.setAccessibleName(f"{sign} {'.'.join(str(key) for key in place)}")
        holder = QWidget()
        row = QHBoxLayout(holder)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(made)
        row.addStretch(1)
        return holder

    def _is_on(self, place: Place, section: FormSection) -> bool:
        given = self.draft.value(place)
        return given is not False if section.off == "false" else given is not None

    # What a person does

    def _typed(self, place: Place, field: Field, text: str) -> None:
        self.draft.write(place, field, text)
        self._tell()

    def _chosen(self, place: Place, field: Field, text: str) -> None:
        self.draft.write(place, field, text)
        if field.key == "kind":
            self._build_later()
        self._tell()

    def _switched(self, item: QTreeWidgetItem, column: int) -> None:
        place = self.place_of(item)
        off = item.data(NAME, Qt.ItemDataRole.UserRole)
        if column == NAME and place and off:
            self.draft.switch(place, item.checkState(NAME) == Qt.CheckState.Unchecked, off == "false")
            self._build_later()
            self._tell()

    def _add(self, place: Place, _: bool = False) -> None:
        self.draft.add_table(place)
        self._build_later()
        self._tell()

    def _take_away(self, place: Place, _: bool = False) -> None:
        self.draft.remove(place)
        self._build_later()
        self._tell()

    def _build_later(self) -> None:
        """Not while one of the rows' own widgets is speaking."""
        QTimer.singleShot(0, self, self._build)

    def _tell(self) -> None:
        self.judge()
        self.say_units()
        self.edited.emit()


def _number_of(value: Any, field: Field) -> Any:
    """What counts at a field: what stands in the file, or the default where that is a number."""
    if value is not None:
        return value
    try:
        return float(field.default)
    except ValueError:
        return None
