"""`[shaker]` of RIG.toml: what it refuses, and the device it opens."""

import pytest
from pydantic import ValidationError

from drivers.shaker.driver import ShakerDriver, ShakerOptions
from drivers.shaker.modbus import ModbusShaker
from drivers.shaker.modbus_driver import ModbusRtuDriver, ModbusRtuOptions, ModbusTcpDriver, ModbusTcpOptions
from drivers.shaker.register_map import DEFAULT


@pytest.mark.parametrize("timeout_s", [0.4, 11.0])
def test_a_heartbeat_too_short_to_keep_or_too_long_to_save_anything_is_refused(timeout_s):
    with pytest.raises(ValidationError, match="heartbeat_timeout_s"):
        ShakerOptions(address="anywhere", heartbeat_timeout_s=timeout_s)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"address": "nowhere"}, "nowhere"),
        ({"registers": {"no_such": 5}}, "no_such"),
        ({"registers": {"control": 70000}}, "65535"),
    ],
)
def test_an_address_that_cannot_be_meant_is_refused(change, said):
    with pytest.raises(ValidationError, match=said):
        ModbusTcpOptions.model_validate({"address": "127.0.0.1:502"} | change)


def test_the_stop_button_has_a_way_of_its_own_over_tcp_alone():
    assert ModbusTcpDriver.is_shared
    assert not ModbusRtuDriver.is_shared
    assert not ShakerDriver.is_shared


@pytest.mark.parametrize("moved", [{}, {"status": 900}], ids=["as documented", "moved"])
def test_a_shaker_is_opened_with_the_registers_of_its_table(make_rig, moved):
    rig = make_rig(DEFAULT.with_addresses(moved))
    with rig.server:
        options = ModbusTcpOptions(address="{}:{}".format(*rig.server.address), registers=moved)
        shaker = ModbusTcpDriver().open(options, timeout_s=0.5, retries=0)
        shaker.start()
        assert shaker.status().running
        shaker.close()


def test_a_shaker_on_a_serial_line_is_opened_with_its_parity_and_stop_bits(monkeypatch):
    opened = {}
    monkeypatch.setattr(ModbusShaker, "rtu", lambda port, **settings: opened.update(settings, port=port))
    ModbusRtuDriver().open(ModbusRtuOptions(address="/dev/ttyUSB0", baud=19200, parity="E", stop_bits=2))
    wanted = {"port": "/dev/ttyUSB0", "baud": 19200, "parity": "E", "stop_bits": 2}
    assert opened.items() >= wanted.items()
