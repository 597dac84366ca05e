"""Whether this program itself stood still: stopped by a signal, or kept from running by a busy computer.

Whatever it was waiting for then seems to have taken that time. A thread of its own that should tick all the
while tells the two apart.
"""

import threading
import time
from collections import deque
from collections.abc import Callable

_TICK_S = 0.1
_LATE_S = 0.5
"""Between two ticks; less is a thread that had to wait for its turn."""
_KEPT = 20
"""Of the latest times it stood still: the longest pause between two beats has had no more."""


class StoodStill:
    """Remembers when nothing of it ticked. `clock` in s, from anywhere."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._last = clock()
        self._stood: deque[tuple[float, float]] = deque(maxlen=_KEPT)

    def tick(self) -> None:
        """Take note that it runs."""
        now = self._clock()
        if now - self._last > _LATE_S:
            self._stood.append((self._last, now))
        self._last = now

    def since(self, began: float) -> float:
        """The longest time it stood still since then, in s; 0 where it did not."""
        # Whoever asks may be awake before the thread that ticks.
        self.tick()
        return max((end - max(start, began) for start, end in tuple(self._stood) if end > began), default=0.0)


class Ticking:
    """One `StoodStill` for the whole program, its thread begun when it is first asked for."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._stood = StoodStill()

    def since(self, began: float) -> float:
        """As `StoodStill.since`, of the time that the thread has ticked."""
        with self._lock:
            # A process that was forked has not the thread.
            if self._thread is None or not self._thread.is_alive():
                self._stood = StoodStill()
                self._thread = threading.Thread(target=self._tick, name="ticking", daemon=True)
                self._thread.start()
            return self._stood.since(began)

    def _tick(self) -> None:
        stood = self._stood
        while True:
            time.sleep(_TICK_S)
            stood.tick()


TICKING = Ticking()
"""There is one program, and one thread of it that ticks is enough."""
