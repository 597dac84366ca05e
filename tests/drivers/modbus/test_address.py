import pytest

from drivers.modbus.address import host_and_port


def test_the_port_stands_behind_the_last_colon():
    assert host_and_port("rig.lab:502") == ("rig.lab", 502)
    assert host_and_port("::1:1502") == ("::1", 1502)


@pytest.mark.parametrize(
    "address", ["rig.lab", ":502", "rig.lab:", "rig.lab:0", "rig.lab:65536", "rig.lab:-1"]
)
def test_an_address_without_host_or_port_is_refused(address):
    with pytest.raises(ValueError, match="expected host:port"):
        host_and_port(address)
