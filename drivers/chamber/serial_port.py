"""A thermometer on a serial port: it is asked for a line with a number, or sends them by itself.

One rule: a line that was begun before it was asked for is no answer. It may be old, or torn.
"""

import time

from drivers.chamber import ascii_line
from drivers.errors import Garbled, Refused
from drivers.serial_line import SLICE_S, SerialLine


class SerialThermometer:
    """A `Chamber` without a set point.

    Parameters
    ----------
    query
        Sent for each reading, with `line_end`; empty for a thermometer that talks by itself.
    timeout_s
        For one line.
    retries
        More attempts for a line, and for opening a vanished port.

    Raises
    ------
    Unreachable, TimedOut, Garbled
        By each method, in one line, after the last attempt.
    """

    def __init__(
        self,
        port: str,
        *,
        baud: int = 9600,
        query: str = "",
        line_end: str = "\r\n",
        timeout_s: float = 1.2,
        retries: int = 1,
    ) -> None:
        self._timeout_s, self._retries = timeout_s, retries
        self._query = (query + line_end).encode("latin-1") if query else b""
        self._line = SerialLine(port, baud, timeout_s=timeout_s)

    def identity(self) -> str:
        """It has no name to tell: that it answers, and where."""
        self.temperature_c()
        return self._me

    def temperature_c(self) -> float:
        """Of a line that began after this was asked."""
        return self._line.attempts(self._retries + 1, lambda: ascii_line.decode(self._next_line()), self._me)

    def set_point_c(self) -> float | None:
        """None."""
        return None

    def go_to(self, set_point_c: float) -> float:
        """Refused."""
        raise Refused(f"{self._me}: it takes no set point")

    def close(self) -> None:
        """Let go of the port; a later reading opens it again."""
        self._line.close()

    @property
    def _me(self) -> str:
        return f"thermometer at {self._line.path}"

    def _next_line(self) -> bytes:
        if not self._line.is_open:
            self._line.open()
        self._fall_silent()
        if self._query:
            self._line.write(self._query)
        deadline = time.monotonic() + self._timeout_s
        # Some end a line with a carriage return alone, some begin with one.
        return self._line.read_line(bytearray(), deadline, longest=ascii_line.LONGEST_LINE, ends=b"\r\n")

    def _fall_silent(self) -> None:
        """Drop what lies in the line, and the rest of what is just being said until there is a pause."""
        deadline = time.monotonic() + self._timeout_s
        while self._line.read():
            if time.monotonic() > deadline:
                raise Garbled(f"it talks without a pause of {SLICE_S:g} s, lines expected")
