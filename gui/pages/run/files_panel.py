"""The experiment and the files it names: opened, edited in forms, saved."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from fitting.specimen import Kind
from gui.background.task import BackgroundTask, Progress
from gui.form.drafts import Drafts
from gui.form.form import Form
from gui.pages.run.disk_watch import DiskWatch
from gui.pages.run.new_case import NewCase, write
from gui.widgets.asking import ask_open, ask_save, ask_unsaved, show
from gui.widgets.basic import button, hint

_FOLDER = "viscorig-experiment"
_KINDS = "Experiments (*.toml);;Everything (*)"


class FilesPanel(QWidget):
    """Reads and writes off the main thread.

    Signals
    -------
    opened
        `drafts` is another experiment, or the same one read again.
    edited
        A value was changed.
    saved
        All of it is on the disk.
    outdated
        Another program has written one of the files since it was read.
    chose
        Path of a file to open.
    failed, said
        One line.
    """

    opened = Signal()
    edited = Signal()
    saved = Signal()
    outdated = Signal()
    chose = Signal(Path)
    failed = Signal(str)
    said = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.drafts: Drafts | None = None
        self.forms: dict[str, Form] = {}
        self._work: BackgroundTask[object] | None = None
        self._named: tuple[object, object] = (None, None)
        self._after_saving: Callable[[], object] | None = None
        self._locked = False
        self._watch = DiskWatch(self)
        self._watch.touched.connect(self.look)
        self.changed_elsewhere: list[Path] = []
        """Files that are not as the forms show them, as they were looked at last."""
        self.name = QLabel()
        self.name.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.open_button = button("Open...", "An experiment file (Ctrl+O)", "open")
        self.new_button = button(
            "New...", "Files of an experiment, its rig simulated or real (Ctrl+N)", "new"
        )
        self.new_button.setShortcut("Ctrl+N")
        self.save_button = button("Save", "Keep the changes; comments stay (Ctrl+S)", "save")
        self.save_button.setShortcut("Ctrl+S")
        self.save_as_button = button("Save as...", "The experiment and its files in another place")
        self.faults_button = button("", "Go to the first field that is wrong")
        self.fault = QLabel()
        self.fault.setWordWrap(True)
        self.outdated_words = QLabel()
        self.outdated_words.setWordWrap(True)
        self.read_again = button("Read again", "The files as they are on the disk now (F6)")
        self.read_again.setShortcut("F6")
        self.tabs = QTabWidget()
        self.tabs.setDocumentMode(True)
        self.nothing = hint(
            "No experiment is open. Open an EXPERIMENT.toml (or drop one on the window), or make a new one: "
            "for a simulated rig nothing needs to be connected."
        )
        self._arrange()
        self.open_button.clicked.connect(self._ask_open)
        self.new_button.clicked.connect(self._ask_new)
        self.save_button.clicked.connect(self.save)
        self.save_as_button.clicked.connect(self._ask_save_as)
        self.faults_button.clicked.connect(self.show_fault)
        self.read_again.clicked.connect(self._read_again)
        self._show()

    @property
    def changed(self) -> bool:
        """Whether something is not saved."""
        return self.drafts is not None and self.drafts.changed

    @property
    def path(self) -> Path | None:
        """Path of the experiment's file; None while none is open."""
        return self.drafts.experiment.path if self.drafts is not None else None

    def open(self, path: Path) -> None:
        """Read an experiment and the files it names."""
        self.before_lost(partial(self._begin, partial(_read, path), self._take))

    def before_lost(self, then: Callable[[], object]) -> None:
        """Go on with `then`; where changes are not saved a person is asked first."""
        if self.drafts is None or not self.changed:
            then()
            return
        ask_unsaved(self, self.drafts.experiment.path.name, partial(self._save_first, then), then)

    @property
    def outdated_said(self) -> str:
        """Which files are not as the forms show them, and what to do; empty where all are."""
        if not self.changed_elsewhere:
            return ""
        names = ", ".join(path.name for path in self.changed_elsewhere)
        return f"{names}: changed by another program since it was read here: read it again (F6)"

    def look(self) -> None:
        """Whether the files are as the forms show them; while they are read or saved, when that is over."""
        if self.drafts is None or self._locked or (self._work is not None and not self._work.over):
            return
        before, self.changed_elsewhere = self.changed_elsewhere, self.drafts.changed_elsewhere
        self._watch.follow(self.drafts.files)
        self._say_outdated()
        if self.changed_elsewhere and self.changed_elsewhere != before:
            self.outdated.emit()

    def _save_first(self, then: Callable[[], object]) -> None:
        self.save()
        self._after_saving = then

    def make(self, folder: Path, effect: str | None, seed: int, specimen: Kind = "plate") -> None:
        """Write the files of a new experiment and open them; without an `effect` of a real rig."""
        self._begin(partial(_make, folder, effect, seed, specimen), self._made)

    def save(self) -> None:
        """Every changed file."""
        self._after_saving = None
        drafts = self.drafts
        if drafts is not None:
            self._begin(partial(_save, drafts, None), self._saved)

    def save_as(self, path: Path) -> None:
        """All files, the others beside the experiment."""
        self._after_saving = None
        drafts = self.drafts
        if drafts is not None:
            self._begin(partial(_save, drafts, path), self._saved)

    def show_fault(self) -> None:
        """The tab and the field of the first one."""
        for k, form in enumerate(self.forms.values()):
            if form.draft.faults():
                self.tabs.setCurrentIndex(k)
                form.show_fault()
                return

    def lock(self, locked: bool) -> None:
        """While a run goes on its files stay as they are."""
        self._locked = locked
        for widget in (self.tabs, self.open_button, self.new_button, self.read_again):
            widget.setEnabled(not locked)
        if locked:
            self.save_button.setEnabled(False)
            self.save_as_button.setEnabled(False)
        else:
            self._say()
            self.look()

    # Inside

    def _begin(self, function: Callable[[Progress], object], then: Callable[[object], None]) -> None:
        if self._work is not None:
            self._work.cancel()
        self._work = work = BackgroundTask(function, self)
        work.done.connect(then)
        work.failed.connect(self._failed)
        work.start()

    def _failed(self, message: str) -> None:
        self.look()
        self.failed.emit(message)

    def _read_again(self) -> None:
        if self.path is not None:
            self.open(self.path)

    def _take(self, found: object) -> None:
        assert isinstance(found, Drafts)
        self.drafts = found
        self._named = self._names_given()
        again = bool(self.changed_elsewhere)
        self.look()
        self._show()
        if again:
            self.said.emit(f"read {found.experiment.path}")
        for problem in found.problems:
            self.failed.emit(problem)
        self.opened.emit()

    def _made(self, path: object) -> None:
        assert isinstance(path, Path)
        self.chose.emit(path)

    def _saved(self, path: object) -> None:
        assert isinstance(path, Path)
        self.said.emit(f"saved {path}")
        self._say()
        self.look()
        self.saved.emit()
        then, self._after_saving = self._after_saving, None
        if then is not None:
            then()
        elif self._names_given() != self._named:
            self.open(path)

    def _names_given(self) -> tuple[object, object]:
        if self.drafts is None:
            return None, None
        return self.drafts.experiment.value(("rig",)), self.drafts.experiment.value(("specimen",))

    def _show(self) -> None:
        at = self.tabs.currentIndex()
        with QSignalBlocker(self.tabs):
            while self.tabs.count():
                self.tabs.removeTab(0)
            for form in self.forms.values():
                form.deleteLater()
            self.forms = {}
            for name, draft in (self.drafts.all if self.drafts is not None else {}).items():
                form = Form(draft)
                form.edited.connect(self._edited)
                self.forms[name] = form
                self.tabs.addTab(form, name.capitalize())
            self.tabs.setCurrentIndex(max(0, min(at, self.tabs.count() - 1)))
        self.nothing.setVisible(self.drafts is None)
        self.tabs.setVisible(self.drafts is not None)
        self._say()

    def _edited(self) -> None:
        self._say()
        self.edited.emit()

    def _say(self) -> None:
        """How many faults each file has, and whether it is saved."""
        for k, (name, form) in enumerate(self.forms.items()):
            faults = len(form.draft.faults())
            mark = "*" if form.draft.changed else ""
            self.tabs.setTabText(k, f"{name.capitalize()}{mark}" + (f"  \u2716 {faults}" if faults else ""))
            self.tabs.setTabToolTip(k, str(form.draft.path))
        count = sum(len(form.draft.faults()) for form in self.forms.values())
        self.faults_button.setText(f"\u2716 {count} wrong: show" if count else "")
        self.faults_button.setVisible(bool(count))
        self.fault.setText(self._first_fault())
        self.fault.setVisible(bool(count))
        self._say_outdated()
        self.name.setText(str(self.path) if self.path is not None else "")
        self.name.setToolTip(self.name.text())
        self.save_button.setEnabled(self.changed)
        self.save_as_button.setEnabled(self.drafts is not None)

    def _say_outdated(self) -> None:
        said = self.outdated_said
        self.outdated_words.setText(f"\u26a0 {said}")
        for widget in (self.outdated_words, self.read_again):
            widget.setVisible(bool(said))

    def _first_fault(self) -> str:
        """In whole: beside its field there is room for some words only."""
        for name, form in self.forms.items():
            for place, said in form.draft.faults().items():
                return f"{name}: {'.'.join(map(str, place))}: {said}".replace(": : ", ": ")
        return ""

    def _ask_open(self) -> None:
        start = str(self.path.parent) if self.path is not None else ""
        ask_open(self, "Open experiment", start, _KINDS, self.chose.emit)

    def _ask_new(self) -> None:
        dialog = NewCase(_free_folder(Path.cwd()), self)
        dialog.accepted.connect(self._make_asked)
        show(dialog, self, "New experiment")

    def _make_asked(self) -> None:
        dialog = self.sender()
        assert isinstance(dialog, NewCase)
        self.make(*dialog.order())

    def _ask_save_as(self) -> None:
        suggested = str(self.path) if self.path is not None else ""
        ask_save(self, "Save experiment", suggested, _KINDS, self._save_as)

    def _save_as(self, path: Path) -> None:
        self.save_as(path if path.suffix else path.with_suffix(".toml"))

    def _arrange(self) -> None:
        buttons = QHBoxLayout()
        for one in (self.open_button, self.new_button, self.save_button, self.save_as_button):
            buttons.addWidget(one)
        buttons.addStretch(1)
        buttons.addWidget(self.faults_button)
        column = QVBoxLayout(self)
        column.setContentsMargins(6, 6, 6, 6)
        column.addLayout(buttons)
        column.addWidget(self.name)
        again = QHBoxLayout()
        again.addWidget(self.outdated_words, 1)
        again.addWidget(self.read_again)
        column.addLayout(again)
        column.addWidget(self.fault)
        column.addWidget(self.nothing)
        column.addWidget(self.tabs, 1)
        self.filler = QWidget()
        column.addWidget(self.filler)


def _free_folder(inside: Path) -> Path:
    for number in range(1, 1000):
        folder = inside / (_FOLDER if number == 1 else f"{_FOLDER}-{number}")
        if not folder.exists():
            return folder
    return inside / _FOLDER


def _read(path: Path, _: Progress) -> Drafts:
    drafts = Drafts.of(path)
    # Looked up here, where nobody waits for it.
    tuple(draft.asks for draft in drafts.all.values())
    return drafts


def _make(folder: Path, effect: str | None, seed: int, specimen: Kind, _: Progress) -> Path:
    return write(folder, effect, seed, specimen)


def _save(drafts: Drafts, path: Path | None, _: Progress) -> Path:
    return drafts.save() if path is None else drafts.save_as(path)
