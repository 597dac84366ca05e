"""What is run, where its session goes, and the buttons that check and start it."""

from pathlib import Path
from typing import get_args

from PySide6.QtCore import Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QFormLayout,
    QHBoxLayout,
    QLineEdit,
    QPushButton,
    QSizePolicy,
    QWidget,
)

from gui.form.drafts import Drafts
from gui.widgets.asking import ask_folder
from gui.widgets.basic import button
from instrument.engine import Order
from instrument.run.part import Part

_WORDS: dict[Part, str] = {"hammer": "hammer test", "sweep": "sweep"}
_ANEW = "a new session"


class StartPanel(QWidget):
    """Before a run.

    Signals
    -------
    check_wanted, start_wanted
        A button was pressed.
    out_changed
        Another folder for the session.
    """

    check_wanted = Signal()
    start_wanted = Signal()
    out_changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.parts = {part: QCheckBox(_WORDS[part]) for part in get_args(Part)}
        self.ask_content = QCheckBox("ask before the hits are used")
        self.ask_content.setChecked(True)
        self.ask_content.setToolTip("The hammer test then waits for your word, so that hits can be rejected")
        self.out = QLineEdit()
        self.out.setToolTip("Folder of the session")
        self.out.editingFinished.connect(self.out_changed)
        self.browse = button("", "Choose a folder", "open")
        self.browse.clicked.connect(self._browse)
        self.resume = QComboBox()
        self.resume.setToolTip(
            "A run that was broken off is carried on: what it completed is not measured again"
        )
        self.resume.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.show_broken_off([])
        self.check = button(
            "Check", "Everything wrong at once, then a dry run; nothing is connected (F7)", "check"
        )
        self.check.setShortcut("F7")
        self.start = button("Start", "Connect the rig and measure (F5)", "start", primary=True)
        self.start.setShortcut("F5")
        self.check.clicked.connect(self.check_wanted)
        self.start.clicked.connect(self.start_wanted)
        self._arrange()
        self.show_experiment(None)

    def show_experiment(self, drafts: Drafts | None) -> None:
        """Another experiment, or the same one edited."""
        there = drafts.parts() if drafts is not None else ()
        for part, box in self.parts.items():
            if box.isEnabled() != (part in there):
                box.setChecked(part in there)
            box.setEnabled(part in there)
        self.ask_content.setEnabled("hammer" in there)
        changed = drafts is not None and drafts.changed
        well = drafts is not None and drafts.fault_count == 0
        self.check.setEnabled(drafts is not None)
        self.start.setEnabled(well)
        self._name(self.check, "Save and check" if changed else "Check", "F7")
        self._name(self.start, "Save and start" if changed else "Start", "F5")
        if drafts is None:
            return
        tip = "Connect the rig and measure (F5)" if well else "Something is wrong in the forms: see there"
        self.start.setToolTip(tip)

    def propose(self, folder: Path) -> None:
        """Where a session goes unless somebody says otherwise."""
        self.out.setText(str(folder))

    @property
    def folder(self) -> Path:
        """Folder that the session is to be kept in."""
        return Path(self.out.text()).expanduser()

    def show_broken_off(self, folders: list[Path]) -> None:
        """Runs that can be carried on."""
        self.resume.clear()
        self.resume.addItem(_ANEW, None)
        for folder in folders:
            self.resume.addItem(f"carry on {folder.name}", folder)

    def order(self, experiment: Path) -> Order:
        """What is to be run."""
        chosen: tuple[Part, ...] = tuple(
            p for p, box in self.parts.items() if box.isChecked() and box.isEnabled()
        )
        return Order(
            experiment,
            self.folder,
            chosen,
            self.resume.currentData(),
            self.ask_content.isChecked() and self.ask_content.isEnabled(),
        )

    @staticmethod
    def _name(one: QPushButton, text: str, key: str) -> None:
        """Qt forgets a button's shortcut when its text changes."""
        if one.text() != text:
            one.setText(text)
            one.setShortcut(key)

    def _browse(self) -> None:
        ask_folder(self, "Folder of the session", self.out.text(), self._chosen)

    def _chosen(self, folder: Path) -> None:
        self.out.setText(str(folder))
        self.out_changed.emit()

    def _arrange(self) -> None:
        parts = QHBoxLayout()
        for box in (*self.parts.values(), self.ask_content):
            parts.addWidget(box)
        parts.addStretch(1)
        where = QHBoxLayout()
        where.addWidget(self.out, 1)
        where.addWidget(self.browse)
        begin = QHBoxLayout()
        begin.addWidget(self.resume, 1)
        begin.addWidget(self.check)
        begin.addWidget(self.start)
        form = QFormLayout(self)
        form.setContentsMargins(6, 6, 6, 6)
        form.addRow("Run", parts)
        form.addRow("Session to", where)
        form.addRow("Begin", begin)
