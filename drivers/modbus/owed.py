"""An answer on a serial line that did not come in time and may come yet.

Modbus RTU numbers nothing: where the next question is sent before that answer has come, it passes for the
next one's, and every answer after it for that of the question behind.
"""

import time
from typing import Protocol


class Listening(Protocol):
    """The client of a serial line, its port open."""

    def listen(self, until_s: float) -> bool:
        """Drop what comes until one answer has, or until that moment of `time.monotonic`: whether one has."""
        ...


class Owed:
    """Listens for a lost answer before anything is sent again, but not longer than the beat can wait."""

    def __init__(self, patience_s: float) -> None:
        """`patience_s` is for all in a row that never come; one that does has as much for itself alone."""
        self._patience_s = patience_s
        self._left_s = patience_s
        self._since_s: float | None = None

    def lost(self) -> None:
        """The answer to what was sent last is no longer waited for."""
        self._since_s = time.monotonic()

    def row_ended(self) -> None:
        """By an answer, or because it is asked no more: the next lost one has the whole patience."""
        self._left_s = self._patience_s

    def settle(self, line: Listening) -> None:
        """Before a question is sent. What the line's port raises is passed on."""
        if self._since_s is None:
            return
        has_come = line.listen(self._since_s + self._left_s)
        # A device that is late by habit is no noise: its next answer is heard out like this one.
        if not has_come:
            self._left_s = max(0.0, self._left_s - (time.monotonic() - self._since_s))
        self._since_s = None
