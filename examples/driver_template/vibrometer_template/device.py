"""The device on its wire: opened, asked, and asked again where no answer comes or it makes no sense.

Nothing is believed that was not read back.
"""

import socket
import time
from collections.abc import Callable
from contextlib import suppress
from threading import RLock
from typing import TypeVar

from drivers.errors import DriverError, Garbled, Refused, TimedOut, Unreachable
from drivers.vibrometer.interface import Range
from vibrometer_template import protocol

T = TypeVar("T")


class TemplateVibrometer:
    """`drivers.vibrometer.Vibrometer` over TCP. Any thread may call any method.

    Parameters
    ----------
    host, port
        Where it answers.
    timeout_s
        For one answer.
    retries
        More attempts for an answer, each on a new connection.

    Raises
    ------
    Unreachable, TimedOut, Garbled, Refused
    """

    def __init__(self, host: str, port: int, *, timeout_s: float = 1.0, retries: int = 2) -> None:
        self._at, self._timeout_s, self._retries = (host, port), timeout_s, retries
        self._connection: socket.socket | None = None
        self._closed = False
        self._lock = RLock()
        # Whoever answers here has to be the device: said at once, not in the middle of a run.
        self._identity = self._ask("ID?", protocol.parse_identity)

    @property
    def ranges(self) -> tuple[Range, ...]:
        """From the most sensitive to the coarsest."""
        return protocol.RANGES

    def identity(self) -> str:
        """Name and serial number, as the device states them."""
        return self._identity

    def set_range(self, name: str) -> Range:
        """Choose a range and read it back. Refused where the device keeps another."""
        with self._lock:
            self._ask(f"RANGE {protocol.number_of(name)}", protocol.check_done)
            found = self.range()
        if found.name != name:
            raise Refused(f"{self._me}: range {name} was asked, the device keeps {found.name}")
        return found

    def range(self) -> Range:
        """The one in use."""
        return self._ask("RANGE?", protocol.parse_range)

    def signal_level(self) -> float:
        """How much light comes back, 0 to 1."""
        return self._ask("LEVEL?", protocol.parse_level)

    def signal_delay_s(self) -> float | None:
        """The device states none."""
        return None

    def close(self) -> None:
        """Let go of the connection."""
        with self._lock:
            self._closed = True
            self._drop()

    @property
    def _me(self) -> str:
        return f"vibrometer at {self._at[0]}:{self._at[1]}"

    def _ask(self, request: str, parse: Callable[[str], T]) -> T:
        """The answer, understood."""
        with self._lock:
            if self._closed:
                raise Unreachable(f"{self._me}: {request}: the driver was closed")
            problem: DriverError = TimedOut("no attempt")
            for _ in range(self._retries + 1):
                try:
                    return parse(self._exchange(request))
                except Refused as error:
                    raise Refused(f"{self._me}: {request}: {error}") from None
                except DriverError as error:
                    problem = error
                except TimeoutError:
                    problem = TimedOut(f"no answer in {self._timeout_s:g} s")
                except OSError as error:
                    problem = Unreachable(str(error))
                # A late answer must not be taken for that of the next request: a new connection has none.
                self._drop()
            raise type(problem)(f"{self._me}: {request}: {problem}, {self._retries + 1} attempts")

    def _exchange(self, request: str) -> str:
        """One line out, one line in."""
        if self._connection is None:
            self._connection = socket.create_connection(self._at, self._timeout_s)
        self._connection.sendall(protocol.encode(request))
        return protocol.decode(self._line(self._connection, time.monotonic() + self._timeout_s))

    def _line(self, connection: socket.socket, deadline: float) -> bytes:
        received = b""
        while not received.endswith(b"\n"):
            left = deadline - time.monotonic()
            if left <= 0:
                raise TimeoutError
            connection.settimeout(left)
            new = connection.recv(protocol.LONGEST_LINE)
            if not new:
                raise Unreachable("the device closed the connection")
            received += new
            if len(received) > protocol.LONGEST_LINE:
                raise Garbled(f"{len(received)} bytes without an end of line")
        return received

    def _drop(self) -> None:
        if self._connection is not None:
            with suppress(OSError):
                self._connection.close()
        self._connection = None
