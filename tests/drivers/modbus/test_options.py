"""Where a device on Modbus TCP or a serial line answers, as its table says it."""

import pytest
from pydantic import ValidationError

from drivers.modbus.options import ModbusSerialLine, ModbusTcpAddress


@pytest.mark.parametrize("address", ["192.168.0.7:502", "simulated", "-"])
def test_host_and_port_are_taken_and_what_is_no_device_s_own_is_not_judged(address):
    assert ModbusTcpAddress(kind="modbus-tcp", address=address).address == address


def test_an_address_without_a_port_is_refused():
    with pytest.raises(ValidationError, match=r"address: '192\.168\.0\.7', expected host:port"):
        ModbusTcpAddress(kind="modbus-tcp", address="192.168.0.7")


def serial_line(**keys):
    return ModbusSerialLine(**{"kind": "modbus-rtu", "address": "/dev/ttyUSB0", "baud": 9600} | keys)


def test_a_serial_line_has_the_parity_and_stop_bits_that_its_table_says():
    assert (serial_line().parity, serial_line().stop_bits) == ("N", 1)
    assert (serial_line(parity="E").parity, serial_line(stop_bits=2).stop_bits) == ("E", 2)
    with pytest.raises(ValidationError, match="parity"):
        serial_line(parity="even")


def test_a_serial_line_without_a_port_or_with_a_network_s_address_is_refused():
    with pytest.raises(ValidationError, match="address: empty, expected a serial port"):
        serial_line(address=" ")
    with pytest.raises(ValidationError, match='is one of kind = "modbus-tcp"'):
        serial_line(address="192.168.0.20:502")
    assert serial_line(address="simulated").address == "simulated"
