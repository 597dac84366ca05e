"""The main window: bar, pages, log, replay; menus and keys. It shows and passes on, and decides nothing."""

from collections.abc import Sequence
from pathlib import Path
from time import monotonic

from PySide6.QtCore import QSignalBlocker, Qt, QTimer
from PySide6.QtGui import (
    QCloseEvent,
    QDragEnterEvent,
    QDropEvent,
    QKeyEvent,
    QKeySequence,
    QShortcut,
    QShowEvent,
)
from PySide6.QtWidgets import QVBoxLayout, QWidget

from fitting.plugins import told
from gui.actions.controller import AppController
from gui.background.task import BackgroundCommand, BackgroundTask
from gui.bars.replay_bar import ReplayBar
from gui.bars.top_bar import TopBar
from gui.form.form import Form
from gui.frame.leaving import Leaving
from gui.frame.log_pane import LogPane
from gui.frame.menus import Menus
from gui.frame.notice import Notice
from gui.frame.page_set import PageSet, key_of
from gui.frame.page_tabs import PageTabs
from gui.frame.settings import Arrangement, Settings
from gui.frame.shell import Shell
from gui.frame.stop_guard import StopGuard
from gui.frame.tab_order import neighbour
from gui.page import Page
from gui.style.theme import Appearance
from gui.widgets.asking import ask_open_many
from instrument.files.acceleration import show_acceleration_in
from instrument.interchange.given import SESSION_ENDINGS

TURN_MS = 33
"""Between two looks at what has come: 30 a second."""
_REST, _MOST_REST_MS = 3.0, 300.0
"""Times as long as a look came late, until the next one; at most."""
_LAYOUT = 1
"""Raised when docks change: an older arrangement is not restored then."""


