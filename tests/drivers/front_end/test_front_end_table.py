"""`[front_end]` of RIG.toml: what it refuses, and how a device is looked at."""

import pytest
from pydantic import ValidationError

from drivers.errors import TimedOut
from drivers.front_end.driver import FrontEndDriver, FrontEndOptions
from drivers.front_end.interface import InputChannel
from drivers.front_end.lan_xi_driver import LanXiDriver, LanXiOptions
from drivers.simulated.lan_xi_server import LanXiServer


class Device:
    def __init__(self, answer):
        self.answer, self.closed = answer, False

    def identity(self):
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer

    def close(self):
        self.closed = True


class Driver(FrontEndDriver[FrontEndOptions]):
    def __init__(self, device):
        self.device = device

    def open(self, options):
        return self.device


OPTIONS = FrontEndOptions(address="anywhere")


def test_a_device_that_was_looked_at_is_let_go_of():
    driver = Driver(Device("a front-end"))
    assert driver.look(OPTIONS) == "a front-end"
    assert driver.device.closed


def test_so_is_one_that_did_not_answer():
    driver = Driver(Device(TimedOut("no answer")))
    with pytest.raises(TimedOut):
        driver.look(OPTIONS)
    assert driver.device.closed


def test_a_driver_that_does_not_know_before_it_samples_objects_to_nothing():
    assert Driver(Device("a front-end")).objection(OPTIONS, (InputChannel(99, "base"),)) == ""


@pytest.mark.parametrize("rate_hz", [99.0, 1.1e6])
def test_a_rate_that_no_front_end_samples_at_is_refused(rate_hz):
    with pytest.raises(ValidationError, match="sample_rate_hz"):
        FrontEndOptions(address="anywhere", sample_rate_hz=rate_hz)


def test_a_lan_xi_module_is_looked_at_while_another_program_has_it():
    with LanXiServer(None, channels=2, sample_rates=(8192,), pace="asked") as server:
        options, driver = LanXiOptions(address=server.url, paced_by_reader=True), LanXiDriver()
        taken = driver.open(options)
        assert driver.look(options) == taken.identity() == "LAN-XI SIM-LAN-XI, serial number 000001"
        assert driver.objection(options, (InputChannel(1, "base"),)) == ""
        assert "inputs 1 to 2" in driver.objection(options, (InputChannel(3, "base"),))
        taken.close()
