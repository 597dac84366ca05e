"""The list of laws drawn beside the session's: added by a button or dropped, taken away again."""

from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QCheckBox, QGridLayout, QVBoxLayout, QWidget

from gui.background.task import BackgroundTask, Progress
from gui.files.short_name import short_name
from gui.pages.law.plots import LawLine
from gui.pages.material.compared import PAPER, ComparedLaw, paper_law, recorded_laws
from gui.style.theme import Role
from gui.widgets.asking import ask_open_many
from gui.widgets.basic import button, hint
from gui.widgets.tables import Cell, ReadTable
from instrument.interchange.given import SESSION_ENDINGS

_LOOKS: tuple[tuple[Role, bool], ...] = (
    ("second", False),
    ("third", False),
    ("fourth", False),
    ("second", True),
    ("third", True),
    ("fourth", True),
)
_COLUMNS = {"drawn beside": "Its name in the legend", "from": "Where it comes from"}


class LawComparison(QWidget):
    """Laws of elsewhere.

    Signals
    -------
    changed
        `lines` are others now.
    failed
        One line.
    """

    changed = Signal()
    failed = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.laws: list[ComparedLaw] = []
        self._looks: dict[str, int] = {}
        self._reading: list[_Reading] = []
        self.table = ReadTable(_COLUMNS, selects=True)
        self.paper = QCheckBox("Paper's ZN_1")
        self.paper.setToolTip("The law of the paper's Table 4")
        self.add = button("Add session...", "The law another session's own fit gave, and its diagnosis")
        self.remove = button("Remove", "Take the selected one away (Del)")
        self.remove.setEnabled(False)
        self.remove.setShortcut("Del")
        self.setAcceptDrops(True)
        self._arrange()
        self.paper.toggled.connect(self._toggle_paper)
        self.add.clicked.connect(self._ask)
        self.remove.clicked.connect(self._remove)
        self.table.selectionModel().selectionChanged.connect(self._selected)

    @property
    def lines(self) -> list[LawLine]:
        """To be drawn; each keeps its look while it is there."""
        found = []
        for law in self.laws:
            role, dashed = _LOOKS[self._looks[law.name] % len(_LOOKS)]
            found.append(LawLine(law.name, law.curve, role, dashed=dashed, width=1.5))
        return found

    def read(self, path: Path) -> None:
        """Another session; returns at once."""
        reading = _Reading(path, self)
        self._reading.append(reading)
        reading.done.connect(self._read)
        reading.failed.connect(self._not_read)
        reading.start()

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Sessions are compared here instead of opened."""
        if self._sessions(event):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Compare what was dropped."""
        event.acceptProposedAction()
        for path in self._sessions(event):
            self.read(path)

    def _sessions(self, event: QDropEvent) -> list[Path]:
        paths = [Path(url.toLocalFile()) for url in event.mimeData().urls() if url.isLocalFile()]
        return [path for path in paths if path.suffix.lower() in SESSION_ENDINGS]

    def _ask(self) -> None:
        endings = " ".join(f"*{ending}" for ending in SESSION_ENDINGS)
        ask_open_many(self, "Compare with", "", f"Sessions ({endings})", self.read)

    def _read(self, laws: object) -> None:
        self._forget(self.sender())
        assert isinstance(laws, list)
        self._show([*(law for law in self.laws if law.name not in {new.name for new in laws}), *laws])

    def _not_read(self, message: str) -> None:
        self._forget(self.sender())
        self.failed.emit(message)

    def _forget(self, reading: QObject) -> None:
        assert isinstance(reading, _Reading)
        self._reading.remove(reading)
        reading.deleteLater()

    def _toggle_paper(self, wanted: bool) -> None:
        rest = [law for law in self.laws if law.name != PAPER]
        self._show([*rest, paper_law()] if wanted else rest)

    def _remove(self) -> None:
        gone = self.table.selected
        if gone is None:
            return
        if self.laws[gone].name == PAPER:
            self.paper.blockSignals(True)
            self.paper.setChecked(False)
            self.paper.blockSignals(False)
        self._show([law for k, law in enumerate(self.laws) if k != gone])

    def _selected(self) -> None:
        self.remove.setEnabled(self.table.selected is not None)

    def _show(self, laws: list[ComparedLaw]) -> None:
        self.laws = laws
        looks = {law.name: self._looks[law.name] for law in laws if law.name in self._looks}
        for law in laws:
            free = (k for k in range(len(laws)) if k not in looks.values())
            looks[law.name] = looks[law.name] if law.name in looks else next(free)
        self._looks = looks
        rows = []
        for line, law in zip(self.lines, laws, strict=True):
            named = Cell(short_name(line.name), line.name, edge=line.role, left=True)
            rows.append([named, Cell(law.note, faint=True, left=True)])
        self.table.show_rows(rows)
        self._selected()
        self.changed.emit()

    def _arrange(self) -> None:
        buttons = QGridLayout()
        for k, one in enumerate((self.paper, self.add, self.remove)):
            buttons.addWidget(one, 0, k)
        column = QVBoxLayout(self)
        column.setContentsMargins(4, 4, 4, 0)
        column.addLayout(buttons)
        column.addWidget(self.table, 1)
        column.addWidget(hint("Drop sessions here to compare them; dropped elsewhere they are opened."))


class _Reading(BackgroundTask[list[ComparedLaw]]):
    """Of another session."""

    def __init__(self, path: Path, parent: QObject) -> None:
        super().__init__(self._read_file, parent)
        self.path = path

    def _read_file(self, _: Progress) -> list[ComparedLaw]:
        return recorded_laws(self.path)
