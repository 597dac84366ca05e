"""The shaker's Modbus registers as data: names, addresses, types. All are holding registers.

No maker publishes the map of a vibration controller, so this one is the project's own; `with_addresses` fits
it to a device that keeps the same quantities elsewhere. Of several registers the first is the high word.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from enum import IntFlag
from itertools import pairwise
from typing import Literal

MAP_VERSION = 1
"""Counts changes of meaning, not of addresses."""

Kind = Literal["uint16", "uint32", "uint64", "float32", "string"]
_WIDTH: dict[Kind, int] = {"uint16": 1, "uint32": 2, "uint64": 4, "float32": 2}


class ControlBits(IntFlag):
    """Bits of the control word. A word without RUN stops."""

    RUN = 1
    RESET_ALARM = 2


class StatusBit(IntFlag):
    """Bits of the status word. Others mean nothing and are not looked at."""

    RUNNING = 1
    RAMPING = 2
    LIMITED = 4
    INTERLOCK_OPEN = 8
    ALARM = 16


@dataclass(frozen=True)
class Register:
    """One quantity in one or more registers in a row."""

    name: str
    address: int
    """Of the first register, from 0 as on the wire."""
    kind: Kind
    writable: bool
    meaning: str
    characters: int = 0
    """Of a string, two to a register, padded with NUL."""

    @property
    def width(self) -> int:
        """How many registers it takes."""
        return self.characters // 2 if self.kind == "string" else _WIDTH[self.kind]

    @property
    def end(self) -> int:
        """Address after its last register."""
        return self.address + self.width


@dataclass(frozen=True)
class RegisterRun:
    """Registers in a row that one transaction carries."""

    address: int
    names: tuple[str, ...]
    width: int


COMMAND = ("frequency_hz", "drive_v", "ramp_v_s", "command_sequence")
"""In a row and in this order: one write carries them all, so a command is never half there."""
STATUS = ("status", "alarm", "drive_v_now", "frequency_hz_now", "limit_v")
"""Read together, so keep them in a row: apart, they may be of two moments."""
ECHO = ("echo_sequence", "echo_sample", "echo_drive_v")
IDENTITY = ("map_version", "serial_number", "identity")

MAX_SPAN = 125
"""Most registers that one Modbus read carries."""


@dataclass(frozen=True)
class RegisterMap:
    """Where each quantity lives.

    Raises
    ------
    ValueError
        Registers overlap or run out of the address space, or the command block is not in a row.
    """

    registers: tuple[Register, ...]

    def __post_init__(self) -> None:
        self._refuse_out_of_range()
        self._refuse_overlaps()
        self._refuse_scattered_command()

    def __iter__(self) -> Iterator[Register]:
        return iter(self.registers)

    def __getitem__(self, name: str) -> Register:
        return next(r for r in self.registers if r.name == name)

    def with_addresses(self, addresses: Mapping[str, int]) -> "RegisterMap":
        """Quantities at other addresses; those not named stay.

        Raises
        ------
        ValueError
            An unknown name, or what `RegisterMap` refuses.
        """
        known = [r.name for r in self.registers]
        unknown = [name for name in addresses if name not in known]
        if unknown:
            raise ValueError(f"no register is called {', '.join(unknown)}: known are {', '.join(known)}")
        moved = (replace(r, address=addresses.get(r.name, r.address)) for r in self.registers)
        return RegisterMap(tuple(moved))

    def spans(self, names: tuple[str, ...]) -> tuple[RegisterRun, ...]:
        """The fewest transactions that carry these and nothing else, lowest address first."""
        found: list[RegisterRun] = []
        for r in sorted((self[name] for name in names), key=lambda r: r.address):
            last = found[-1] if found else None
            if last and last.address + last.width == r.address and last.width + r.width <= MAX_SPAN:
                found[-1] = RegisterRun(last.address, (*last.names, r.name), last.width + r.width)
            else:
                found.append(RegisterRun(r.address, (r.name,), r.width))
        return tuple(found)

    def _refuse_out_of_range(self) -> None:
        for r in self.registers:
            if not 0 <= r.address <= 0x10000 - r.width:
                raise ValueError(
                    f"{r.name} at {r.address} with {r.width} registers is outside 0 to 65535: "
                    "count addresses from 0, as on the wire"
                )

    def _refuse_overlaps(self) -> None:
        ordered = sorted(self.registers, key=lambda r: r.address)
        for low, high in pairwise(ordered):
            if high.address < low.end:
                raise ValueError(
                    f"{low.name} at {low.address} to {low.end - 1} overlaps {high.name} at {high.address}: "
                    "move one of them"
                )

    def _refuse_scattered_command(self) -> None:
        block = [self[name] for name in COMMAND]
        for before, after in pairwise(block):
            if after.address != before.end:
                raise ValueError(
                    f"{after.name} at {after.address} does not follow {before.name}, which ends at "
                    f"{before.end - 1}: {', '.join(COMMAND)} go in one write, so move all four together"
                )


DEFAULT = RegisterMap(
    (
        Register("frequency_hz", 0, "float32", True, "asked, Hz"),
        Register("drive_v", 2, "float32", True, "asked amplitude, V"),
        Register("ramp_v_s", 4, "float32", True, "change of the amplitude, V/s"),
        Register(
            "command_sequence", 6, "uint16", True, "a new number, not 0, makes the three above take effect"
        ),
        Register("control", 7, "uint16", True, "bits: 0 run, 1 reset alarm; 0 stops"),
        Register("heartbeat", 8, "uint16", True, "any changed value is a beat"),
        Register("heartbeat_timeout_s", 9, "float32", True, "silent after so long without a beat, s"),
        Register(
            "status", 20, "uint16", False, "bits: 0 running, 1 ramping, 2 limited, 3 interlock open, 4 alarm"
        ),
        Register(
            "alarm",
            21,
            "uint16",
            False,
            "0 none, 1 heartbeat, 2 interlock, 3 overdrive, 4 amplifier; latched",
        ),
        Register("drive_v_now", 22, "float32", False, "amplitude at the output, V"),
        Register("frequency_hz_now", 24, "float32", False, "at the output, Hz"),
        Register("limit_v", 26, "float32", False, "the device's own drive limit, V"),
        Register("echo_sequence", 28, "uint16", False, "number of the last command taken; 0: none yet"),
        Register("echo_sample", 29, "uint64", False, "sample at which it took effect; all ones: not known"),
        Register("echo_drive_v", 33, "float32", False, "amplitude accepted, V"),
        Register("map_version", 40, "uint16", False, f"of this table: {MAP_VERSION}"),
        Register("serial_number", 41, "uint32", False, "of the device"),
        Register("identity", 43, "string", False, "maker, model, version, ASCII", characters=32),
    )
)
