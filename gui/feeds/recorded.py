"""A recorded session: played at any speed, held still, jumped about in, and compared with itself."""

from pathlib import Path
from time import monotonic

from PySide6.QtCore import QObject, Signal

from gui.background.task import BackgroundCommand
from gui.feeds.feed import Feed, Turn
from gui.feeds.reader import Failed, Item, Jumped, Loaded, Read, Reader
from gui.feeds.session_index import SessionIndex
from instrument.facts.run import ReplayResult


class RecordedFeed(Feed):
    """Opens at the session's end, so that its results are there at once.

    Signals
    -------
    loaded
        `index` is there; the state comes next.
    moved
        `position_s`, `playing` or `speed` changed.
    compared
        What `viscorig replay` says: its JSON, `equal_to_recorded` among it.
    comparison_failed
        One line.
    """

    loaded = Signal()
    moved = Signal()
    compared = Signal(object)
    comparison_failed = Signal(str)

    def __init__(self, path: Path, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.path = path
        self.index: SessionIndex | None = None
        self.position_s = 0.0
        self.playing = False
        self.speed: float | None = 1.0
        """Times as fast as it was; None as fast as it goes."""
        self.comparison: ReplayResult | None = None
        self._comparing: BackgroundCommand | None = None
        self._jumping_to: float | None = None
        self._looked = monotonic()
        self._reader = Reader(path)

    @property
    def length_s(self) -> float:
        """Of the timeline; 0 until it is loaded."""
        return self.index.length_s if self.index is not None else 0.0

    @property
    def left_s(self) -> float | None:
        """How much of the recording is left."""
        return self.length_s - self.position_s

    def play(self, speed: float | None = 1.0) -> None:
        """Go on from here; from the beginning where this is the end."""
        if self.index is None:
            return
        self.speed, self.playing, self._looked = speed, True, monotonic()
        if self.position_s >= self.length_s:
            self.jump(0.0)
        self.moved.emit()

    def pause(self) -> None:
        """Stand still."""
        self.playing = False
        self.moved.emit()

    def jump(self, to_s: float) -> None:
        """Show the session as it was at this time."""
        if self.index is None:
            return
        self._jumping_to = min(max(0.0, to_s), self.length_s)
        self.position_s = self._jumping_to
        self._reader.jump(self._jumping_to)
        self.moved.emit()

    def advance(self) -> None:
        """What is due by now."""
        turn, now = Turn(), monotonic()
        elapsed, self._looked = now - self._looked, now
        due_s, before_s = self._due(elapsed), self.position_s
        while not turn.over:
            item = self._reader.poll(due_s)
            if item is None:
                self._arrive(due_s)
                break
            self._take(item)
        if self.position_s != before_s:
            self.moved.emit()

    def compare(self) -> None:
        """Compute every derived event again, in a process of its own."""
        if self._comparing is not None and not self._comparing.over:
            return
        self._comparing = BackgroundCommand(["replay", str(self.path)], ReplayResult, self)
        self._comparing.done.connect(self._found_equal)
        self._comparing.failed.connect(self.comparison_failed)
        self._comparing.start()

    @property
    def comparing(self) -> bool:
        """Whether a comparison goes on."""
        return self._comparing is not None and not self._comparing.over

    def cancel_comparison(self) -> None:
        """End it; nothing is told."""
        if self._comparing is not None:
            self._comparing.cancel()

    def close(self) -> None:
        """The file is let go of."""
        if self._comparing is not None:
            self._comparing.close()
        self._reader.close()

    def _due(self, elapsed_s: float) -> float:
        if not self.playing or self._jumping_to is not None:
            return self.position_s
        if self.speed is None:
            return self.length_s
        return min(self.position_s + elapsed_s * self.speed, self.length_s)

    def _take(self, item: Item) -> None:
        match item:
            case Loaded():
                self.index = item.index
                self.loaded.emit()
                self.jump(item.index.length_s)
            case Jumped():
                self._jumping_to = None
                self.state = item.state
                self.position_s, self._looked = item.time_s, monotonic()
                self.renewed.emit()
            case Read():
                assert self.state is not None
                self.state.take(item.event)
                self._go(item.time_s)
            case Failed():
                self.playing = False
                self.failed.emit(item.message)

    def _arrive(self, due_s: float) -> None:
        """Everything due is shown: time goes on, unless the disk is behind."""
        if not self.playing or self._jumping_to is not None or self.state is None:
            return
        if self._reader.next_s is not None:
            self._go(due_s)
        elif self._reader.finished:
            self._go(self.length_s)
            self.pause()
            self.ended.emit()

    def _go(self, to_s: float) -> None:
        self.position_s = max(self.position_s, to_s)

    def _found_equal(self, found: ReplayResult) -> None:
        self.comparison = found
        self.compared.emit(found)
