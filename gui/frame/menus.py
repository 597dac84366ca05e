"""The menus. Every entry has a key or a place that is easy to guess."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMenu

from gui.actions.controller import EXPERIMENT_ENDING
from gui.actions.export import Export
from gui.actions.printing import Printing
from gui.actions.taking_together import TOGETHER, ask_together
from gui.frame.page_set import key_of
from gui.frame.shell import Shell
from gui.style.theme import SCALES, Mode
from gui.widgets.asking import ask_open, tell
from instrument.files.acceleration import UNITS, acceleration_unit
from instrument.interchange.given import SESSION_ENDINGS
from instrument.interchange.readers import foreign_endings

_KEYS = """
Ctrl+1, Ctrl+2, ...\tthe pages
F12, or Esc twice\tstop the shaker at once
F9\thold, resume
Ctrl+F9\tend the run in order
Ctrl+Return\twhat the run asks for is done
Ctrl+N, Ctrl+S\ta new experiment, save it
F7, F5\tcheck it, start it
F6\tread files again that another program has changed
Ctrl+O\topen a session, an experiment or other data
Ctrl+Shift+O\tadd files that are fitted together
Ctrl+I, Ctrl+D\tof several files: identify, diagnose
Ctrl+R, Ctrl+Shift+P\tsave the report as a page, as a PDF
Ctrl+P\tprint the report
Ctrl+Space\tplay, pause
Ctrl+Left, Ctrl+Right\tto the mark before, to the next
Ctrl++, Ctrl+-, Ctrl+0\tlarger, smaller, usual type
F11\tfull screen
Tab, Shift+Tab\tto what stands next, before
up, down, space, Enter\tin a form: to a row, tick its table, into its field (Esc: back)
right mouse button, menu key\ta plot's menu: ranges, cursors, export
""".strip()


class Menus(QObject):
    """The menus of one window."""

    def __init__(self, window: Shell) -> None:
        super().__init__(window)
        self._window = window
        self._export = Export(window.controller, window)
        for said in (self._export.began, self._export.done):
            said.connect(window.notice.say)
        self._export.failed.connect(window.notice.refuse)
        self._printing = Printing(window.controller, window)
        self._printing.done.connect(window.notice.say)
        self._printing.failed.connect(window.notice.refuse)
        self._file()
        self._pages()
        self._view()
        self._help()
        self.refresh()

    def refresh(self) -> None:
        """What can be done now."""
        recorded = self._window.controller.recorded is not None
        for action in self._of_session:
            action.setEnabled(recorded)
        self._recent.clear()
        for path in self._window.settings.recent:
            action = self._recent.addAction(str(path))
            action.setData(path)
            action.triggered.connect(self._open_recent)
        self._recent.setEnabled(not self._recent.isEmpty())

    def _file(self) -> None:
        menu = self._window.menuBar().addMenu("&File")
        self._add(menu, "&Open...", self._open, "Ctrl+O")
        self._add(menu, "Add files to fit &together...", self._add_together, "Ctrl+Shift+O")
        self._recent = menu.addMenu("Open &recent")
        close = self._add(menu, "&Close session", self._window.controller.leave, "Ctrl+W")
        menu.addSeparator()
        self._of_session = [close, self._add(menu, "Save &report...", self._export.report, "Ctrl+R")]
        self._of_session.append(
            self._add(menu, "Save report as &PDF...", self._export.report_to_print, "Ctrl+Shift+P")
        )
        self._of_session.append(self._add(menu, "Pr&int report...", self._printing.ask, "Ctrl+P"))
        data = menu.addMenu("&Export data")
        for kind, said in (("csv", "CSV..."), ("uff", "Universal file..."), ("mat", "MATLAB...")):
            action = self._add(data, said, self._export.data)
            action.setData(kind)
            self._of_session.append(action)
        menu.addSeparator()
        self._add(menu, "&Quit", self._window.close, "Ctrl+Q")

    def _pages(self) -> None:
        menu = self._window.menuBar().addMenu("&Page")
        for number, (name, title) in enumerate(self._window.page_titles.items()):
            keys = [key] if (key := key_of(number)) else []
            self._add(menu, title, self._show_page, *keys).setData(name)

    def _view(self) -> None:
        menu = self._window.menuBar().addMenu("&View")
        group = QActionGroup(self)
        modes: tuple[tuple[Mode, str], ...] = (
            ("system", "As the &system"),
            ("light", "&Light"),
            ("dark", "&Dark"),
        )
        for mode, said in modes:
            action = self._add(menu, said, self._choose_mode)
            action.setCheckable(True)
            action.setChecked(self._window.appearance.mode == mode)
            action.setData(mode)
            group.addAction(action)
        menu.addSeparator()
        self._add(menu, "L&arger type", self._larger, "Ctrl++", "Ctrl+=")
        self._add(menu, "S&maller type", self._smaller, "Ctrl+-")
        self._add(menu, "&Usual type", self._usual, "Ctrl+0")
        menu.addSeparator()
        self._units(menu)
        menu.addSeparator()
        menu.addAction(self._window.log.toggleViewAction())
        self._add(menu, "&Full screen", self._full_screen, "F11")

    def _units(self, menu: QMenu) -> None:
        group = QActionGroup(self)
        for name, unit in UNITS.items():
            action = self._add(menu, f"Acceleration in {unit.symbol}", self._choose_acceleration)
            action.setCheckable(True)
            action.setChecked(unit is acceleration_unit())
            action.setData(name)
            group.addAction(action)

    def _help(self) -> None:
        menu = self._window.menuBar().addMenu("&Help")
        self._add(menu, "&Keys", self._keys, "F1")

    def _add(self, menu: QMenu, text: str, slot: Callable[..., object], *keys: str) -> QAction:
        action = menu.addAction(text)
        action.setShortcuts([QKeySequence(key) for key in keys])
        action.triggered.connect(slot)
        return action

    def _data(self) -> object:
        action = self.sender()
        assert isinstance(action, QAction)
        return action.data()

    def _open(self) -> None:
        endings = " ".join(f"*{e}" for e in (*SESSION_ENDINGS, EXPERIMENT_ENDING, *foreign_endings()))
        kinds = f"Sessions, experiments and data ({endings});;Everything (*)"
        ask_open(self._window, "Open", "", kinds, self._window.open)

    def _add_together(self) -> None:
        self._window.show_page(TOGETHER)
        ask_together(self._window, self._window.controller.together)

    def _open_recent(self) -> None:
        self._window.open(Path(str(self._data())))

    def _show_page(self) -> None:
        self._window.show_page(str(self._data()))

    def _choose_mode(self) -> None:
        mode = self._data()
        if mode in ("system", "light", "dark"):
            self._window.appearance.choose(mode)
            self._say_waiting()

    def _choose_acceleration(self) -> None:
        self._window.show_acceleration_in(str(self._data()))

    def _larger(self) -> None:
        self._resize(min((s for s in SCALES if s > self._window.appearance.scale), default=SCALES[-1]))

    def _smaller(self) -> None:
        self._resize(max((s for s in SCALES if s < self._window.appearance.scale), default=SCALES[0]))

    def _usual(self) -> None:
        self._resize(1.0)

    def _resize(self, scale: float) -> None:
        self._window.appearance.resize(scale)
        self._say_waiting()

    def _say_waiting(self) -> None:
        if self._window.appearance.waiting:
            self._window.notice.say("shown once the run has ended: STOP would wait for it meanwhile")

    def _full_screen(self) -> None:
        if self._window.isFullScreen():
            self._window.showNormal()
        else:
            self._window.showFullScreen()

    def _keys(self) -> None:
        rows = "".join(
            f"<tr style='white-space:pre'><td><b>{keys}</b>  </td><td>{does}</td></tr>"
            for keys, does in (line.split("\t") for line in _KEYS.splitlines())
        )
        tell(self._window, "Keys", f"<table>{rows}</table>")
