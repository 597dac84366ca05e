"""Registers to messages and back, for both ends of the wire. No I/O.

A message is a name-to-value mapping only inside this file; outside it is a dataclass.
"""

import math
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from drivers.errors import Garbled, Refused
from drivers.shaker.interface import Alarm, Echo, ShakerStatus
from drivers.shaker.register_map import COMMAND, MAP_VERSION, Register, RegisterMap, RegisterRun, StatusBit

Value = int | float | str

UNKNOWN_SAMPLE = 2**64 - 1
FREQUENCY_HZ = (0.01, 100e3)
"""Least and most that a command may ask."""
HIGHEST_DRIVE_V = 1e3
RAMP_V_S = (1e-6, 1e6)
HEARTBEAT_TIMEOUT_S = (0.1, 60.0)
LEAST_LIMIT_V = 1e-3
"""Of a device's own drive limit: less is none, but as a rule a number whose words are exchanged."""
_PLAUSIBLE = (1e-3, FREQUENCY_HZ[1])
"""Of any float32 of the map, where it is not 0: V, Hz, V/s, s."""

_FORMATS = {"uint16": ">H", "uint32": ">I", "uint64": ">Q", "float32": ">f"}


@dataclass(frozen=True)
class SineCommand:
    """A sine asked for."""

    frequency_hz: float
    drive_v: float
    """Amplitude."""
    ramp_v_s: float
    sequence: int
    """1 to 65535; 0 stands for no command yet."""


@dataclass(frozen=True)
class Identity:
    """What the device says it is."""

    name: str
    serial_number: int


def next_sequence(sequence: int) -> int:
    """The number after this one: 65535 is followed by 1."""
    return sequence % 0xFFFF + 1


def encode(register: Register, value: Value) -> list[int]:
    """One quantity as registers, high word first."""
    if isinstance(value, str):
        data = value.encode("ascii")[: register.characters].ljust(register.characters, b"\0")
    else:
        data = struct.pack(_FORMATS[register.kind], value)
    return list(struct.unpack(f">{register.width}H", data))


def decode(register: Register, words: Sequence[int]) -> Value:
    """One quantity from its registers.

    Raises
    ------
    Garbled
        A number that is not finite, a text that is not printable ASCII, or not as many registers as it takes.
    """
    if len(words) != register.width:
        raise Garbled(f"{register.name}: {register.width} registers expected, {len(words)} came")
    data = struct.pack(f">{len(words)}H", *words)
    if register.kind == "string":
        return _text(register.name, data)
    value: int | float = struct.unpack(_FORMATS[register.kind], data)[0]
    if not math.isfinite(value):
        hint = _with_words_exchanged(data) if register.kind == "float32" else ""
        raise Garbled(f"{register.name}: a finite number expected, {value} came as {data.hex(' ', 2)}{hint}")
    return value


def encode_span(registers: RegisterMap, span: RegisterRun, values: Mapping[str, Value]) -> list[int]:
    """Several quantities in a row."""
    return [word for name in span.names for word in encode(registers[name], values[name])]


def decode_span(registers: RegisterMap, span: RegisterRun, words: Sequence[int]) -> dict[str, Value]:
    """Several quantities in a row; raises `Garbled` as `decode` does."""
    if len(words) != span.width:
        raise Garbled(f"{span.width} registers from {span.address} expected, {len(words)} came")
    offsets = {name: registers[name].address - span.address for name in span.names}
    return {n: decode(registers[n], words[k : k + registers[n].width]) for n, k in offsets.items()}


def encode_command(registers: RegisterMap, command: SineCommand) -> list[int]:
    """The command block, written whole.

    Raises
    ------
    Refused
        A number that is not finite or outside its limits. Nothing has been sent.
    """
    objection = _objection(command)
    if objection:
        raise Refused(f"command not sent: {objection}")
    (span,) = registers.spans(COMMAND)
    values = (command.frequency_hz, command.drive_v, command.ramp_v_s, command.sequence)
    return encode_span(registers, span, dict(zip(COMMAND, values, strict=True)))


def decode_command(registers: RegisterMap, words: Sequence[int]) -> SineCommand:
    """What the device is asked; raises `Garbled` where no sine can follow from it."""
    (span,) = registers.spans(COMMAND)
    values = decode_span(registers, span, words)
    frequency, drive, ramp, sequence = (values[name] for name in COMMAND)
    command = SineCommand(float(frequency), float(drive), float(ramp), int(sequence))
    objection = _objection(command)
    if objection:
        raise Garbled(f"command: {objection}")
    return command


def encode_status(status: ShakerStatus) -> dict[str, Value]:
    """The values of the status registers."""
    bits = (
        StatusBit.RUNNING * status.running
        | StatusBit.RAMPING * status.ramping
        | StatusBit.LIMITED * status.limited
        | StatusBit.INTERLOCK_OPEN * status.interlock_open
        | StatusBit.ALARM * (status.alarm is not Alarm.NONE)
    )
    return {
        "status": int(bits),
        "alarm": int(status.alarm),
        "drive_v_now": status.drive_v,
        "frequency_hz_now": status.frequency_hz,
        "limit_v": status.limit_v,
    }


