"""When the heartbeat was beaten, and what took the time of its longest pause.

An instrument that answers slowly holds up the loop that beats; what shows of it is the shaker's alarm. A line
that loses answers does too, each of which is waited for, and a program that stands still.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import monotonic

from instrument.run.stood_still import TICKING

LOST = "check cable, connectors and network, of a serial line baud and parity"
"""What answers that are lost or damaged on the way ask for."""
_MOST = 0.5
"""Share of a pause from which on a device is named as what took it."""


@dataclass
class _Pause:
    """A time without a beat, and the part of it that each device took, in s."""

    seconds: float = 0.0
    taken: dict[str, float] = field(default_factory=dict)
    stood_still_s: float = 0.0
    """The longest time that this program itself did not run."""


class Beats:
    """Counts the time between beats; a device is asked within `asking`."""

    def __init__(
        self,
        clock: Callable[[], float] = monotonic,
        stood_still: Callable[[float], float] = TICKING.since,
    ) -> None:
        """`clock` in s, from anywhere; `stood_still` how long the program did at most since a time of it."""
        self._clock, self._stood_still = clock, stood_still
        self.lost_answers = 0
        """Of the shaker, as it was last told."""
        self.restart()
        # It is watched from now on, not from the first time it is asked for.
        stood_still(self._since)

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
        if pause.stood_still_s >= _MOST * pause.seconds:
            return (
                f"{what}, for {pause.stood_still_s:.1f} s of which this program itself stood still: "
                "was it stopped, or the computer too busy?"
            )
        if not pause.taken:
            return what
        device = max(pause.taken, key=lambda name: pause.taken[name])
        if pause.taken[device] < _MOST * pause.seconds:
            return what
        why = "its answers are slow"
        if device == "shaker" and self.lost_answers:
            why = f"{self.lost_answers} of its answers were lost or damaged so far: {LOST}"
        return f"{what}, of which the {device} took {pause.taken[device]:.1f} s: {why}"

    def _longest_yet(self) -> _Pause:
        self._now.seconds = self._clock() - self._since
        self._now.stood_still_s = self._stood_still(self._since)
        return max(self._longest, self._now, key=lambda pause: pause.seconds)
