"""Degrees Celsius in Modbus registers, for both ends of the wire. No I/O."""

import math
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from drivers.errors import Garbled, Refused

Type = Literal["int16", "float32"]
RANGE_C = -273.15, 2000.0
"""No reading lies outside: a broken sensor does."""
_FORMATS = {"int16": ">h", "float32": ">f"}
_NO_READING = -0x8000, 0x7FFF
"""The ends of an int16: what a controller shows where its sensor is broken."""


@dataclass(frozen=True)
class TemperatureRegisters:
    """Where a device keeps its temperature and its set point, and how."""

    temperature: int
    """Address as on the wire, from 0."""
    set_point: int | None
    """None: a thermometer."""
    type: Type
    """A float32 takes two registers, the high word first."""
    scale_c: float
    """Degrees Celsius a count."""

    @property
    def width(self) -> int:
        """Registers that one temperature takes."""
        return struct.calcsize(_FORMATS[self.type]) // 2

    @property
    def resolution_c(self) -> float:
        """What is told and what is read back may differ by so much."""
        return self.scale_c if self.type == "int16" else 1e-3

    def encode(self, temperature_c: float) -> list[int]:
        """Raises `Refused` for what the register cannot hold."""
        count = temperature_c / self.scale_c
        try:
            data = struct.pack(_FORMATS[self.type], round(count) if self.type == "int16" else count)
        except (struct.error, OverflowError, ValueError):
            raise Refused(
                f"{temperature_c:g} °C does not go into an {self.type} of {self.scale_c:g} °C"
            ) from None
        return list(struct.unpack(f">{self.width}H", data))

    def decode(self, words: Sequence[int]) -> float:
        """Raises `Garbled` for what is no temperature."""
        if len(words) != self.width:
            raise Garbled(f"{self.width} registers expected, {len(words)} came")
        data = struct.pack(f">{len(words)}H", *words)
        count: float = struct.unpack(_FORMATS[self.type], data)[0]
        broken = self.type == "int16" and count in _NO_READING
        return refuse_senseless(math.nan if broken else count * self.scale_c, data.hex(" ", 2))


def refuse_senseless(temperature_c: float, came: str) -> float:
    """The temperature again, if a chamber can have it.

    Raises `Garbled` for one that cannot be; `came` is what the device said.
    """
    low, high = RANGE_C
    if not low <= temperature_c <= high:
        raise Garbled(f"{came}: a temperature of {low:g} to {high:g} °C expected: is the sensor broken?")
    return temperature_c
