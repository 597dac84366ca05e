import pytest

from drivers.modbus.address import host_and_port


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
