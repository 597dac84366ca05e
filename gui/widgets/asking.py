"""Questions to a person: for a file, for a word. None of them is modal, so that STOP is never behind one.

What was chosen goes to a function; nothing is waited for. A dialog of a purpose is there once: asked for
again, the one before goes.
"""

from collections.abc import Callable
from math import ceil
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QTextDocument
from PySide6.QtWidgets import (
    QDialog,
    QFileDialog,
    QHeaderView,
    QLabel,
    QMessageBox,
    QToolButton,
    QTreeView,
    QWidget,
)

from gui.style.icons import Sign

SIGNS = {
    "backButton": "left",
    "forwardButton": "right",
    "toParentButton": "up",
    "newFolderButton": "plus",
    "listModeButton": "tiles",
    "detailModeButton": "rows",
}
"""Of Qt's own file dialog, whose buttons it draws in black."""
_CHARACTERS = 57
"""In a line of something to read."""
_WIDE_PX, _HIGH_PX = 820, 460
Then = Callable[[Path], object]
ThenAll = Callable[[list[Path]], object]
_FILES = QFileDialog.FileMode


def show(dialog: QDialog, owner: QWidget, purpose: str) -> None:
    """On top of its window, which stays alive below it."""
    for before in owner.findChildren(QDialog, purpose, Qt.FindChildOption.FindDirectChildrenOnly):
        before.close()
        before.deleteLater()
    dialog.setObjectName(purpose)
    dialog.setModal(False)
    dialog.show()
    dialog.raise_()
    dialog.activateWindow()


def ask_open(owner: QWidget, title: str, start: str, kinds: str, then: Then) -> None:
    """For a file that is there."""
    _ask(owner, title, start, kinds, _FILES.ExistingFile, then)


def ask_open_many(owner: QWidget, title: str, start: str, kinds: str, then: Then) -> None:
    """For files; each is told."""
    _ask(owner, title, start, kinds, _FILES.ExistingFiles, then)


def ask_open_all(owner: QWidget, title: str, start: str, kinds: str, then: ThenAll) -> None:
    """For files, all told at once."""
    _ask(owner, title, start, kinds, _FILES.ExistingFiles, then_all=then)


def ask_save(owner: QWidget, title: str, start: str, kinds: str, then: Then) -> None:
    """For a file to be written."""
    _ask(owner, title, start, kinds, _FILES.AnyFile, then)


def ask_folder(owner: QWidget, title: str, start: str, then: Then) -> None:
    """For a folder."""
    _ask(owner, title, start, "", _FILES.Directory, then)


def ask_word(owner: QWidget, title: str, question: str, yes: str, then: Callable[[], object]) -> QMessageBox:
    """For a yes, whose words are given; anything else changes nothing."""
    box = QMessageBox(QMessageBox.Icon.Question, title, question, parent=owner)
    agreed = box.addButton(yes, QMessageBox.ButtonRole.AcceptRole)
    # Enter pressed in haste changes nothing either.
    box.setDefaultButton(box.addButton(QMessageBox.StandardButton.Cancel))
    agreed.clicked.connect(then)
    show(box, owner, title)
    return box


def ask_unsaved(owner: QWidget, what: str, save: Callable[[], object], then: Callable[[], object]) -> None:
    """Before changes to `what` are lost: kept first, lost, or neither; `then` comes after the first two."""
    title = "Not saved"
    box = QMessageBox(QMessageBox.Icon.Question, title, f"{what} was changed and is not saved.", parent=owner)
    kept = box.addButton("Save", QMessageBox.ButtonRole.AcceptRole)
    lost = box.addButton("Discard", QMessageBox.ButtonRole.DestructiveRole)
    box.setDefaultButton(box.addButton(QMessageBox.StandardButton.Cancel))
    kept.clicked.connect(save)
    lost.clicked.connect(then)
    show(box, owner, title)


def tell(owner: QWidget, title: str, text: str) -> None:
    """Something to read."""
    box = QMessageBox(QMessageBox.Icon.NoIcon, title, text, parent=owner)
    box.addButton(QMessageBox.StandardButton.Close)
    # Left to itself it is half as wide as the screen, however small that is.
    label = box.findChild(QLabel, "qt_msgbox_label")
    if label is not None:
        whole = QTextDocument()
        whole.setDefaultFont(label.font())
        whole.setHtml(text)
        # A table's rows are not broken; a word beyond the usual width is.
        wide = max(_CHARACTERS * label.fontMetrics().averageCharWidth(), ceil(whole.idealWidth()))
        label.setMinimumWidth(min(wide, _WIDE_PX))
    show(box, owner, title)


def _ask(
    owner: QWidget,
    title: str,
    start: str,
    kinds: str,
    mode: QFileDialog.FileMode,
    then: Then | None = None,
    *,
    then_all: ThenAll | None = None,
) -> None:
    dialog = _Files(owner, title, then, then_all)
    # The system's own dialogs are modal, and keep the keyboard to themselves.
    dialog.setOption(QFileDialog.Option.DontUseNativeDialog)
    dialog.setFileMode(mode)
    if mode == _FILES.AnyFile:
        dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
    if mode == _FILES.Directory:
        dialog.setOption(QFileDialog.Option.ShowDirsOnly)
    if kinds:
        dialog.setNameFilter(kinds)
    at = Path(start).expanduser() if start else Path.cwd()
    if at.is_dir():
        dialog.setDirectory(str(at))
    else:
        dialog.setDirectory(str(at.parent))
        dialog.selectFile(at.name)
    _dress(dialog)
    show(dialog, owner, title)


def _dress(dialog: QFileDialog) -> None:
    """With signs in the window's colours, and dates and sizes that can be read."""
    for name, sign in SIGNS.items():
        found = dialog.findChild(QToolButton, name)
        if found is not None:
            Sign(found, sign)
    table = dialog.findChild(QTreeView)
    if table is not None:
        header = table.header()
        header.setStretchLastSection(False)
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
    dialog.resize(_WIDE_PX, _HIGH_PX)


class _Files(QFileDialog):
    def __init__(self, owner: QWidget, title: str, then: Then | None, then_all: ThenAll | None) -> None:
        super().__init__(owner, title)
        self._then, self._then_all = then, then_all
        self.accepted.connect(self._tell)

    def _tell(self) -> None:
        chosen = [Path(name) for name in self.selectedFiles() if name]
        if self._then_all is not None and chosen:
            self._then_all(chosen)
        if self._then is not None:
            for path in chosen:
                self._then(path)
