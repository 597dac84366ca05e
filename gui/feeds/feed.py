"""What every feed is to the window."""

from time import perf_counter

from PySide6.QtCore import QObject, Signal

from gui.state import SessionState

MOST_S = 0.012
"""Time a feed may take of the main thread at a turn: the window stays quick however much is waiting."""


class Feed(QObject):
    """Fills a session state, a little at every turn of the window's timer.

    Signals
    -------
    renewed
        `state` is another one: a session was opened, or a replay jumped back.
    failed
        One line: there is no session to show.
    ended
        Nothing more comes by itself.
    """

    renewed = Signal()
    failed = Signal(str)
    ended = Signal()
    state: SessionState | None = None

    @property
    def left_s(self) -> float | None:
        """Seconds until the end; None where nobody knows."""
        return None

    @property
    def fraction(self) -> float | None:
        """Done, 0 to 1; None where nobody knows."""
        return None

    @property
    def ages_s(self) -> tuple[float, float]:
        """Of the drive and of the samples in `state.readings`; 0 of a recording, whose time stands still."""
        return 0.0, 0.0

    def advance(self) -> None:
        """Take what is there, for `MOST_S` at most. Never waits."""
        raise NotImplementedError

    def close(self) -> None:
        """Let go of whatever is behind it. Never waits long."""
        raise NotImplementedError


class Turn:
    """A turn's time, counted from its making."""

    def __init__(self) -> None:
        self._end = perf_counter() + MOST_S

    @property
    def over(self) -> bool:
        """Whether the rest has to wait for the next turn."""
        return perf_counter() > self._end
