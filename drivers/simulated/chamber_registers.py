"""A simulated chamber's registers: from words at addresses to its climate and back. No wire."""

from collections.abc import Callable

from drivers.chamber.registers import TemperatureRegisters
from drivers.errors import Garbled
from drivers.simulated.climate import Climate
from drivers.simulated.modbus_server import RegisterBlock


class ChamberRegisters:
    """The chamber as a master sees it. `now_s` is the sample clock, never earlier than what it was told."""

    def __init__(self, climate: Climate, registers: TemperatureRegisters, now_s: Callable[[], float]) -> None:
        self._climate, self._registers, self._now_s = climate, registers, now_s

    def blocks(self) -> list[RegisterBlock]:
        """The temperature; the set point where there is one."""
        r = self._registers
        blocks = [RegisterBlock(r.temperature, r.width, writable=False)]
        if r.set_point is not None:
            blocks.append(RegisterBlock(r.set_point, r.width, writable=True))
        return sorted(blocks, key=lambda b: b.address)

    def watch(self) -> None:
        """Nothing happens by itself."""

    def words(self) -> dict[int, int]:
        """Every word by its address, as of this moment."""
        r = self._registers
        values = {r.temperature: self._climate.air_c(self._now_s())}
        if r.set_point is not None:
            values[r.set_point] = self._climate.set_point_c
        return {at + k: word for at, value in values.items() for k, word in enumerate(r.encode(value))}

    def write(self, address: int, new: list[int]) -> None:
        """A new set point, whole. Raises `Garbled` for half of one, `Refused` for what it cannot reach."""
        if len(new) != self._registers.width:
            raise Garbled(f"{self._registers.width} registers expected, {len(new)} came")
        self._climate.go_to(self._now_s(), self._registers.decode(new))
