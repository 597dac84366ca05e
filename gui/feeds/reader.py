"""Reads a session on a thread of its own, ahead of whoever plays it. No Qt."""

import threading
from collections import deque
from dataclasses import dataclass
from pathlib import Path

from gui.background.task import said_of_fault
from gui.feeds.session_index import SessionIndex
from gui.state import SessionState
from instrument.session.storage import SessionFile
from instrument.stream.event import Event
from instrument.stream.raw import BlockAcquired

_MOST_WAITING = 2000
_MOST_SAMPLES = 4_000_000
"""Read ahead, of all channels together: 16 MB."""


@dataclass(frozen=True)
class Loaded:
    """Says that the session is open."""

    index: SessionIndex


@dataclass(frozen=True)
class Jumped:
    """The session state at a place; what is read from now on follows it."""

    state: SessionState
    time_s: float


@dataclass(frozen=True)
class Read:
    """One event and its time."""

    time_s: float
    event: Event


@dataclass(frozen=True)
class Failed:
    """The file cannot be read (any further)."""

    message: str


Item = Loaded | Jumped | Read | Failed


class _Turned(Exception):
    """Something else is wanted now."""


class Reader:
    """`poll`, `jump` and `close` never wait for the disk. Until the first `jump` only `Loaded` comes."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._changed = threading.Condition()
        self._waiting: deque[Item] = deque()
        self._samples = 0
        self._jump_s: float | None = None
        self._closed = self._at_end = False
        self._thread = threading.Thread(target=self._work, name=f"reading {path.name}", daemon=True)
        self._thread.start()

    def poll(self, until_s: float) -> Item | None:
        """What is next, where its time has come; None otherwise."""
        with self._changed:
            if not self._waiting:
                return None
            item = self._waiting[0]
            if isinstance(item, Read):
                if item.time_s > until_s:
                    return None
                self._samples -= _size(item)
            self._changed.notify()
            return self._waiting.popleft()

    @property
    def next_s(self) -> float | None:
        """Time of the next event; None where none is read yet."""
        with self._changed:
            item = self._waiting[0] if self._waiting else None
            return item.time_s if isinstance(item, Read) else None

    @property
    def finished(self) -> bool:
        """Whether the last event has been given out."""
        with self._changed:
            return self._at_end and not self._waiting

    def jump(self, to_s: float) -> None:
        """Go somewhere else: `Jumped` comes, then what follows. The last word counts."""
        with self._changed:
            self._jump_s = to_s
            self._waiting = deque(i for i in self._waiting if isinstance(i, Loaded | Failed))
            self._samples, self._at_end = 0, False
            self._changed.notify()

    def close(self) -> None:
        """End the thread; the file is let go of."""
        with self._changed:
            self._closed = True
            self._changed.notify()
        self._thread.join()

    # On the thread

    def _work(self) -> None:
        try:
            with SessionFile(self._path) as file:
                index = SessionIndex.of(file, self._look)
                self._put(Loaded(index))
                while True:
                    self._follow(file, index)
        except _Turned:
            return
        except Exception as error:  # told to the window, whatever it is
            with self._changed:
                self._waiting.append(Failed(said_of_fault(error)))

    def _follow(self, file: SessionFile, index: SessionIndex) -> None:
        """From a jump on until the next one."""
        with self._changed:
            self._changed.wait_for(lambda: self._closed or self._jump_s is not None)
            to_s, self._jump_s = self._jump_s, None
        try:
            self._look()
            count = index.count_at(to_s if to_s is not None else 0.0)
            self._put(Jumped(index.state(file, count, self._look), to_s or 0.0))
            for number, event in index.events(file, count):
                self._put(Read(index.time_s[number], event))
            with self._changed:
                self._at_end = self._jump_s is None
        except _Turned:
            if self._closed:
                raise

    def _look(self) -> None:
        if self._closed or self._jump_s is not None:
            raise _Turned

    def _put(self, item: Item) -> None:
        with self._changed:
            self._changed.wait_for(lambda: self._has_room or self._closed or self._jump_s is not None)
            if not isinstance(item, Loaded):
                self._look()
            self._waiting.append(item)
            if isinstance(item, Read):
                self._samples += _size(item)

    @property
    def _has_room(self) -> bool:
        return len(self._waiting) < _MOST_WAITING and self._samples < _MOST_SAMPLES


def _size(item: Read) -> int:
    return item.event.counts.size if isinstance(item.event, BlockAcquired) else 0