def decode_status(values: Mapping[str, Value]) -> ShakerStatus:
    """The status from its registers.

    Raises
    ------
    Garbled
        An unknown alarm, an alarm bit that contradicts its number, or a negative amplitude or frequency.
    """
    bits = StatusBit(int(values["status"]) & sum(StatusBit))
    alarm = _alarm(int(values["alarm"]))
    if (StatusBit.ALARM in bits) != (alarm is not Alarm.NONE):
        raise Garbled(f"status: bits {int(bits):#06x} contradict alarm {alarm:d} ({alarm.name})")
    return ShakerStatus(
        running=StatusBit.RUNNING in bits,
        ramping=StatusBit.RAMPING in bits,
        limited=StatusBit.LIMITED in bits,
        interlock_open=StatusBit.INTERLOCK_OPEN in bits,
        alarm=alarm,
        drive_v=_not_negative(values, "drive_v_now"),
        frequency_hz=_not_negative(values, "frequency_hz_now"),
        limit_v=_not_negative(values, "limit_v"),
    )


def encode_echo(echo: Echo) -> dict[str, Value]:
    """The values of the echo registers."""
    sample = UNKNOWN_SAMPLE if echo.sample is None else echo.sample
    return {"echo_sequence": echo.sequence, "echo_sample": sample, "echo_drive_v": echo.drive_v}


def decode_echo(values: Mapping[str, Value]) -> Echo:
    """The receipt of a command; raises `Garbled` where the amplitude is negative."""
    sample = int(values["echo_sample"])
    return Echo(
        sequence=int(values["echo_sequence"]),
        sample=None if sample == UNKNOWN_SAMPLE else sample,
        drive_v=_not_negative(values, "echo_drive_v"),
    )


def encode_identity(identity: Identity) -> dict[str, Value]:
    """The values of the identity registers."""
    return {
        "map_version": MAP_VERSION,
        "serial_number": identity.serial_number,
        "identity": identity.name,
    }


def decode_identity(values: Mapping[str, Value]) -> Identity:
    """What the device is; raises `Garbled` where it follows another version of the register map."""
    if values["map_version"] != MAP_VERSION:
        raise Garbled(
            f"map_version: {MAP_VERSION} expected, {values['map_version']} came: "
            "not this device, or its registers lie elsewhere"
        )
    return Identity(str(values["identity"]), int(values["serial_number"]))


def heartbeat_timeout_objection(timeout_s: float) -> str | None:
    """Why the device cannot wait so long for a beat; None where it can."""
    return _outside("heartbeat_timeout_s", timeout_s, *HEARTBEAT_TIMEOUT_S)


def limit_objection(limit_v: float) -> str | None:
    """Why a device's own drive limit is none that a shaker has; None where it may be one."""
    if LEAST_LIMIT_V <= limit_v <= HIGHEST_DRIVE_V:
        return None
    wanted = f"at least {LEAST_LIMIT_V:g}" if limit_v < LEAST_LIMIT_V else f"at most {HIGHEST_DRIVE_V:g}"
    return f"its limit_v is {limit_v:.3g} V, {wanted} V expected{word_order_hint(limit_v)}"


def word_order_hint(value: float) -> str:
    """Asks for the order of words, of a float32 that cannot be, where it can with these exchanged.

    Begins with a blank; empty where that explains nothing.
    """
    return _with_words_exchanged(struct.pack(_FORMATS["float32"], value))


def _with_words_exchanged(data: bytes) -> str:
    value = struct.unpack(_FORMATS["float32"], data[2:] + data[:2])[0]
    lowest, highest = _PLAUSIBLE
    return f" (with its words exchanged {value:.4g}: word order?)" if lowest <= value <= highest else ""


def _objection(command: SineCommand) -> str | None:
    return (
        _outside("frequency_hz", command.frequency_hz, *FREQUENCY_HZ)
        or _outside("drive_v", command.drive_v, 0.0, HIGHEST_DRIVE_V)
        or _outside("ramp_v_s", command.ramp_v_s, *RAMP_V_S)
        or _outside("command_sequence", command.sequence, 1, 0xFFFF)
    )


def _outside(name: str, value: float, lowest: float, highest: float) -> str | None:
    # As a float32 the limits themselves may come out a little outside.
    slack = 1e-6 * abs(lowest), 1e-6 * abs(highest)
    if lowest - slack[0] <= value <= highest + slack[1]:
        return None
    return f"{name} = {value:g} is outside {lowest:g} to {highest:g}"


def _alarm(code: int) -> Alarm:
    try:
        return Alarm(code)
    except ValueError:
        known = ", ".join(f"{a:d} {a.name}" for a in Alarm)
        raise Garbled(f"alarm: one of {known} expected, {code} came") from None


def _not_negative(values: Mapping[str, Value], name: str) -> float:
    value = float(values[name])
    if value < 0:
        hint = word_order_hint(value)
        raise Garbled(f"{name}: no negative number expected, {value:g} came{hint}")
    return value


def _text(name: str, data: bytes) -> str:
    text = data.rstrip(b"\0 ")
    if not text.isascii() or not text.decode("ascii", "replace").isprintable():
        raise Garbled(f"{name}: printable ASCII expected, {text!r} came")
    return text.decode("ascii")