class Window(Shell):
    """One window, one session."""

    def __init__(self, appearance: Appearance, settings: Settings) -> None:
        super().__init__()
        self.appearance, self.settings = appearance, settings
        show_acceleration_in(settings.acceleration)
        self.setWindowTitle("viscorig")
        self.setAcceptDrops(True)
        self.controller = AppController(self)
        self.bar, self.notice = TopBar(self.controller), Notice()
        self.tabs = PageTabs()
        self.tabs.setDocumentMode(True)
        self._page_set = PageSet(self.controller)
        self.replay = ReplayBar()
        self.log = LogPane()
        self._guard = StopGuard(self.bar.stop, self.controller.commands.stop, self._escaped)
        self._leaving, self._may_lose = Leaving(self, self.controller), False
        self._undrawn = list(reversed(self._page_set.kinds))
        self._arrange()
        # Files and what is run with them are its matter, whichever page is seen.
        self._page("run")
        self.menus = Menus(self)
        self._shortcuts()
        self.controller.changed.connect(self._changed)
        self.controller.refused.connect(self.notice.refuse)
        self.controller.said.connect(self.notice.say)
        self.controller.busy.connect(self._busy)
        self.controller.experiment_chosen.connect(self._chosen)
        self.controller.page_wanted.connect(self.show_page)
        for work in (self.controller, self.controller.together, self.controller.rediagnosis):
            # What was said before is not of it: that a shaker did not answer, of a run before this one.
            work.began.connect(self.notice.hide)
        self.controller.together.chosen.connect(self.notice.hide)
        self.controller.together.remember(settings.specimens)
        self.controller.together.specimen_chosen.connect(settings.remember_specimen)
        self.replay.compare_wanted.connect(self._ask_compare)
        self._timer = QTimer(self)
        self._timer.setInterval(TURN_MS)
        self._timer.timeout.connect(self._tick)
        self._ticked_s = monotonic()
        self._timer.start()
        self._first_drawing = QTimer(self)
        self._first_drawing.timeout.connect(self._draw_next)
        self._restore(settings.arrangement)
        if told():
            self.notice.refuse("; ".join(told()))

    def turn(self) -> None:
        """Take what has come and show it."""
        self.controller.advance()
        busy = self.controller.running or self.controller.starting
        self._guard.be_on_duty(busy)
        self.appearance.hold(busy)
        state = self.controller.state
        self.bar.show_state(state)
        self.log.show_state(state)
        self._page_set.show_state(state)
        self._leaving.turn()

    @property
    def pages(self) -> tuple[Page, ...]:
        """All of them, in the order of their keys; those not made yet are made."""
        return tuple(self._page(name) for name in self._page_set.kinds)

    @property
    def page_titles(self) -> dict[str, str]:
        """By the pages' names, in the order of their keys."""
        return {name: kind.title for name, kind in self._page_set.kinds.items()}

    def open(self, path: Path) -> None:
        """A session, an experiment, or other data; returns at once."""
        self._open_all([path])

    def show_page(self, name: str) -> None:
        """As `gui.pages` calls it; the first one where there is none of this name."""
        known = name if name in self._page_set.kinds else next(iter(self._page_set.kinds))
        self.tabs.setCurrentWidget(self._page(known))

    def show_acceleration_in(self, name: str) -> None:
        """Bar, pages and fields in this unit from now on; lines of the log that come from now on."""
        self.settings.acceleration = name
        show_acceleration_in(name)
        for form in self.findChildren(Form):
            form.say_units()
        self._page_set.redraw()
        self.turn()

    def interrupt(self) -> None:
        """Ctrl-C on the terminal: closes as a person does; another one is a yes to whether a run may end."""
        if not self._leaving.insist():
            self.close()

    # What Qt tells

    def showEvent(self, event: QShowEvent) -> None:
        """Make and draw every page once now: the first time takes longest, and must not fall into a run."""
        super().showEvent(event)
        self._first_drawing.start()

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Files may be dropped anywhere."""
        if event.mimeData().hasUrls():
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open what was dropped."""
        event.acceptProposedAction()
        urls = event.mimeData().urls()
        self._open_all([Path(url.toLocalFile()) for url in urls if url.isLocalFile()])
        for url in urls:
            if not url.isLocalFile():
                self.notice.refuse(f"{url.toString()}: not a file of this computer")

    def closeEvent(self, event: QCloseEvent) -> None:
        """A run is not ended, and nothing unsaved lost, without asking."""
        if self.controller.running:
            # It closes by itself once the run has ended.
            event.ignore()
            self._leaving.ask()
            return
        unsaved = next((page for page in self._page_set.made.values() if page.unsaved), None)
        if unsaved is not None and not self._may_lose:
            event.ignore()
            unsaved.before_lost(self._lose)
            return
        self._timer.stop()
        self._first_drawing.stop()
        self.settings.keep(
            Arrangement(self.saveGeometry(), self.saveState(_LAYOUT), self.tabs.currentWidget().objectName()),
            self.appearance,
        )
        for work in self.findChildren(BackgroundTask):
            work.close()
        for command in self.findChildren(BackgroundCommand):
            command.close()
        self.controller.close()
        self._guard.be_on_duty(False)
        super().closeEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Esc takes the message away; what it does in a run is the guard's matter."""
        if event.key() == Qt.Key.Key_Escape and not self.controller.running:
            self.notice.hide()
        super().keyPressEvent(event)

    def focusNextPrevChild(self, forward: bool) -> bool:
        """Tab goes through what is seen from above to below: bar, page, recording, log."""
        parts = (self.bar, self.tabs.tabBar(), self.tabs.currentWidget(), self.replay, self.log)
        found = neighbour(parts, self.focusWidget(), forward=forward)
        if found is None:
            return False
        reason = Qt.FocusReason
        found.setFocus(reason.TabFocusReason if forward else reason.BacktabFocusReason)
        return True

    # Inside

    def _open_all(self, paths: Sequence[Path]) -> None:
        """What was said before is not of these."""
        assert self.pages, "what is opened is told to every page"
        self.notice.hide()
        self.controller.open_all(paths)

    def _tick(self) -> None:
        """Turn; in a run look again later where the machine is behind: painting must not fill its time."""
        now = monotonic()
        late_ms = 1e3 * (now - self._ticked_s) - self._timer.interval()
        self._ticked_s = now
        self.turn()
        rest_ms = min(_MOST_REST_MS, max(0.0, _REST * late_ms)) if self.controller.running else 0.0
        self._timer.setInterval(TURN_MS + round(rest_ms))

    def _draw_next(self) -> None:
        """A page is made in one turn of the event loop and drawn in the next."""
        if not self._undrawn:
            self._first_drawing.stop()
            return
        if self._undrawn[-1] not in self._page_set.made:
            self._page(self._undrawn[-1])
            return
        page, shown = self._page(self._undrawn.pop()), self.tabs.currentWidget()
        if page is not shown:
            page.resize(shown.size())
            page.grab()

    def _arrange(self) -> None:
        for number, (name, kind) in enumerate(self._page_set.kinds.items()):
            self._put(number, self._page_set.made.get(name) or _room_for(name), kind)
        self.tabs.currentChanged.connect(self._tab_chosen)
        whole = QWidget()
        column = QVBoxLayout(whole)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.bar)
        column.addWidget(self.tabs, 1)
        column.addWidget(self.replay)
        self.setCentralWidget(whole)
        # What comes and goes moves nothing, and covers nothing that can be pressed.
        self.notice.float_beside(self.tabs)
        self.addDockWidget(Qt.DockWidgetArea.BottomDockWidgetArea, self.log)
        self.resize(1280, 720)
        self.resizeDocks([self.log], [76], Qt.Orientation.Vertical)

    def _page(self, name: str) -> Page:
        """Of this name, in its tab."""
        page = self._page_set.page(name)
        at = list(self._page_set.kinds).index(name)
        room = self.tabs.widget(at)
        if room is not page:
            shown = self.tabs.currentIndex()
            with QSignalBlocker(self.tabs):
                self._put(at, page, type(page))
                self.tabs.removeTab(at + 1)
                self.tabs.setCurrentIndex(shown)
            if room is not None:
                room.deleteLater()
        return page

    def _put(self, at: int, widget: QWidget, kind: type[Page]) -> None:
        key = key_of(at)
        self.tabs.insertTab(at, widget, kind.title)
        self.tabs.setTabToolTip(at, f"{kind.hint} ({key})" if key else kind.hint)

    def _tab_chosen(self, at: int) -> None:
        self._page(list(self._page_set.kinds)[at])

    def _restore(self, before: Arrangement) -> None:
        if before.geometry is not None:
            self.restoreGeometry(before.geometry)
        if before.docks is not None:
            self.restoreState(before.docks, _LAYOUT)
        self.show_page(before.page)

    def _shortcuts(self) -> None:
        for keys, slot in (
            ("F9", self.controller.commands.hold),
            ("Ctrl+F9", self.controller.commands.abort),
            ("Ctrl+Return", self.controller.commands.answer),
            ("Ctrl+Space", self.replay.toggle),
            ("Ctrl+Left", self.replay.to_mark_before),
            ("Ctrl+Right", self.replay.to_next_mark),
        ):
            shortcut = QShortcut(QKeySequence(keys), self)
            shortcut.setContext(Qt.ShortcutContext.ApplicationShortcut)
            shortcut.activated.connect(slot)

    def _escaped(self) -> None:
        if self.controller.running:
            self.notice.say("Esc once more stops the shaker")

    def _chosen(self, path: Path) -> None:
        """The page that runs experiments shows them."""
        self.settings.remember(path)
        self.menus.refresh()
        self.show_page("run")

    def _ask_compare(self) -> None:
        endings = " ".join(f"*{ending}" for ending in SESSION_ENDINGS)
        shown = self.controller.recorded
        start = str(shown.path.parent) if shown is not None else ""
        ask_open_many(self, "Compare with", start, f"Sessions ({endings})", self._compare)

    def _compare(self, path: Path) -> None:
        """Shown where laws are drawn beside each other."""
        self.show_page("material")
        self.controller.compare(path)

    def _changed(self) -> None:
        recorded = self.controller.recorded
        self.replay.show_feed(recorded)
        if recorded is not None:
            self.settings.remember(recorded.path)
        self.setWindowTitle(f"{recorded.path.name} - viscorig" if recorded is not None else "viscorig")
        self.menus.refresh()
        self.turn()

    def _busy(self, name: str) -> None:
        self.statusBar().setVisible(bool(name))
        self.statusBar().showMessage(f"reading {name} ..." if name else "")

    def _lose(self) -> None:
        """What was not saved is, or is not wanted."""
        self._may_lose = True
        self.close()


def _room_for(name: str) -> QWidget:
    """Of a page that is not made yet."""
    room = QWidget()
    room.setObjectName(name)
    return room
