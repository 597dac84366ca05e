"""Chambers and thermometers of the kinds `modbus-tcp` and `modbus-rtu`."""

from typing import Annotated, Literal

from pydantic import Field, model_validator

from drivers.chamber.driver import ChamberDriver, ChamberOptions
from drivers.chamber.interface import Chamber
from drivers.chamber.registers import TemperatureRegisters
from drivers.modbus.address import host_and_port
from drivers.modbus.options import ModbusSerialLine, ModbusTcpAddress

_Address = Annotated[int, Field(ge=0, le=65535)]
_TIMEOUT_S, _RETRIES = 0.5, 2
"""Read between the steps of a sweep: while it is waited for, the shaker's heartbeat is not beaten."""
_PATIENCE_S = 0.25
"""For answers that come after their time-out; three attempts and this are less than the usual heartbeat."""


class ModbusChamberOptions(ChamberOptions):
    """Holding registers, addresses from 0 as on the wire."""

    unit: Annotated[int, Field(ge=0, le=255)] = 1
    temperature_register: _Address
    """The measured temperature."""
    set_point_register: _Address | None = None
    """Without it a thermometer."""
    type: Literal["int16", "float32"]
    """Of both registers; float32 with the high word first."""
    scale_c: Annotated[float, Field(gt=0, le=1000)] | None = None
    """Degrees Celsius a count; an int16 needs it said."""

    @model_validator(mode="after")
    def _scaled(self) -> "ModbusChamberOptions":
        if self.type == "int16" and self.scale_c is None:
            raise ValueError('scale_c: missing, expected with type = "int16": 0.1 where 235 means 23.5 °C')
        if self.set_point_register == self.temperature_register:
            raise ValueError(
                f"set_point_register: {self.set_point_register} is the temperature's own register"
            )
        return self

    @property
    def has_set_point(self) -> bool:
        """With a register for it."""
        return self.set_point_register is not None

    @property
    def registers(self) -> TemperatureRegisters:
        """Registers as the driver and the simulated device take them."""
        return TemperatureRegisters(
            self.temperature_register, self.set_point_register, self.type, self.scale_c or 1.0
        )


class ModbusTcpChamberOptions(ModbusTcpAddress, ModbusChamberOptions):
    """A chamber on Modbus TCP."""

    kind: Literal["modbus-tcp"] = "modbus-tcp"


class ModbusRtuChamberOptions(ModbusSerialLine, ModbusChamberOptions):
    """A chamber on a serial line of its own."""

    kind: Literal["modbus-rtu"] = "modbus-rtu"
    baud: Annotated[int, Field(gt=0)] = 9600


class ModbusTcpChamberDriver(ChamberDriver[ModbusTcpChamberOptions]):
    """Modbus TCP."""

    options = ModbusTcpChamberOptions

    def open(self, options: ModbusTcpChamberOptions) -> Chamber:
        """Connected to when first used."""
        from drivers.chamber.modbus import ModbusChamber
        from drivers.modbus.line import ModbusLine

        host, port = host_and_port(options.address)
        line = ModbusLine.tcp(
            "chamber", host, port, unit=options.unit, timeout_s=_TIMEOUT_S, retries=_RETRIES
        )
        return ModbusChamber(line, options.registers)


class ModbusRtuChamberDriver(ChamberDriver[ModbusRtuChamberOptions]):
    """Modbus RTU."""

    options = ModbusRtuChamberOptions

    def open(self, options: ModbusRtuChamberOptions) -> Chamber:
        """Connected to when first used."""
        from drivers.chamber.modbus import ModbusChamber
        from drivers.modbus.line import ModbusLine

        line = ModbusLine.rtu(
            "chamber",
            options.address,
            baud=options.baud,
            parity=options.parity,
            stop_bits=options.stop_bits,
            unit=options.unit,
            timeout_s=_TIMEOUT_S,
            retries=_RETRIES,
            patience_s=_PATIENCE_S,
        )
        return ModbusChamber(line, options.registers)
