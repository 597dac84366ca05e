"""What is no address of a module is refused where it is written, before anything is asked for."""

import pytest
from pydantic import ValidationError

from drivers.front_end.lan_xi_address import host_of
from drivers.front_end.lan_xi_driver import LanXiOptions


@pytest.mark.parametrize(
    ("url", "host"),
    [
        ("http://10.0.0.5", "10.0.0.5"),
        ("http://127.0.0.1:8080/", "127.0.0.1"),
        ("http://[fe80::1]", "fe80::1"),
    ],
)
def test_host_with_or_without_port(url, host):
    assert host_of(url) == host
    assert LanXiOptions(address=url).address == url


@pytest.mark.parametrize(
    "url",
    [
        "10.255.255.1",
        "10.255.255.1:80",
        "https://10.0.0.5",
        "http://",
        "http://a:b",
        "http://a:0",
        "http://[a",
        "",
    ],
)
def test_what_is_no_url_of_a_module_is_refused(url):
    with pytest.raises(ValueError, match=r"expected http://<host>"):
        host_of(url)
    with pytest.raises(ValidationError, match=r"address: .*expected http"):
        LanXiOptions(address=url)


@pytest.mark.parametrize("address", ["simulated", "-"])
def test_a_simulated_one_has_none(address):
    assert LanXiOptions(address=address).address == address
