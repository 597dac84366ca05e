"""What a device on Modbus TCP or on a serial line is described by, whatever it is."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from drivers.modbus.address import host_and_port, serial_port
from drivers.options import DeviceOptions


class ModbusTcpAddress(DeviceOptions):
    """The address of a device's table; a device's own model has the rest of its keys."""

    address: str
    """host:port."""

    @model_validator(mode="after")
    def _reachable(self) -> Self:
        if self.is_addressed:
            host_and_port(self.address)
        return self


class ModbusSerialLine(DeviceOptions):
    """Port and settings of a serial line, 8 data bits; a device's own model has the rest of its keys."""

    address: str
    """A serial port."""
    baud: Annotated[int, Field(gt=0)]
    parity: Literal["N", "E", "O"] = "N"
    """None, even or odd: Modbus' own default is even, the device's document says which it has."""
    stop_bits: Literal[1, 2] = 1
    """1 or 2."""

    @model_validator(mode="after")
    def _a_port(self) -> Self:
        if self.is_addressed:
            serial_port(self.address)
        return self
