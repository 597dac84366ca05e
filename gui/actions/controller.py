"""What a person can do, whichever page or key asks for it; and the session the window shows."""

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from gui.actions.data_beside import DataBeside
from gui.actions.laid_words import laid_words, unseen_words
from gui.actions.one_message import OneMessage
from gui.actions.rediagnosis import Rediagnosis
from gui.actions.run_commands import RunCommands
from gui.actions.starting import Starting
from gui.actions.together import Together
from gui.feeds.feed import Feed
from gui.feeds.live import LiveFeed
from gui.feeds.recorded import RecordedFeed
from gui.state import SessionState
from instrument.engine import Engine, Order, Stopped
from instrument.engine.client import ENGINE
from instrument.engine.messages import Ended
from instrument.files.toml_kind import kind_of_toml
from instrument.interchange.found import Found
from instrument.interchange.given import SESSION_ENDINGS, is_session
from instrument.interchange.readers import foreign_endings
from instrument.session.configuration import Configuration

EXPERIMENT_ENDING = ".toml"
BROKEN_OFF = ".running"
"""Of the folder of a run that was not completed, beside its session."""


class AppController(QObject):
    """Holds at most one feed.

    Signals
    -------
    changed
        Another feed, or none: `feed`, `live`, `recorded` say which.
    began
        A run was asked for.
    refused
        One line: something could not be done. What was there is untouched.
    said
        One line: something was done.
    busy
        A file is being read: its name; empty once it is.
    beside_changed
        `beside` holds other data now.
    experiment_chosen
        Path of an experiment file, to be shown and run.
    comparison_wanted
        Path of a session whose law is to be laid beside this one's.
    page_wanted
        Name of a page to be shown, as `gui.pages` calls it.
    """

    changed = Signal()
    began = Signal()
    refused = Signal(str)
    said = Signal(str)
    busy = Signal(str)
    beside_changed = Signal()
    experiment_chosen = Signal(Path)
    comparison_wanted = Signal(Path)
    page_wanted = Signal(str)
    engine: Sequence[str] = ENGINE
    """The program runs live in."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.feed: Feed | None = None
        self.data_beside = DataBeside(self)
        self.rediagnosis = Rediagnosis(self)
        self.together = Together(self.rediagnosis, self)
        self.commands = RunCommands(lambda: self.live, lambda: self._starting, self)
        self.changed.connect(self.together.let_go)
        self.changed.connect(self.rediagnosis.let_go)
        self.ending: Ended | None = None
        """Of the last run; None while one goes on."""
        self._opening: RecordedFeed | None = None
        self._starting: Starting | None = None
        self._opening_all = False
        self._of_files = OneMessage(lambda: self._awaits_files, self.said.emit, self.refused.emit)
        self.data_beside.changed.connect(self.beside_changed)
        self.data_beside.renewed.connect(self.rediagnosis.let_go_of)
        self.data_beside.read.connect(self._laid)
        self.data_beside.failed.connect(self._of_files.refuse)
        self.data_beside.busy.connect(self.busy)

    @property
    def beside(self) -> dict[Path, Found]:
        """Other programs' data and other sessions' sweeps, to be drawn beside the session's."""
        return self.data_beside.files

    @property
    def state(self) -> SessionState | None:
        """Of the session shown; None where there is none."""
        return self.feed.state if self.feed is not None else None

    @property
    def live(self) -> LiveFeed | None:
        """The run, also after its end; None where the window shows a recording or nothing."""
        return self.feed if isinstance(self.feed, LiveFeed) else None

    @property
    def recorded(self) -> RecordedFeed | None:
        """The recording shown, if one is."""
        return self.feed if isinstance(self.feed, RecordedFeed) else None

    @property
    def session(self) -> Path | None:
        """The file of the session shown; None while it is being measured."""
        if self.recorded is not None:
            return self.recorded.path
        return self.live.ending.session if self.live is not None and self.live.ending is not None else None

    @property
    def running(self) -> bool:
        """Whether a run goes on."""
        return self.commands.running

    @property
    def starting(self) -> bool:
        """Whether the files of a run are being read that is to begin."""
        return self._starting is not None

    def advance(self) -> None:
        """One turn: whatever has come is taken."""
        if self._opening is not None:
            self._opening.advance()
        if self.feed is not None:
            self.feed.advance()

    # Files

    def open_all(self, paths: Sequence[Path]) -> None:
        """What `open` takes, and one message of all of it. Returns at once."""
        self._of_files.begin()
        self._opening_all = True
        for path in paths:
            self.open(path)
        self._opening_all = False
        self._of_files.settle()

    def open(self, path: Path) -> None:
        """A session, an experiment, or another program's data; returns at once."""
        ending = path.suffix.lower()
        if path.is_dir():
            self._of_files.refuse(_said_of_folder(path))
        elif ending == EXPERIMENT_ENDING:
            self._choose_experiment(path)
        elif is_session(path):
            self._open_session(path)
        elif ending in foreign_endings():
            self.data_beside.lay(path)
        else:
            known = ", ".join((EXPERIMENT_ENDING, *SESSION_ENDINGS, *foreign_endings()))
            self._of_files.refuse(f"{path}: ending {path.suffix!r}, expected one of {known}")

    def _choose_experiment(self, path: Path) -> None:
        if self.running or self.starting:
            self._of_files.refuse(f"{path.name}: not opened: a run goes on")
            return
        kind = kind_of_toml(path)
        if kind in ("an experiment", ""):
            self.experiment_chosen.emit(path)
            return
        then = "a new one (Ctrl+N) names it"
        if kind == "a specimen":
            then += "; Several files takes it where it is dropped on its data"
        self._of_files.refuse(f"{path.name}: {kind}, expected an experiment: {then}")

    def compare(self, path: Path) -> None:
        """Lay another session beside this one: its law and its sweep. Returns at once."""
        self.comparison_wanted.emit(path)
        self.data_beside.lay(path)

    def leave(self) -> None:
        """Close the session shown."""
        if self.running:
            self.refused.emit("a run goes on: end it first")
            return
        self.data_beside.take_away()
        self._show(None)

    # A run

    def start(self, order: Order) -> None:
        """Begin a run; what is wrong with its files is said before. Returns at once; `changed` tells."""
        if self.running or self.starting:
            self.refused.emit("a run goes on already")
            return
        self.began.emit()
        self._starting = Starting(order, self)
        self._starting.done.connect(self._started)
        self._starting.failed.connect(self._not_started)
        self._starting.cancelled.connect(self._start_cancelled)
        self._starting.start()

    def close(self) -> None:
        """Let go of everything."""
        self.together.close()
        self.rediagnosis.close()
        self.data_beside.close()
        if self._starting is not None:
            self._starting.close()
        for feed in (self._opening, self.feed):
            if feed is not None:
                feed.close()
        self.feed = self._opening = None

    # Inside

    @property
    def _awaits_files(self) -> bool:
        return self._opening_all or self.data_beside.reading or self._opening is not None

    def _started(self, configuration: object) -> None:
        work, self._starting = self._starting, None
        assert work is not None
        assert isinstance(configuration, Configuration)
        feed = LiveFeed(work.order, configuration, self, Engine.start(work.order, self.engine))
        feed.ended.connect(self._ended)
        feed.stopped.connect(self._stopped)
        self.ending = None
        work.deleteLater()
        # Other data would lie on the points that come.
        self.data_beside.take_away()
        self._show(feed)

    def _not_started(self, message: str) -> None:
        if self._starting is not None:
            self._starting.deleteLater()
        self._starting = None
        self.refused.emit(message)

    def _start_cancelled(self) -> None:
        self._not_started("stopped before it began: nothing was driven")

    def _ended(self) -> None:
        """What was recorded takes the run's place: from now on it can be looked through."""
        self.ending = self.live.ending if self.live is not None else None
        if self.ending is not None and self.ending.session is not None:
            self._open_session(self.ending.session)

    def _stopped(self, result: object) -> None:
        assert isinstance(result, Stopped)
        if result.silent:
            self.said.emit(f"{result.message}, {result.seconds:.2f} s after the stop")
        elif result.let_go:
            # The run only computed, and is stopped in doing so.
            self.said.emit(result.message)
        else:
            self.refused.emit(result.message)

    def _open_session(self, path: Path) -> None:
        if self.running:
            self._of_files.refuse(f"{path.name}: not opened: a run goes on")
            return
        if self._opening is not None:
            self._opening.close()
            self._opening.deleteLater()
        self.busy.emit(path.name)
        self._opening = RecordedFeed(path, self)
        self._opening.renewed.connect(self._opened)
        self._opening.failed.connect(self._not_opened)

    def _opened(self) -> None:
        """The session has a state to show: only now does it take the other's place."""
        feed, self._opening = self._opening, None
        if feed is None:
            return
        feed.renewed.disconnect(self._opened)
        feed.failed.disconnect(self._not_opened)
        feed.failed.connect(self.refused)
        self.busy.emit("")
        self._of_files.settle()
        self._show(feed)

    def _not_opened(self, message: str) -> None:
        if self._opening is not None:
            self._opening.close()
            self._opening.deleteLater()
            self._opening = None
        self.busy.emit("")
        self._of_files.refuse(message)

    def _show(self, feed: Feed | None) -> None:
        old, self.feed = self.feed, feed
        if old is not None:
            old.close()
            old.deleteLater()
        self.changed.emit()

    def _laid(self, path: Path, what: str) -> None:
        found, state = self.beside[path], self.state
        said = f"{path.name}: {what} {laid_words(path, found, has_session=self.feed is not None)}"
        unseen = unseen_words(found, state.plan.regions) if state is not None else ""
        if unseen:
            self._of_files.refuse(f"{said}; {unseen}")
        else:
            self._of_files.say(said)


def _said_of_folder(path: Path) -> str:
    """What is done with the one that a run leaves where it was broken off."""
    if path.suffix != BROKEN_OFF:
        return f"{path}: a folder, expected a file"
    return (
        f"{path.name}: a run that was broken off: open its experiment and choose it beside Begin; "
        f"'viscorig recover' makes a session of what is complete"
    )
