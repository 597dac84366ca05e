"""A Polytec vibrometer on a serial port.

One rule: nothing is believed that was not read back. An answer that makes no sense is drained and asked for
again, a port that vanished is opened again, both a bounded number of times.
"""

import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from threading import RLock
from typing import TypeVar

from drivers.errors import Garbled, Refused, TimedOut, Unreachable
from drivers.serial_line import SerialLine
from drivers.vibrometer import polytec
from drivers.vibrometer.interface import Range
from drivers.vibrometer.polytec_models import model_named

T = TypeVar("T")

_REOPEN_S = 0.2
"""Between attempts to open a vanished port: adapters take a moment to come back."""
_DECODERS = 2
"""How many velocity decoders a controller may hold."""

_LATE = " (a late answer to another question?)"


class PolytecVibrometer:
    """A `Vibrometer` that speaks the OFV-5000's language.

    Parameters
    ----------
    port
        Device file or COM port.
    model
        One of `drivers.vibrometer.polytec_models.MODELS`.
    timeout_s
        For one answer.
    retries
        More attempts for an answer, and for opening a vanished port.

    Raises
    ------
    Unreachable, TimedOut, Garbled, Refused
        The last where the controller holds another decoder than the model's.
    """

    def __init__(
        self,
        port: str,
        *,
        model: str = "OFV-5000",
        baud: int = 115200,
        timeout_s: float = 1.0,
        retries: int = 2,
    ) -> None:
        self._model = model_named(model)
        self._timeout_s, self._retries = timeout_s, retries
        self._line = SerialLine(port, baud, timeout_s=timeout_s)
        self._closed = False
        self._set_to: Range | None = None
        """As the device stated it when it was set; None once it may have been switched off meanwhile."""
        self._received = bytearray()
        self._lock = RLock()
        try:
            self._reopen()
            self._decoder = self._find_decoder()
        except BaseException:
            self.close()
            raise

    @property
    def ranges(self) -> tuple[Range, ...]:
        """From the most sensitive to the coarsest."""
        return self._model.ranges

    def identity(self) -> str:
        """Controller, decoder and sensor head, as the device states them."""
        questions = (
            polytec.info("Controller", 0, "Name"),
            polytec.get("VeloDec", self._decoder, "Name"),
            polytec.info("SensorHead", 0, "Name"),
        )
        names = [self._ask(question, polytec.parse_optional_text) for question in questions]
        return ", ".join(name for name in names if name)

    def set_range(self, name: str) -> Range:
        """Choose a range and read it back. Refused where the device keeps another."""
        wanted = self._model.range_named(name)
        with self._lock:
            self._set_to = None
            self._set(polytec.put("VeloDec", self._decoder, "Range", wanted.name))
            found = self._set_to = self.range()
        if found.name != wanted.name:
            raise Refused(f"{self._me}: range {wanted.name} was asked, the device keeps {found.name}")
        return found

    def range(self) -> Range:
        """The one in use, with the highest frequency and delay that the device states for it.

        These two are asked for when it is set; of a range that still is the one set its name alone, since a
        run asks before every point, and its heartbeat waits meanwhile.
        """
        with self._lock:
            found = self._ask(polytec.get("VeloDec", self._decoder, "Range"), self._parse_range)
            if self._set_to is not None and self._set_to.name == found.name:
                return self._set_to
            highest = self._ask(
                polytec.get("VeloDec", self._decoder, "MaxFreq"),
                lambda reply: polytec.parse_optional_quantity(reply, "Hz"),
            )
            delay = self.signal_delay_s()
        return replace(
            found,
            highest_hz=found.highest_hz if highest is None else highest,
            delay_s=found.delay_s if delay is None else delay,
        )

    def signal_level(self) -> float:
        """How much light comes back, 0 to 1."""
        level = self._ask(polytec.get("SignalLevel", 0, "Value"), polytec.parse_integer)
        return min(max(level / self._model.signal_level_full, 0.0), 1.0)

    def signal_delay_s(self) -> float | None:
        """Delay of the velocity signal as the device states it; None where it states none."""
        return self._ask(
            polytec.get("VeloDec", self._decoder, "SignalDelay"),
            lambda reply: polytec.parse_optional_quantity(reply, "s"),
        )

    def close(self) -> None:
        """Let go of the port."""
        with self._lock:
            self._closed = True
            self._line.close()

    @property
    def _me(self) -> str:
        return f"vibrometer {self._model.name} at {self._line.path}"

    def _parse_range(self, reply: str) -> Range:
        for one in self._model.ranges:
            if polytec.is_same_name(one.name, reply):
                return one
        raise Garbled(f"{reply!r}: expected a range of {self._model.decoder}")

    def _find_decoder(self) -> int:
        """Which decoder is where differs from controller to controller."""
        found = []
        for index in range(_DECODERS):
            name = self._ask(polytec.get("VeloDec", index, "Name"), polytec.parse_optional_text)
            if name is not None and polytec.is_same_name(name, self._model.decoder):
                return index
            found.append(name or "none")
        raise Refused(
            f"{self._me}: velocity decoder {self._model.decoder} expected, found {' and '.join(found)}: "
            "name the model in the rig file"
        )

    def _ask(self, command: polytec.PolytecCommand, parse: Callable[[str], T]) -> T:
        """The answer, asked for again where it is missing or makes no sense."""

        def attempt() -> T:
            reply = self._exchange(command)
            try:
                return parse(reply)
            except Garbled as error:
                # What is no noise answers something: a question before, whose answer was given up.
                late = reply.isprintable() and "\ufffd" not in reply
                raise Garbled(f"{error}{_LATE if late else ''}") from None

        return self._try(command, attempt)

    def _set(self, command: polytec.PolytecCommand) -> None:
        def attempt() -> None:
            # Without an acknowledge the setting may have been taken all the same: reading it back decides.
            with suppress(TimedOut, Garbled):
                polytec.check_acknowledge(self._exchange(command))

        self._try(command, attempt)

    def _try(self, command: polytec.PolytecCommand, attempt: Callable[[], T]) -> T:
        with self._lock:
            if self._closed:
                raise Unreachable(f"{self._me}: {command}: the driver was closed")

            def opened() -> T:
                if not self._line.is_open:
                    self._reopen()
                return attempt()

            try:
                return self._line.attempts(self._retries + 1, opened, f"{self._me}: {command}")
            except Refused as error:
                raise Refused(f"{self._me}: {command}: {error}") from None

    def _reopen(self) -> None:
        """Open the port and tell the device to echo nothing and to acknowledge what is set."""
        self._set_to = None
        for attempt in range(self._retries + 1):
            try:
                self._line.open()
                for item, value in (("Acknowledge", "On"), ("Echo", "Off")):
                    with suppress(TimedOut, Garbled):
                        self._exchange(polytec.put("Interface", 0, item, value))
                return
            except OSError as error:
                self._line.close()
                if attempt == self._retries:
                    raise Unreachable(
                        f"{self._me}: {error}, {attempt + 1} attempts to open: is it plugged in and on?"
                    ) from error
                time.sleep(_REOPEN_S)

    def _exchange(self, command: polytec.PolytecCommand) -> str:
        """One line out, one line in. Whatever lay in the line before is no answer to this."""
        self._received.clear()
        while self._line.waiting:
            self._line.read()
        self._line.write(polytec.encode(command))
        deadline = time.monotonic() + self._timeout_s
        while True:
            line = self._line.read_line(self._received, deadline, longest=polytec.LONGEST_LINE)
            reply = polytec.decode(line)
            # Until the echo is off, and where it cannot be, the first line is our own.
            if reply and reply != str(command):
                return reply
