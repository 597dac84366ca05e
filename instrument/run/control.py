"""What a person may ask of a run while it goes on, from any thread."""

import threading


class RunControl:
    """Hold, resume, abort. The runner looks at it between blocks."""

    def __init__(self) -> None:
        self._held = threading.Event()
        self._abort: str | None = None

    def hold(self) -> None:
        """Silence the shaker and wait; the step begun is measured again on resuming."""
        self._held.set()

    def resume(self) -> None:
        """Go on."""
        self._held.clear()

    def abort(self, why: str) -> None:
        """End the run safely."""
        self._abort = why

    @property
    def held(self) -> bool:
        """Whether to wait."""
        return self._held.is_set()

    @property
    def aborted(self) -> str | None:
        """Why the run is to end; None while it is not."""
        return self._abort
