"""The files that are fitted together: which is which, and with which specimen."""

from functools import partial
from pathlib import Path

from PySide6.QtCore import QModelIndex, QObject, Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from gui.actions.taking_together import ask_hammer, ask_specimen, ask_together
from gui.actions.together import Together
from gui.background.task import BackgroundTask, Progress
from gui.files.bare_names import bare_names
from gui.files.file_stamp import Stamp
from gui.files.pairing import SPECIMEN_ENDING, PairedFile, fault_of
from gui.files.short_name import short_name
from gui.pages.together.looked import Looked, look
from gui.widgets.basic import button, tool
from gui.widgets.mark import Mark
from gui.widgets.tables import Cell, ReadTable
from instrument.interchange.given import is_session

_COLUMNS = {
    "": "Number that results call the file by",
    "data": "A sweep, an FRF, a table of modes, or a session",
    "specimen": "What it was measured on; double click or Enter: another one",
    "holds": "What both files say of themselves",
}
_As = tuple[PairedFile, tuple[Stamp | None, ...]]
"""A file as it was written last."""
_OWN = "its own"
_TABLE_LETTERS = 32
"""Of a name: what both files hold stands beside them."""
_HAMMER = "Hammer test..."
_HAMMER_TIP = (
    "Of the bare plate that all files are of: its damping and its stiffness take part. A session that has "
    "one, or the JSON of 'viscorig damping'"
)
_HAMMER_LETTERS = 22
"""Of its file on the button: beside the others there is no more room."""
_FAULTY = "\u2716 "


