"""A serial port that may vanish and come back: adapters are unplugged."""

import re
import time
from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

from serial import Serial

from drivers.errors import DriverError, Garbled, TimedOut, Unreachable

T = TypeVar("T")

SLICE_S = 0.05
"""How long one look at the port may take; bounds how late a deadline is seen."""


class SerialLine:
    """Closed until it is opened; whoever meets an `OSError` closes it, and opens it again or gives up.

    Parameters
    ----------
    path
        Device file or COM port.
    timeout_s
        For what is written, and for a line as far as errors name it.

    Raises
    ------
    OSError
        By `open`, `read`, `read_line` and `write`: pyserial's errors are such. Also where it is not open.
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

    def read_line(self, received: bytearray, deadline: float, *, longest: int, ends: bytes = b"\n") -> bytes:
        """The next line that is not blank, without its end: any one byte of `ends`.

        `received` is what has come of it before; what comes behind it is left there. `deadline` is by
        `time.monotonic`. Raises `TimedOut` where nothing has come until then, `Garbled` where no end has, or
        none within `longest` bytes.
        """
        while True:
            while end := re.search(b"[" + re.escape(ends) + b"]", received):
                line = bytes(received[: end.start()])
                del received[: end.end()]
                if line.strip():
                    return line
            if len(received) > longest:
                raise Garbled(f"{len(received)} bytes without an end of line")
            if time.monotonic() > deadline:
                if received.strip():
                    begun = bytes(received[:40])
                    raise Garbled(f"{begun!r} and no end of line in {self._timeout_s:g} s")
                raise TimedOut(f"no line in {self._timeout_s:g} s")
            received += self.read()

    def attempts(self, count: int, attempt: Callable[[], T], who: str) -> T:
        """What the first of `count` attempts gives that neither is silent, nor garbled, nor loses the port.

        A port that is lost is closed: an attempt opens it where it is. Raises the last `DriverError`, with
        `who` before it.
        """
        problem: DriverError = TimedOut("no attempt")
        for _ in range(count):
            try:
                return attempt()
            except (TimedOut, Garbled) as error:
                problem = error
            except OSError as error:
                # pyserial's errors are OSErrors: unplugged.
                problem = Unreachable(f"{error}: is it plugged in and on?")
                self.close()
        raise type(problem)(f"{who}: {problem}, {count} attempts")

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
