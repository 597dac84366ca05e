"""Thermometers of the kind `serial`."""

from typing import Annotated, Literal

from pydantic import Field

from drivers.chamber.driver import ChamberDriver, ChamberOptions
from drivers.chamber.interface import Chamber


class SerialThermometerOptions(ChamberOptions):
    """A thermometer that says one number a line, in degrees Celsius."""

    kind: Literal["serial"] = "serial"
    address: str
    """A serial port."""
    baud: Annotated[int, Field(gt=0)] = 9600
    query: Annotated[str, Field(max_length=80, pattern=r"^[\x20-\x7e]*$")] = ""
    """What it is asked with; empty where it sends lines by itself, at least one a second."""
    line_end: Literal["\r\n", "\n", "\r"] = "\r\n"
    """After the query."""


class SerialThermometerDriver(ChamberDriver[SerialThermometerOptions]):
    """A line of text, a number in it."""

    options = SerialThermometerOptions

    def open(self, options: SerialThermometerOptions) -> Chamber:
        """Opened when first used."""
        from drivers.chamber.serial_port import SerialThermometer

        return SerialThermometer(
            options.address, baud=options.baud, query=options.query, line_end=options.line_end
        )