class ChosenFiles(QWidget):
    """A row a file.

    Signals
    -------
    looked_at
        A file was: `why_not` may be another one now.
    """

    looked_at = Signal()

    def __init__(self, together: Together, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.together = together
        self.table = ReadTable(_COLUMNS, selects=True)
        self.add = button(
            "Add files...", "Sweeps, sessions, tables of modes of one core (Ctrl+Shift+O)", "plus"
        )
        self.specimen = button("Specimen...", "Of the file selected; of all files where none is")
        self.hammer = button(_HAMMER, _HAMMER_TIP, "hammer")
        self.bare = tool("close", "Without the hammer test")
        self.up = tool("up", "Move the selected file up")
        self.remove = button("Remove", "Take the selected file away (Del)")
        self.fault = Mark()
        self.fault.setWordWrap(True)
        # A long path has no place to be broken at, and would widen the window.
        self.fault.setMinimumWidth(1)
        self._looked: dict[_As, Looked | str] = {}
        self._looking: dict[_As, _Look] = {}
        self._owned: dict[int, list[str]] = {}
        self._arrange()
        self.add.clicked.connect(self._ask_files)
        self.specimen.clicked.connect(self._ask_specimen)
        self.hammer.clicked.connect(self._ask_hammer)
        self.bare.clicked.connect(self._without_hammer)
        self.up.clicked.connect(self._move_up)
        self.remove.clicked.connect(self._remove)
        delete = QShortcut(QKeySequence.StandardKey.Delete, self.table)
        delete.setContext(Qt.ShortcutContext.WidgetShortcut)
        delete.activated.connect(self._remove)
        self.table.activated.connect(self._row_activated)
        self.table.selectionModel().selectionChanged.connect(self._show_buttons)
        self._show_buttons()

    @property
    def why_not(self) -> str:
        """Why nothing can be found of these files, in a line; empty where that is not known."""
        return fault_of(self.together.files) or self._first_fault()

    def show_files(self, owned: dict[int, list[str]]) -> None:
        """Those chosen; of each file, from 1, the effects that belong to it alone."""
        self._owned = owned
        for file in self.together.files:
            it = self._as_it_is(file)
            if it not in self._looked and it not in self._looking and not _lacks(file):
                self._look(it)
        self._show_rows()

    def take(self, paths: list[Path]) -> None:
        """Files dropped here: data, or the specimen of the file selected, of all where none is."""
        data = [path for path in paths if path.suffix.lower() != SPECIMEN_ENDING]
        if data:
            self.together.add(data)
        for path in paths:
            if path not in data and self.together.files:
                self.together.pair(self.table.selected, path)

    def _as_it_is(self, file: PairedFile) -> _As:
        return file, self.together.stamps(file)

    def _look(self, it: _As) -> None:
        self._looking[it] = work = _Look(it, self)
        work.done.connect(self._seen)
        work.failed.connect(self._not_seen)
        work.start()

    def _seen(self, found: object) -> None:
        assert isinstance(found, Looked)
        self._keep(self.sender(), found)

    def _not_seen(self, message: str) -> None:
        self._keep(self.sender(), message)

    def _keep(self, work: QObject, found: Looked | str) -> None:
        assert isinstance(work, _Look)
        self._looking.pop(work.it, None)
        self._looked[work.it] = found
        work.deleteLater()
        self._show_rows()
        self.looked_at.emit()

    def _show_rows(self) -> None:
        chosen = self.table.selected
        files = self.together.files
        self.table.show_rows([self._cells(k, file) for k, file in enumerate(files, start=1)])
        if chosen is not None and chosen < len(files):
            self.table.selectRow(chosen)
        said = self.why_not
        self.fault.say(bare_names(said), "bad" if len(files) > 1 else "faint")
        self.fault.setToolTip(said)
        self.fault.setVisible(bool(said))
        self._show_buttons()

    def _first_fault(self) -> str:
        """Of what was looked at, in whole: in the table there is room for some words only."""
        files = enumerate(self.together.files, start=1)
        found = ((k, self._looked.get(self._as_it_is(file))) for k, file in files)
        return next((f"File {k}: {said}" for k, said in found if isinstance(said, str)), "")

    def _cells(self, number: int, file: PairedFile) -> list[Cell]:
        looked = self._looked.get(self._as_it_is(file), "" if _lacks(file) else "...")
        effects = self._owned.get(number, [])
        named = (
            short_name(file.specimen.name, _TABLE_LETTERS)
            if file.specimen is not None
            else ""
            if _lacks(file)
            else _OWN
        )
        if isinstance(looked, Looked):
            holds = Cell(f"{looked.specimen}; {looked.data}", left=True)
        elif looked in ("", "..."):
            holds = Cell(looked, left=True, faint=True)
        else:
            holds = Cell(f"{_FAULTY}{bare_names(looked)}", looked, left=True, fill="bad", alpha=0.2)
        return [
            Cell(str(number), ", ".join(effects), bold=bool(effects), edge="data" if effects else None),
            Cell(short_name(file.data.name, _TABLE_LETTERS), str(file.data), left=True, bold=bool(effects)),
            Cell(
                named or f"{_FAULTY}none",
                str(file.specimen or "The session's own" if named else "Choose one"),
                left=True,
                fill=None if named else "bad",
                alpha=0.2,
            ),
            holds,
        ]

    def _show_buttons(self) -> None:
        files, row = self.together.files, self.table.selected
        self.specimen.setEnabled(bool(files))
        self.specimen.setText("Specimen of all..." if row is None else f"Specimen of {row + 1}...")
        self.remove.setEnabled(row is not None)
        self.up.setEnabled(bool(row))
        hammer = self.together.hammer
        self.hammer.setEnabled(bool(files))
        self.hammer.setText(short_name(hammer.name, _HAMMER_LETTERS) if hammer is not None else _HAMMER)
        self.hammer.setToolTip(f"{_HAMMER_TIP}\n{hammer}" if hammer is not None else _HAMMER_TIP)
        self.bare.setVisible(hammer is not None)

    def _ask_files(self) -> None:
        ask_together(self, self.together)

    def _ask_specimen(self) -> None:
        ask_specimen(self, self.together, self.table.selected)

    def _ask_hammer(self) -> None:
        ask_hammer(self, self.together)

    def _without_hammer(self) -> None:
        self.together.strike(None)

    def _row_activated(self, at: QModelIndex) -> None:
        ask_specimen(self, self.together, at.row())

    def _move_up(self) -> None:
        row = self.table.selected
        if row:
            self.together.move(row, -1)
            self.table.selectRow(row - 1)

    def _remove(self) -> None:
        row = self.table.selected
        if row is not None:
            self.together.remove(row)

    def _arrange(self) -> None:
        buttons = QHBoxLayout()
        for one in (self.add, self.specimen, self.up, self.remove, self.hammer, self.bare):
            buttons.addWidget(one)
        buttons.addStretch(1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(buttons)
        column.addWidget(self.table, 1)
        column.addWidget(self.fault)


class _Look(BackgroundTask[Looked]):
    """At a file and its specimen."""

    def __init__(self, it: _As, parent: QObject) -> None:
        super().__init__(partial(_look, it[0]), parent)
        self.it = it


def _look(file: PairedFile, _: Progress) -> Looked:
    return look(file)


def _lacks(file: PairedFile) -> bool:
    """Whether there is nothing to look at yet: no specimen."""
    return file.specimen is None and not is_session(file.data)
