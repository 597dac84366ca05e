"""The simulated rig: one world behind a Modbus shaker, a serial vibrometer and a LAN-XI front-end.

A chamber on Modbus stands around it where there is one. The vibrometer is its driver's own simulated one.
"""

import json
import threading
import time
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, ExitStack
from dataclasses import asdict, dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from drivers.chamber.registers import TemperatureRegisters
from drivers.shaker.register_map import DEFAULT, RegisterMap
from drivers.simulated.chamber_registers import ChamberRegisters
from drivers.simulated.climate import Climate
from drivers.simulated.lan_xi_server import LanXiServer
from drivers.simulated.modbus_server import ModbusServer
from drivers.simulated.shaker_device import LogEntry, ShakerDevice
from drivers.simulated.shaker_registers import DeviceRegisters
from drivers.simulated.world import World
from drivers.vibrometer.driver import Optics
from drivers.vibrometer.interface import Range

SAMPLE_RATES_HZ = tuple(131072.0 / 2**k for k in range(10))
_TICK_S = 0.02
_LONGEST_RAMP_S = 60.0
_GRACE_S = 1.0


@dataclass(frozen=True)
class Ports:
    """Where to listen; 0 for free ones."""

    modbus: int = 0
    front_end: int = 0
    chamber: int = 0


@dataclass(frozen=True)
class SimulatedChamber:
    """What stands around the plate, and how it is spoken to."""

    climate: Climate
    registers: TemperatureRegisters
    unit: int = 1


VibrometerPeer = Callable[[Optics], AbstractContextManager[str]]
"""A simulated vibrometer: entered it answers at the address it gives."""


class RigOptics:
    """`Optics` of a world's laser."""

    def __init__(self, world: World, signal_level: float) -> None:
        self._world, self._signal_level = world, signal_level

    @property
    def signal_level(self) -> float:
        """How much light comes back, 0 to 1."""
        return self._signal_level

    def choose(self, chosen: Range) -> None:
        """The range in use from now on."""
        with self._world.lock:
            self._world.laser.scale_m_s_v = chosen.scale_m_s_v
            self._world.laser.full_scale_v = chosen.full_scale_v


class SimulatedRig:
    """Stands from entering to leaving the context."""

    def __init__(
        self,
        world: World,
        *,
        vibrometer: VibrometerPeer,
        signal_level: float,
        limit_v: float,
        registers: RegisterMap = DEFAULT,
        unit: int = 1,
        heartbeat_timeout_s: float = 2.0,
        ports: Ports = Ports(),
        log: Path | None = None,
        chamber: SimulatedChamber | None = None,
        transducers: Mapping[int, dict[str, Any]] = MappingProxyType({}),
    ) -> None:
        self.world, self._ports, self._log_path = world, ports, log
        self._transducers = transducers
        self._written = 0
        self._registers, self._unit = registers, unit
        self.device = ShakerDevice(
            world.drive,
            limit_v=limit_v,
            heartbeat_timeout_s=heartbeat_timeout_s,
            # Virtual time may stand still for good once a program has hung: then there is no time for a ramp.
            emergency_ramp_s=0.0 if world.virtual else 0.1,
        )
        world.advance = self.device.advance
        self._optics = RigOptics(world, signal_level)
        self._peer, self._chamber = vibrometer, chamber
        self._ending = threading.Event()
        self._stack = ExitStack()

    def __enter__(self) -> dict[str, str]:
        """Addresses by the names `viscorig simulate` prints."""
        world = self.world
        with ExitStack() as stack:
            vibrometer_tty = stack.enter_context(self._peer(self._optics))
            inputs = max(8, *world.wiring.inputs)
            front_end = stack.enter_context(
                LanXiServer(
                    world,
                    channels=inputs,
                    sample_rates=SAMPLE_RATES_HZ,
                    port=self._ports.front_end,
                    pace="asked" if world.virtual else "real",
                    operator_channel=world.at_operator_channel,
                    transducers=self._transducers,
                )
            )
            modbus = stack.enter_context(
                ModbusServer(
                    DeviceRegisters(self.device, self._registers, world.clock),
                    "simulated shaker",
                    lock=world.lock,
                    port=self._ports.modbus,
                    rtu=True,
                    unit=self._unit,
                )
            )
            chamber_tcp = self._stand_up_chamber(stack)
            ticking = threading.Thread(target=self._tick, name="simulated rig", daemon=True)
            ticking.start()
            stack.callback(ticking.join)
            stack.callback(self._ending.set)
            self._stack = stack.pop_all()
        self.front_end, self.modbus = front_end, modbus
        host, port = modbus.address
        return {
            "modbus_tcp": f"{host}:{port}",
            "modbus_rtu": modbus.rtu_path or "",
            "vibrometer_tty": vibrometer_tty,
            "frontend_url": front_end.url,
            "chamber_tcp": chamber_tcp,
        }

    def __exit__(self, *_: object) -> None:
        # Whoever drove it may be dead: the device stays until its own heartbeat has silenced it.
        deadline = time.monotonic() + self.device.heartbeat_timeout_s + _GRACE_S
        while self._running() and time.monotonic() < deadline:
            time.sleep(_TICK_S)
        self._stack.close()
        # A ramp to rest ends, as it would have, though nobody watches.
        now_s = self.world.clock()[1]
        self.device.advance(now_s + _LONGEST_RAMP_S)
        self._write_log()

    def _running(self) -> bool:
        with self.world.lock:
            return self.device.status(self.world.clock()[1]).running

    def _stand_up_chamber(self, stack: ExitStack) -> str:
        """Where it answers; empty where there is none."""
        if self._chamber is None:
            return ""
        world = self.world
        served = ChamberRegisters(self._chamber.climate, self._chamber.registers, lambda: world.clock()[1])
        server = ModbusServer(
            served, "simulated chamber", lock=world.lock, port=self._ports.chamber, unit=self._chamber.unit
        )
        self.chamber = stack.enter_context(server)
        host, port = self.chamber.address
        return f"{host}:{port}"

    def _tick(self) -> None:
        while not self._ending.wait(_TICK_S):
            with self.world.lock:
                _, now_s = self.world.clock()
                # The device's own watch, whether or not anybody is connected.
                self.device.check_heartbeat(time.monotonic(), now_s)
                status = self.device.status(now_s)
                self.world.tick(status.ramping and not status.running)
                self._write_log()

    def _write_log(self) -> None:
        """The rig's own record of its shaker, a line an entry."""
        if self._log_path is None:
            return
        new: list[LogEntry] = self.device.log[self._written :]
        if new:
            with self._log_path.open("a", encoding="utf-8") as file:
                file.writelines(json.dumps(asdict(entry)) + "\n" for entry in new)
            self._written += len(new)
