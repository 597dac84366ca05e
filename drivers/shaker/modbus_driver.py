"""Shakers of the kinds `modbus-tcp` and `modbus-rtu`."""

from typing import Annotated, Literal

from pydantic import Field, model_validator

from drivers.modbus.address import host_and_port
from drivers.modbus.answer_time import answer_time_s, patience_s
from drivers.modbus.options import ModbusSerialLine, ModbusTcpAddress
from drivers.shaker.driver import ShakerDriver, ShakerOptions
from drivers.shaker.interface import Shaker
from drivers.shaker.register_map import DEFAULT


class ModbusOptions(ShakerOptions):
    """A controller or amplifier on Modbus."""

    unit: Annotated[int, Field(ge=0, le=255)] = 1
    registers: dict[str, Annotated[int, Field(ge=0, le=65535)]] = Field(default_factory=dict)
    """Addresses that differ from the documented map, by name."""
    baud: Annotated[int, Field(gt=0)] = 115200
    """Of a serial line."""

    @model_validator(mode="after")
    def _mapped(self) -> "ModbusOptions":
        DEFAULT.with_addresses(self.registers)
        return self


class ModbusTcpOptions(ModbusTcpAddress, ModbusOptions):
    """A controller or amplifier on Modbus TCP."""

    kind: Literal["modbus-tcp"] = "modbus-tcp"


class ModbusRtuOptions(ModbusSerialLine, ModbusOptions):
    """A controller or amplifier on a serial line."""

    kind: Literal["modbus-rtu"] = "modbus-rtu"
    baud: Annotated[int, Field(gt=0)] = 115200


class ModbusTcpDriver(ShakerDriver[ModbusTcpOptions]):
    """Modbus TCP: a device takes several connections."""

    options = ModbusTcpOptions
    is_shared = True

    def open(self, options: ModbusTcpOptions, *, timeout_s: float = 1.0, retries: int = 2) -> Shaker:
        """Connected to when first used."""
        from drivers.shaker.modbus import ModbusShaker

        host, port = host_and_port(options.address)
        registers = DEFAULT.with_addresses(options.registers)
        return ModbusShaker.tcp(
            host, port, unit=options.unit, registers=registers, timeout_s=timeout_s, retries=retries
        )


class ModbusRtuDriver(ShakerDriver[ModbusRtuOptions]):
    """Modbus RTU: a serial line has room for one program."""

    options = ModbusRtuOptions

    def open(self, options: ModbusRtuOptions, *, timeout_s: float = 1.0, retries: int = 2) -> Shaker:
        """Connected to when first used."""
        from drivers.shaker.modbus import ModbusShaker

        registers = DEFAULT.with_addresses(options.registers)
        return ModbusShaker.rtu(
            options.address,
            baud=options.baud,
            parity=options.parity,
            stop_bits=options.stop_bits,
            unit=options.unit,
            registers=registers,
            timeout_s=min(timeout_s, answer_time_s(options.baud, options.heartbeat_timeout_s)),
            retries=retries,
            patience_s=patience_s(options.heartbeat_timeout_s),
        )
