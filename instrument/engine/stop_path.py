"""The client's own way to the shaker, past the engine: a second connection, kept ready.

A Modbus TCP device takes several; a serial line has room for one program, so there, and wherever a driver
does not say that its device is shared, the way opens only when the engine's process has ended. Until then
the engine itself stops the shaker when it is told to.
"""

import threading
from collections.abc import Callable
from time import monotonic

from drivers.errors import DriverError
from drivers.shaker.driver import ShakerOptions
from instrument.engine.messages import Message, ShakerSeen, StopPathChanged
from instrument.files.devices import SHAKERS
from instrument.run.at_rest import came_to_rest
from instrument.run.rig import open_shaker

_LOOKS_EVERY_S = 0.2
"""Devices close connections that are idle, and a person wants to see the drive of now."""
_ANSWER_S, _RETRIES = 0.5, 2
"""A stop that waits longer for one answer had better begin again."""
_ALONE = (
    "one connection at a time: the engine itself stops the shaker; "
    "where it does not answer, its process is ended first"
)


class StopPath:
    """To one shaker.

    Parameters
    ----------
    table
        Where it answers.
    changed
        Told when the connection stands, and when it does not any more, and what the shaker says of itself;
        on a thread of its own.
    """

    def __init__(self, table: ShakerOptions, changed: Callable[[Message], object]) -> None:
        self._shaker = open_shaker(table, timeout_s=_ANSWER_S, retries=_RETRIES)
        self.is_shared = SHAKERS[table.kind].is_shared
        """Whether it works beside the engine."""
        self._changed = changed
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._keep_ready, name="stop path", daemon=True)
        self._thread.start()

    def silence(self) -> str:
        """Stop the shaker and wait until it is at rest; what went wrong, empty where nothing did."""
        return came_to_rest(self._shaker)

    def close(self) -> None:
        """Let go of the connection."""
        self._closing.set()
        self._thread.join()
        self._shaker.close()

    def _keep_ready(self) -> None:
        if not self.is_shared:
            self._changed(StopPathChanged(False, _ALONE))
            return
        told: StopPathChanged | None = None
        while not self._closing.is_set():
            now = self._try()
            if now != told and not self._closing.is_set():
                self._changed(now)
                told = now
            self._closing.wait(_LOOKS_EVERY_S)

    def _try(self) -> StopPathChanged:
        asked_s = monotonic()
        try:
            status = self._shaker.status()
        except DriverError as error:
            return StopPathChanged(False, " ".join(str(error).split()))
        self._changed(ShakerSeen(status.drive_v, asked_s))
        return StopPathChanged(True)
