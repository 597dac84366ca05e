"""Something done at a certain point of a run, however busy the machine is."""

from collections.abc import Callable

from instrument.run.companion import Companion
from instrument.stream.derived import PointMeasured
from instrument.stream.event import Event


class RunAtPoint(Companion):
    """Does it on the thread that measures: a watcher is told later, the run may be over by then."""

    def __init__(self, number: int, do: Callable[[], None]) -> None:
        self._left, self._do = number, do

    def happened(self, event: Event) -> None:
        if isinstance(event, PointMeasured):
            self._left -= 1
            if self._left == 0:
                self._do()
