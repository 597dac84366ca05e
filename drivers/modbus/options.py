"""What a device on Modbus TCP is described by, whatever it is."""

from typing import Self

from pydantic import model_validator

from drivers.modbus.address import host_and_port
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
