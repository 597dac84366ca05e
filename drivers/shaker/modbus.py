"""A shaker controller on Modbus TCP or RTU, with the project's register map or one fitted to the device."""

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

from drivers.errors import DriverError, Garbled, Refused, TimedOut
from drivers.modbus.line import ModbusLine
from drivers.shaker.interface import Alarm, Echo, ShakerStatus
from drivers.shaker.protocol import (
    Identity,
    SineCommand,
    Value,
    decode_echo,
    decode_identity,
    decode_span,
    decode_status,
    encode,
    encode_command,
    heartbeat_timeout_objection,
    limit_objection,
    next_sequence,
    word_order_hint,
)
from drivers.shaker.register_map import COMMAND, DEFAULT, ECHO, IDENTITY, STATUS, ControlBits, RegisterMap

ECHO_TIMEOUT_S = 1.0
"""How long a command may take to be taken by the device."""
ECHO_POLL_S = 0.01
_KEPT = 1e-3
"""Relative: a device may round a time it is told, a float32 does."""


class ModbusShaker:
    """`Shaker` over Modbus. Any thread may call any method; `stop` waits for no command under way.

    Every method raises a `DriverError`: `Unreachable`, `TimedOut` and `Garbled` after the line's retries,
    `Refused` at once. The connection is opened by the first call.
    """

    def __init__(self, line: ModbusLine, registers: RegisterMap = DEFAULT) -> None:
        self._line = line
        self._registers = registers
        self._commanding = threading.Lock()
        self._beating = threading.Lock()
        self._sequence: int | None = None
        self._beats: int | None = None

    @classmethod
    def tcp(
        cls,
        host: str,
        port: int = 502,
        *,
        unit: int = 1,
        registers: RegisterMap = DEFAULT,
        timeout_s: float = 1.0,
        retries: int = 2,
    ) -> "ModbusShaker":
        """Over Modbus TCP; `timeout_s` holds for connecting and for each answer."""
        line = ModbusLine.tcp("shaker", host, port, unit=unit, timeout_s=timeout_s, retries=retries)
        return cls(line, registers)

    @classmethod
    def rtu(
        cls,
        port: str,
        *,
        baud: int = 115200,
        parity: str = "N",
        stop_bits: int = 1,
        unit: int = 1,
        registers: RegisterMap = DEFAULT,
        timeout_s: float = 1.0,
        retries: int = 2,
        patience_s: float = 0.5,
    ) -> "ModbusShaker":
        """Over Modbus RTU on a serial port, 8 data bits; `patience_s`: for answers lost in a row."""
        line = ModbusLine.rtu(
            "shaker",
            port,
            baud=baud,
            parity=parity,
            stop_bits=stop_bits,
            unit=unit,
            timeout_s=timeout_s,
            retries=retries,
            patience_s=patience_s,
        )
        return cls(line, registers)

    def identity(self) -> str:
        """Maker, model, version and serial number, as the device states them."""
        identity = self._identity()
        return f"{identity.name}, serial number {identity.serial_number}"

    def start(self) -> None:
        """Allow output; the drive stays zero until a command.

        Refused with an alarm, an open interlock, or a drive limit that is none.
        """
        self._identity()
        status = self.status()
        why = _forbids_start(status) or limit_objection(status.limit_v)
        if why:
            raise Refused(f"{self._line.name} does not start: {why}")
        self._control(ControlBits.RUN)

    def command(self, frequency_hz: float, drive_v: float, ramp_v_s: float) -> Echo:
        """A new sine, phase continuous; the amplitude goes there at `ramp_v_s`.

        The device makes the numbers nearest to these that a float32 holds.

        Raises
        ------
        Refused
            Numbers out of range, output not allowed, or far more asked than the device's limit.
        TimedOut
            The device took the write but not the command within `ECHO_TIMEOUT_S`.
        """
        with self._commanding:
            sequence = self._next_sequence()
            with self._naming():
                words = encode_command(
                    self._registers, SineCommand(frequency_hz, drive_v, ramp_v_s, sequence)
                )
            (span,) = self._registers.spans(COMMAND)
            try:
                self._line.write("command", span.address, words)
            except Refused as refusal:
                raise self._explained(refusal) from refusal
            return self._await_echo(sequence)

    def stop(self) -> None:
        """Ramp to zero and disallow output. Works in any state, also twice."""
        self._control(ControlBits(0))

    def beat(self) -> None:
        """The heartbeat: a number that differs from the one before."""
        with self._beating:
            if self._beats is None:
                self._beats = int(self._read(("heartbeat",))["heartbeat"])
            self._beats = (self._beats + 1) % 0x10000
            self._write("heartbeat", self._beats)

    def status(self) -> ShakerStatus:
        """What the device says of itself."""
        values = self._read(STATUS)
        with self._naming():
            return replace(decode_status(values), lost_answers=self._line.lost_answers)

    def reset_alarm(self) -> None:
        """Clear a latched alarm whose cause is gone. Refused where it is not."""
        if self.status().alarm is Alarm.NONE:
            return
        try:
            self._control(ControlBits.RESET_ALARM)
        except Refused as refusal:
            raise self._explained(refusal) from refusal

    def close(self) -> None:
        """Let go of the connection. Does not stop the shaker: `stop` does."""
        self._line.close()

    def heartbeat_timeout_s(self) -> float:
        """How long the device waits for a beat while running."""
        return float(self._read(("heartbeat_timeout_s",))["heartbeat_timeout_s"])

    def set_heartbeat_timeout_s(self, timeout_s: float) -> None:
        """Refused where the device does not do that."""
        objection = heartbeat_timeout_objection(timeout_s)
        if objection:
            raise Refused(f"{self._line.name}: {objection}")
        self._write("heartbeat_timeout_s", timeout_s)
        # What was acknowledged may have been lost on the way, or held at the device's own: without a watchdog
        # nothing silences the shaker of a program that was killed.
        kept_s = self.heartbeat_timeout_s()
        if abs(kept_s - timeout_s) > _KEPT * timeout_s:
            hint = word_order_hint(kept_s) if heartbeat_timeout_objection(kept_s) else ""
            raise Refused(
                f"{self._line.name}: heartbeat_timeout_s {timeout_s:g} was asked, the device keeps "
                f"{kept_s:g}{hint}: its watchdog is off, or its map another"
            )

    def _identity(self) -> Identity:
        values = self._read(IDENTITY)
        with self._naming():
            return decode_identity(values)

    def _next_sequence(self) -> int:
        if self._sequence is None:
            self._sequence = int(self._read(("echo_sequence",))["echo_sequence"])
        # Never a number used before, or the receipt of a lost command could pass for this one's.
        self._sequence = next_sequence(self._sequence)
        return self._sequence

    def _await_echo(self, sequence: int) -> Echo:
        deadline = time.monotonic() + ECHO_TIMEOUT_S
        while True:
            # The number first: what is read after it belongs to it, wherever the registers lie.
            seen = int(self._read(("echo_sequence",))["echo_sequence"])
            if seen == sequence and (echo := self._echo()).sequence == sequence:
                return echo
            if time.monotonic() > deadline:
                raise TimedOut(
                    f"{self._line.name}: receipt of command {sequence} expected within "
                    f"{ECHO_TIMEOUT_S:g} s, the last one is of {seen}"
                )
            time.sleep(ECHO_POLL_S)

    def _echo(self) -> Echo:
        values = self._read(ECHO)
        with self._naming():
            return decode_echo(values)

    def _control(self, word: ControlBits) -> None:
        self._write("control", int(word))

    def _write(self, name: str, value: Value) -> None:
        register = self._registers[name]
        self._line.write(name, register.address, encode(register, value))

    def _read(self, names: tuple[str, ...]) -> dict[str, Value]:
        values: dict[str, Value] = {}
        for span in self._registers.spans(names):
            words = self._line.read(", ".join(span.names), span.address, span.width)
            with self._naming():
                values |= decode_span(self._registers, span, words)
        return values

    def _explained(self, refusal: Refused) -> Refused:
        """The refusal with what the device's status says about it."""
        try:
            status = self.status()
        except DriverError:
            return refusal
        return Refused(f"{refusal}: {_state(status)}")

    @contextmanager
    def _naming(self) -> Iterator[None]:
        try:
            yield
        except (Garbled, Refused) as problem:
            raise type(problem)(f"{self._line.name}, {problem}") from problem


def _forbids_start(status: ShakerStatus) -> str | None:
    if status.alarm is not Alarm.NONE:
        return f"alarm {status.alarm.name} is latched: remove its cause and reset it"
    if status.interlock_open:
        return "the interlock is open: close it"
    return None


def _state(status: ShakerStatus) -> str:
    return _forbids_start(status) or ("running" if status.running else "output is not allowed: start first")
