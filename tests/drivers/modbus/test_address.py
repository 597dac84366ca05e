import pytest

from drivers.modbus.address import host_and_port, serial_port


def test_the_port_stands_behind_the_last_colon():
    assert host_and_port("rig.lab:502") == ("rig.lab", 502)
    assert host_and_port("::1:1502") == ("::1", 1502)


@pytest.mark.parametrize("address", ["rig.lab", ":502", "rig.lab:", "rig.lab:-1", "rig.lab:http"])
def test_an_address_without_host_or_port_is_refused(address):
    with pytest.raises(ValueError, match="expected host:port"):
        host_and_port(address)


@pytest.mark.parametrize("port", ["0", "65536", "99999"])
def test_a_port_that_no_device_has_is_told_from_a_missing_one(port):
    with pytest.raises(ValueError, match=f"'127.0.0.1:{port}', expected a port of 1 to 65535"):
        host_and_port(f"127.0.0.1:{port}")


@pytest.mark.parametrize(
    "address", ["COM3", "/dev/serial/by-path/pci-0000:00:14.0-usb-0:1:502", "socket://rig.lab:4001"]
)
def test_a_serial_port_may_have_colons_in_its_name(address):
    assert serial_port(address) == address


@pytest.mark.parametrize("address", ["192.168.0.20", "192.168.0.20:502", "rig.lab:502", "::1"])
def test_a_network_s_address_is_no_serial_port(address):
    with pytest.raises(ValueError, match="expected a serial port"):
        serial_port(address)
