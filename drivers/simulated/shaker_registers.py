"""A simulated shaker's registers: from words at addresses to the device and back. No wire.

Writing the command's sequence number makes the command take effect; its other registers may come before.
"""

import time
from collections.abc import Callable

from drivers.errors import Garbled, Refused
from drivers.shaker.interface import Echo
from drivers.shaker.protocol import (
    Value,
    decode,
    decode_command,
    encode,
    encode_echo,
    encode_identity,
    encode_status,
)
from drivers.shaker.register_map import COMMAND, ControlBits, Register, RegisterMap
from drivers.simulated.modbus_server import RegisterBlock
from drivers.simulated.shaker_device import ShakerDevice

Clock = Callable[[], tuple[int, float]]
"""Sample index and sample time in s, of this moment."""


class DeviceRegisters:
    """The device as a master sees it: words at addresses. Call it with the device's lock held.

    `clock` is never earlier than what the device was told before; `wall` in s is what the heartbeat lives by.
    """

    def __init__(
        self,
        device: ShakerDevice,
        registers: RegisterMap,
        clock: Clock,
        wall: Callable[[], float] = time.monotonic,
    ) -> None:
        self._device = device
        self._registers = registers
        self._clock = clock
        self._wall = wall
        self._asked = [0] * sum(registers[name].width for name in COMMAND)
        self._heartbeat = 0
        self._echo = Echo(sequence=0, sample=None, drive_v=0.0)

    def blocks(self) -> list[RegisterBlock]:
        """All there are."""
        return [RegisterBlock(r.address, r.width, r.writable) for r in self._registers]

    def watch(self) -> None:
        """Have the device see whether the heartbeat still comes."""
        self._device.check_heartbeat(self._wall(), self._clock()[1])

    def words(self) -> dict[int, int]:
        """Every word by its address, as of this moment."""
        status = self._device.status(self._clock()[1], self._wall())
        values: dict[str, Value] = {
            **encode_status(status),
            **encode_echo(self._echo),
            **encode_identity(self._device.identity),
            "control": int(ControlBits.RUN if status.running else ControlBits(0)),
            "heartbeat": self._heartbeat,
            "heartbeat_timeout_s": self._device.heartbeat_timeout_s,
        }
        words = {self._registers[COMMAND[0]].address + k: word for k, word in enumerate(self._asked)}
        for name, value in values.items():
            register = self._registers[name]
            words |= zip(range(register.address, register.end), encode(register, value), strict=True)
        return words

    def write(self, address: int, new: list[int]) -> None:
        """Words from a master.

        Raises
        ------
        Garbled
            Numbers that cannot be.
        Refused
            The device said no.
        """
        written = range(address, address + len(new))
        words = self.words() | dict(zip(written, new, strict=True))

        def touched(name: str) -> list[int] | None:
            r = self._registers[name]
            own = range(r.address, r.end)
            return [words[a] for a in own] if set(own) & set(written) else None

        if (found := touched("heartbeat_timeout_s")) is not None:
            self._set_heartbeat_timeout(self._registers["heartbeat_timeout_s"], found)
        if (found := touched("heartbeat")) is not None:
            self._beat(found[0])
        if (found := touched("control")) is not None:
            self._control(found[0])
        begin = self._registers[COMMAND[0]].address
        asked = [words[a] for a in range(begin, begin + len(self._asked))]
        if touched("command_sequence") is not None:
            self._command(asked)
        self._asked = asked

    def _set_heartbeat_timeout(self, register: Register, words: list[int]) -> None:
        timeout = float(decode(register, words))
        try:
            self._device.set_heartbeat_timeout(timeout)
        except Refused as problem:
            raise Garbled(str(problem)) from problem

    def _beat(self, value: int) -> None:
        if value != self._heartbeat:
            self._heartbeat = value
            self._device.beat(self._wall())

    def _control(self, word: int) -> None:
        now_s, wall_s = self._clock()[1], self._wall()
        match word:
            case ControlBits.RUN:
                self._device.start(now_s, wall_s)
            case 0:
                self._device.stop(now_s, wall_s)
            case ControlBits.RESET_ALARM:
                self._device.stop(now_s, wall_s)
                self._device.reset_alarm(now_s, wall_s)
            case _:
                raise Garbled(
                    f"control word {word:#06x}: run and reset go one at a time, other bits mean nothing"
                )

    def _command(self, words: list[int]) -> None:
        command = decode_command(self._registers, words)
        # The same number again is the same command: its answer was lost on the way.
        if command.sequence == self._echo.sequence:
            return
        sample, now_s = self._clock()
        accepted = self._device.command(
            command.frequency_hz, command.drive_v, command.ramp_v_s, now_s, self._wall()
        )
        self._echo = Echo(command.sequence, sample, accepted)
