"""When the heartbeat was beaten, and what took the time of its longest pause.

An instrument that answers slowly holds up the loop that beats; what shows of it is the shaker's alarm.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import monotonic

_MOST = 0.5
"""Share of a pause from which on a device is named as what took it."""


@dataclass
class _Pause:
    """A time without a beat, and the part of it that each device took, in s."""

    seconds: float = 0.0
    taken: dict[str, float] = field(default_factory=dict)


class Beats:
    """Counts the time between beats; a device is asked within `asking`."""

    def __init__(self, clock: Callable[[], float] = monotonic) -> None:
        """`clock` in s, from anywhere."""
        self._clock = clock
        self.restart()

    def restart(self) -> None:
        """Forget what was before: nobody has to beat while the shaker is silent."""
        self._since, self._none_yet = self._clock(), True
        self._longest, self._now = _Pause(), _Pause()

    def due(self, every_s: float) -> bool:
        """Whether the last beat is so long ago, or there was none."""
        return self._none_yet or self._clock() - self._since >= every_s

    def beaten(self) -> None:
        """Take note of a beat just made."""
        self._longest, self._now = self._longest_yet(), _Pause()
        self._since, self._none_yet = self._clock(), False

    @contextmanager
    def asking(self, device: str) -> Iterator[None]:
        """What is done within is that device's time."""
        began = self._clock()
        try:
            yield
        finally:
            taken = self._now.taken
            taken[device] = taken.get(device, 0.0) + self._clock() - began

    @property
    def said(self) -> str:
        """The longest pause so far, the one that goes on included, for people."""
        pause = self._longest_yet()
        what = f"no beat for {pause.seconds:.1f} s"
        if not pause.taken:
            return what
        device = max(pause.taken, key=lambda name: pause.taken[name])
        if pause.taken[device] < _MOST * pause.seconds:
            return what
        return f"{what}, of which the {device} took {pause.taken[device]:.1f} s: its answers are slow"

    def _longest_yet(self) -> _Pause:
        self._now.seconds = self._clock() - self._since
        return max(self._longest, self._now, key=lambda pause: pause.seconds)
