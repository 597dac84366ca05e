"""What a person may ask of a run while it goes on, from any thread."""

import threading
from collections import deque
from typing import Literal

from instrument.errors import ShakerNotSilent


class RunControl:
    """Hold, resume, abort. The runner looks at it between blocks, and says here when the run ends."""

    def __init__(self) -> None:
        self._held = threading.Event()
        self._abort: str | None = None
        self._interrupted = self._measured = False
        self._ended_by: BaseException | None = None
        self._declines = threading.Event()
        self._words: deque[tuple[Literal["add", "end"], float | None]] = deque()
        self.chooses_steps = False
        """Whether the sweep chooses its own: only such a one heeds words to its plan."""

    def hold(self) -> None:
        """Silence the shaker and wait; the step begun is measured again on resuming."""
        self._held.set()

    def resume(self) -> None:
        """Go on."""
        self._held.clear()

    def abort(self, why: str) -> None:
        """End the run safely."""
        self._abort = why

    def interrupt(self) -> None:
        """End the run as the user's own stop."""
        self._interrupted = True

    def decline(self) -> None:
        """Leave out the step that is being measured."""
        self._declines.set()

    def overrule(self, what: Literal["add", "end"], frequency_hz: float | None = None) -> None:
        """A word to a sweep that chooses its own steps: another step next, or none any more."""
        self._words.append((what, frequency_hz))

    def declined(self) -> bool:
        """Whether the step is to be left out; asked once, said once."""
        said = self._declines.is_set()
        self._declines.clear()
        return said

    def word(self) -> tuple[Literal["add", "end"], float | None] | None:
        """The next word to the plan; None where there is none."""
        return self._words.popleft() if self._words else None

    def ends(self, error: BaseException) -> BaseException:
        """The run ends by this; what counts of all that ended it: the first, or that the shaker is loud.

        Whoever would break it off is too late from here on: silencing and keeping are what is left.
        """
        if self._ended_by is None or (isinstance(error, ShakerNotSilent) and not self.ended_loud):
            self._ended_by = error
        return self._ended_by

    def measured(self) -> None:
        """There is nothing left to break off: the session is put together."""
        self._measured = True

    @property
    def ending(self) -> bool:
        """Whether a stop would only break off what a stop does."""
        return self._measured or self._ended_by is not None

    @property
    def ended_loud(self) -> bool:
        """Whether the run has ended over a shaker that nobody knows to be silent."""
        return isinstance(self._ended_by, ShakerNotSilent)

    @property
    def held(self) -> bool:
        """Whether to wait."""
        return self._held.is_set()

    @property
    def interrupted(self) -> bool:
        """Whether the user has stopped the run."""
        return self._interrupted

    @property
    def aborted(self) -> str | None:
        """Why the run is to end; None while it is not."""
        return self._abort
