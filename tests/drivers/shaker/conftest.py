"""A simulated shaker on the wire whose sample counter and wall clock the test turns by hand."""

import threading

import pytest

from drivers.shaker.modbus import ModbusShaker
from drivers.shaker.register_map import DEFAULT
from drivers.simulated.modbus_server import ModbusServer
from drivers.simulated.shaker_device import ShakerDevice
from drivers.simulated.shaker_registers import DeviceRegisters

RATE_HZ = 5000.0
DEADLINE_S = 5.0


class Rig:
    def __init__(self, registers=DEFAULT, *, port=0, rtu=False, **device):
        self.sample = 0
        self.wall_s = 100.0
        self.pieces = []
        self.changed = threading.Condition(threading.RLock())
        self.checks = 0
        self.device = ShakerDevice(self._on_drive, **device)
        self.lock = threading.RLock()
        served = DeviceRegisters(self.device, registers, self._clock, self._wall)
        self.server = ModbusServer(served, "simulated shaker", lock=self.lock, port=port, rtu=rtu)

    def set_running(self, shaker):
        """2 V at 50 Hz, standing still."""
        shaker.start()
        shaker.command(50.0, 2.0, 4.0)
        self.pass_time(1.0)

    def pass_time(self, seconds):
        """Sample time; the device learns of it."""
        with self.lock:
            self.sample += round(seconds * RATE_HZ)
            self.device.advance(self.sample / RATE_HZ)

    def pass_wall_time(self, seconds):
        """Wall time; returns when the heartbeat has been checked at the new one."""
        with self.lock, self.changed:
            self.wall_s += seconds
            seen = self.checks
        # The first look may have begun before.
        self.wait_for(lambda: self.checks >= seen + 2)

    def wait_for(self, condition):
        with self.changed:
            assert self.changed.wait_for(condition, DEADLINE_S)

    def whats(self):
        with self.lock:
            return [entry.what for entry in self.device.log]

    def _on_drive(self, piece):
        with self.changed:
            self.pieces.append(piece)
            self.changed.notify_all()

    def _clock(self):
        return self.sample, self.sample / RATE_HZ

    def _wall(self):
        with self.changed:
            self.checks += 1
            self.changed.notify_all()
            return self.wall_s


@pytest.fixture
def rig():
    rig = Rig()
    with rig.server:
        yield rig


@pytest.fixture(params=["tcp", "rtu"])
def wired(request):
    """A rig and a shaker on it, over both wires."""
    rig = Rig(rtu=request.param == "rtu")
    with rig.server:
        shaker = (
            ModbusShaker.rtu(rig.server.rtu_path)
            if request.param == "rtu"
            else ModbusShaker.tcp(*rig.server.address)
        )
        yield rig, shaker
        shaker.close()


@pytest.fixture
def shaker(rig):
    shaker = ModbusShaker.tcp(*rig.server.address, timeout_s=0.5)
    yield shaker
    shaker.close()


@pytest.fixture
def make_rig():
    return Rig
