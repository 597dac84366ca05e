"""The driver against the simulated device, over a real wire."""

import socket

import pytest
from vibrometer_template.device import TemplateVibrometer
from vibrometer_template.driver import TemplateDriver, TemplateOptions
from vibrometer_template.simulated import SimulatedVibrometer

from drivers.errors import Garbled, Refused, TimedOut, Unreachable


class Optics:
    signal_level = 0.8

    def __init__(self):
        self.chosen = []

    def choose(self, chosen):
        self.chosen.append(chosen.name)


@pytest.fixture
def device():
    simulated = SimulatedVibrometer(Optics())
    with simulated:
        yield simulated


@pytest.fixture
def vibrometer(device):
    host, port = device.address.split(":")
    driver = TemplateVibrometer(host, int(port), timeout_s=0.2)
    yield driver
    driver.close()


def test_it_says_who_it_is_and_how_much_light_comes_back(vibrometer):
    assert vibrometer.identity() == "VIBRO 1,serial 42"
    assert vibrometer.signal_level() == 0.8


def test_every_range_is_set_and_read_back_and_the_laser_follows(device, vibrometer):
    for wanted in vibrometer.ranges:
        assert vibrometer.set_range(wanted.name) == wanted == vibrometer.range()
    assert device._optics.chosen[1:] == [r.name for r in vibrometer.ranges]


def test_a_range_that_the_device_does_not_take_is_refused(device, vibrometer):
    device.faults.stuck_range = True
    with pytest.raises(Refused, match="500mm/s/V was asked, the device keeps 20mm/s/V"):
        vibrometer.set_range("500mm/s/V")


@pytest.mark.parametrize("kind", ["silent", "torn", "garbled", "hangs up"])
def test_one_bad_answer_is_asked_for_again(device, vibrometer, kind):
    device.faults.kind, device.faults.answers = kind, 1
    assert vibrometer.set_range("100mm/s/V").name == "100mm/s/V"


@pytest.mark.parametrize(
    ("kind", "error"),
    [("silent", TimedOut), ("torn", TimedOut), ("garbled", Garbled), ("hangs up", Unreachable)],
)
def test_many_bad_answers_end_in_one_line_that_names_the_device(device, vibrometer, kind, error):
    device.faults.kind, device.faults.answers = kind, 100
    with pytest.raises(error, match=r"^vibrometer at 127\.0\.0\.1:\d+: RANGE\?: .*, 3 attempts$"):
        vibrometer.range()


def test_an_unplugged_device_that_comes_back_is_found_again(device, vibrometer):
    device.unplug()
    assert vibrometer.range().name == "20mm/s/V"


def test_somebody_else_at_the_address_is_refused_at_once(device):
    device.faults.kind, device.faults.answers = "no vibrometer", 100
    host, port = device.address.split(":")
    with pytest.raises(Garbled, match="expected a name that begins with VIBRO"):
        TemplateVibrometer(host, int(port), timeout_s=0.2)


def test_nobody_at_the_address_is_unreachable():
    with socket.socket() as unused:
        unused.bind(("127.0.0.1", 0))
        port = unused.getsockname()[1]
    with pytest.raises(Unreachable, match="3 attempts"):
        TemplateVibrometer("127.0.0.1", port, timeout_s=0.2)


def test_a_closed_driver_says_so(vibrometer):
    vibrometer.close()
    with pytest.raises(Unreachable, match="was closed"):
        vibrometer.range()


def test_the_rig_file_opens_it(device):
    driver = TemplateDriver()
    vibrometer = driver.open(TemplateOptions(address=device.address, timeout_s=0.2))
    assert vibrometer.ranges == driver.ranges(TemplateOptions(address=device.address))
    vibrometer.close()


def test_an_address_without_a_port_is_refused():
    with pytest.raises(ValueError, match="expected host:port"):
        TemplateOptions(address="vibrometer")
