"""A chamber or thermometer on Modbus, its registers as the rig file states them.

One rule: a set point is believed when it is read back.
"""

from drivers.chamber.registers import TemperatureRegisters
from drivers.errors import DriverError, Refused
from drivers.modbus.line import ModbusLine


class ModbusChamber:
    """`Chamber` over Modbus. Raises what the line raises, `Garbled` where a register holds no temperature."""

    def __init__(self, line: ModbusLine, registers: TemperatureRegisters) -> None:
        self._line, self._registers = line, registers

    def identity(self) -> str:
        """There is no register for a name: that it answers, and where."""
        self.temperature_c()
        return self._line.name

    def temperature_c(self) -> float:
        """Measured now."""
        return self._read("temperature", self._registers.temperature)

    def set_point_c(self) -> float | None:
        """The one that the device keeps; None for a thermometer."""
        address = self._registers.set_point
        return None if address is None else self._read("set point", address)

    def go_to(self, set_point_c: float) -> float:
        """Write and read back. `Refused` where the device keeps another set point, and by a thermometer."""
        address = self._registers.set_point
        if address is None:
            raise Refused(f"{self._line.name}: a thermometer, it takes no set point")
        try:
            words = self._registers.encode(set_point_c)
        except Refused as problem:
            raise Refused(f"{self._line.name}, set point not sent: {problem}") from None
        self._line.write(f"set point {set_point_c:g} °C", address, words)
        kept = self._read("set point", address)
        if abs(kept - set_point_c) > self._registers.resolution_c:
            raise Refused(
                f"{self._line.name}: set point {set_point_c:g} °C was asked, the device keeps {kept:g} °C"
            )
        return kept

    def close(self) -> None:
        """Let go of the connection."""
        self._line.close()

    def _read(self, what: str, address: int) -> float:
        words = self._line.read(what, address, self._registers.width)
        try:
            return self._registers.decode(words)
        except DriverError as problem:
            raise type(problem)(f"{self._line.name}, {what}: {problem}") from None
