"""A serial port that may vanish and come back: adapters are unplugged."""

from contextlib import suppress

from serial import Serial

SLICE_S = 0.05
"""How long one look at the port may take; bounds how late a deadline is seen."""


class SerialLine:
    """Closed until it is opened; whoever meets an `OSError` closes it, and opens it again or gives up.

    Parameters
    ----------
    path
        Device file or COM port.
    timeout_s
        For what is written.

    Raises
    ------
    OSError
        By `open`, `read` and `write`: pyserial's errors are such. Also where it is not open.
    """

    def __init__(self, path: str, baud: int, *, timeout_s: float) -> None:
        self.path = path
        self._baud, self._timeout_s = baud, timeout_s
        self._port: Serial | None = None

    @property
    def is_open(self) -> bool:
        """Whether it may be read."""
        return self._port is not None

    @property
    def waiting(self) -> int:
        """How many bytes have come and are not read yet."""
        return int(self._opened.in_waiting)

    def open(self) -> None:
        """Take the port."""
        self._port = Serial(self.path, self._baud, timeout=SLICE_S, write_timeout=self._timeout_s)

    def read(self) -> bytes:
        """All that has come, else the first byte to come; empty where none does within `SLICE_S`."""
        port = self._opened
        return bytes(port.read(max(port.in_waiting, 1)))

    def write(self, data: bytes) -> None:
        """All of it."""
        self._opened.write(data)

    def close(self) -> None:
        """Let go of the port, also of one that has vanished."""
        if self._port is not None:
            with suppress(OSError):
                self._port.close()
        self._port = None

    @property
    def _opened(self) -> Serial:
        if self._port is None:
            raise OSError("the port is closed")
        return self._port
