"""The simulated rig as its drivers meet it, and the cable its serial devices are on."""

import asyncio
import json
import os

import numpy as np

from drivers.shaker.modbus import ModbusShaker
from drivers.simulated.pseudo_terminals import PseudoTerminals
from drivers.simulated.rig import RigOptics, SimulatedRig
from drivers.simulated.sensors import SimulatedSensor
from drivers.simulated.world import Laser, Wiring, World
from drivers.vibrometer.interface import Range
from drivers.vibrometer.polytec_driver import PolytecDriver, PolytecOptions
from drivers.vibrometer.polytec_vibrometer import PolytecVibrometer


class Plate:
    def __init__(self):
        self.pieces = []

    def drive(self, piece):
        self.pieces.append(piece)

    def at(self, output, first_s, step_s, count):
        return np.zeros(count)


def world():
    inputs = {1: SimulatedSensor("base_acceleration", 1.0, 0.0, 10.0)}
    return World({"damped": Plate()}, Wiring(inputs), Laser(1.0, 10.0, 0.0), virtual=True)


def a_polytec(optics):
    return PolytecDriver().simulated(PolytecOptions(address="simulated"), optics)


def test_one_world_is_behind_every_device_and_the_rig_keeps_its_own_record(tmp_path):
    one, log = world(), tmp_path / "shaker.jsonl"
    rig = SimulatedRig(one, vibrometer=a_polytec, signal_level=0.6, limit_v=3.0, log=log)
    with rig as addresses:
        assert addresses["chamber_tcp"] == ""
        vibrometer = PolytecVibrometer(addresses["vibrometer_tty"])
        chosen = vibrometer.set_range("50mm/s/V")
        assert one.laser.scale_m_s_v == chosen.scale_m_s_v == 0.05
        vibrometer.close()
        host, port = addresses["modbus_tcp"].split(":")
        shaker = ModbusShaker.tcp(host, int(port))
        shaker.start()
        shaker.command(50.0, 0.5, 100.0)
        assert one.plates["damped"].pieces[-1].frequency_hz == 50.0
        shaker.stop()
        shaker.close()
    kept = [json.loads(line) for line in log.read_text().splitlines()]
    assert len(kept) == len(rig.device.log) > 0


def test_a_range_chosen_scales_what_the_front_end_is_given():
    one = world()
    optics = RigOptics(one, 0.4)
    optics.choose(Range("a", 0.125, 4.0, 1e4, None, verified=True))
    assert (one.laser.scale_m_s_v, one.laser.full_scale_v, optics.signal_level) == (0.125, 4.0, 0.4)


def test_a_cable_carries_both_ways_until_it_is_unplugged():
    async def talk():
        cable = PseudoTerminals(asyncio.get_running_loop())
        device, master = (
            os.open(path, os.O_RDWR | os.O_NOCTTY) for path in (cable.device_path, cable.master_path)
        )
        os.set_blocking(device, False)
        heard = []
        for sender, hearer, said in ((master, device, b"\x01\x03\r"), (device, master, b"\x00\n\xff")):
            os.write(sender, said)
            # The far end is heard by this very loop.
            await asyncio.sleep(0.01)
            heard.append(os.read(hearer, 64))
        cable.close()
        for end in (device, master):
            os.close(end)
        return heard

    assert asyncio.run(talk()) == [b"\x01\x03\r", b"\x00\n\xff"]
