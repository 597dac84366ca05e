"""Where a device on Modbus TCP answers, as its table says it."""

import pytest
from pydantic import ValidationError

from drivers.modbus.options import ModbusTcpAddress


@pytest.mark.parametrize("address", ["192.168.0.7:502", "simulated", "-"])
def test_host_and_port_are_taken_and_what_is_no_device_s_own_is_not_judged(address):
    assert ModbusTcpAddress(kind="modbus-tcp", address=address).address == address


def test_an_address_without_a_port_is_refused():
    with pytest.raises(ValidationError, match=r"address: '192\.168\.0\.7', expected host:port"):
        ModbusTcpAddress(kind="modbus-tcp", address="192.168.0.7")
