"""A lock that serves in the order of arrival.

A plain lock may go again and again to the thread that has just let it go. A stop button
must not wait for that.
"""

import threading
from collections import deque
from types import TracebackType


class FairLock:
    """A lock given on in turn: a context manager that waits for one's turn and gives it on at the end."""

    def __init__(self) -> None:
        self._guard = threading.Lock()
        self._busy = False
        self._waiting: deque[threading.Event] = deque()

    def __enter__(self) -> None:
        with self._guard:
            if not self._busy:
                self._busy = True
                return
            mine = threading.Event()
            self._waiting.append(mine)
        try:
            mine.wait()
        except BaseException:
            self._leave(mine)
            raise

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._give_on()

    @property
    def waiting(self) -> int:
        """How many threads stand in line."""
        return len(self._waiting)

    def _give_on(self) -> None:
        with self._guard:
            if self._waiting:
                self._waiting.popleft().set()
            else:
                self._busy = False

    def _leave(self, mine: threading.Event) -> None:
        with self._guard:
            if mine in self._waiting:
                self._waiting.remove(mine)
                return
        # The turn came in the moment of giving up.
        self._give_on()
