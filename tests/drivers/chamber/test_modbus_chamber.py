import socket
import threading

import pytest

from drivers.chamber import Chamber
from drivers.chamber.modbus import ModbusChamber
from drivers.chamber.registers import TemperatureRegisters
from drivers.errors import Garbled, Refused, Unreachable
from drivers.modbus.line import ModbusLine
from drivers.simulated.chamber_registers import ChamberRegisters
from drivers.simulated.climate import Climate
from drivers.simulated.modbus_server import ModbusServer

TENTHS = TemperatureRegisters(100, 300, "int16", 0.1)
FLOATS = TemperatureRegisters(10, 12, "float32", 1.0)


class Room:
    """A simulated chamber on the loopback whose clock the test turns by hand."""

    def __init__(self, registers: TemperatureRegisters) -> None:
        self.now_s = 0.0
        self.climate = Climate(air_s=100.0, plate_s=100.0)
        self.served = ChamberRegisters(self.climate, registers, lambda: self.now_s)
        self.server = ModbusServer(self.served, "simulated chamber", lock=threading.RLock())

    def driver(self, registers: TemperatureRegisters) -> ModbusChamber:
        line = ModbusLine.tcp("chamber", *self.server.address, unit=1, timeout_s=0.3, retries=1)
        return ModbusChamber(line, registers)


@pytest.fixture(params=[TENTHS, FLOATS], ids=["int16", "float32"])
def at_hand(request):
    room = Room(request.param)
    with room.server:
        chamber = room.driver(request.param)
        yield room, chamber
        chamber.close()


def test_it_goes_where_it_is_told_and_says_so(at_hand):
    room, chamber = at_hand
    any_make: Chamber = chamber
    assert any_make.identity() == "chamber at {}:{} unit 1".format(*room.server.address)
    assert (any_make.temperature_c(), any_make.set_point_c()) == (pytest.approx(22.0), pytest.approx(22.0))
    assert any_make.go_to(35.0) == pytest.approx(35.0)
    room.now_s = 1e4
    assert (any_make.temperature_c(), any_make.set_point_c()) == (pytest.approx(35.0), pytest.approx(35.0))


def test_below_zero_is_below_zero(at_hand):
    room, chamber = at_hand
    room.climate.air_c = lambda now_s: -3.4
    assert chamber.temperature_c() == pytest.approx(-3.4)


def test_what_the_chamber_cannot_is_refused_in_one_line_and_nothing_changes(at_hand):
    _, chamber = at_hand
    with pytest.raises(
        Refused, match=r"^chamber at .*writing set point 80 °C: refused with Modbus exc[^\n]*$"
    ):
        chamber.go_to(80.0)
    assert chamber.set_point_c() == pytest.approx(22.0)


def test_a_chamber_that_keeps_another_set_point_is_refused(at_hand):
    room, chamber = at_hand
    room.climate.go_to = lambda now_s, set_point_c: None
    with pytest.raises(Refused, match=r"set point 35 °C was asked, the device keeps 22 °C"):
        chamber.go_to(35.0)


def test_a_thermometer_takes_no_set_point():
    registers = TemperatureRegisters(0, None, "int16", 0.1)
    room = Room(registers)
    with room.server:
        thermometer = room.driver(registers)
        assert thermometer.temperature_c() == pytest.approx(22.0)
        assert thermometer.set_point_c() is None
        with pytest.raises(Refused, match="a thermometer, it takes no set point"):
            thermometer.go_to(30.0)
        thermometer.close()


def test_registers_that_are_not_there_are_refused(at_hand):
    room, _ = at_hand
    elsewhere = room.driver(TemperatureRegisters(200, None, "int16", 0.1))
    with pytest.raises(Refused, match=r"reading temperature: refused with Modbus exception 2"):
        elsewhere.temperature_c()
    elsewhere.close()


def test_a_broken_sensor_is_no_temperature(at_hand):
    room, chamber = at_hand
    words, first = room.served.words, room.served.blocks()[0]
    broken = [0x7FFF] if first.width == 1 else [0x7FC0, 0]
    room.served.words = lambda: words() | {first.address + k: w for k, w in enumerate(broken)}
    with pytest.raises(Garbled, match=r"^chamber at .*temperature: .*is the sensor broken\?$"):
        chamber.temperature_c()


def test_unplugged_and_plugged_in_again(at_hand):
    room, chamber = at_hand
    assert chamber.temperature_c() == pytest.approx(22.0)
    room.server.stop()
    with pytest.raises(Unreachable, match=r"^chamber at .*attempts"):
        chamber.temperature_c()
    room.server.start()
    assert chamber.temperature_c() == pytest.approx(22.0)


def test_garbage_on_the_wire_is_garbled():
    with socket.create_server(("127.0.0.1", 0)) as listening:

        def talk():
            for _ in range(2):
                connection, _ = listening.accept()
                connection.recv(64)
                connection.sendall(b"220.5 C\r\n")
                connection.close()

        talking = threading.Thread(target=talk, daemon=True)
        talking.start()
        line = ModbusLine.tcp("chamber", *listening.getsockname(), unit=1, timeout_s=0.3, retries=1)
        with pytest.raises((Garbled, Unreachable), match=r"^chamber at .*reading temperature: [^\n]*$"):
            ModbusChamber(line, TENTHS).temperature_c()
        line.close()
        talking.join(5)


@pytest.mark.parametrize("value", [4000.0, float("nan"), float("inf")])
def test_what_a_register_cannot_hold_is_not_sent(value):
    with pytest.raises(Refused, match="does not go into an int16"):
        TENTHS.encode(value)
