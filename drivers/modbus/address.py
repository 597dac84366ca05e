"""Where a device on Modbus TCP, or on a serial line, answers."""

from contextlib import suppress
from ipaddress import ip_address

_HIGHEST_PORT = 65535
"""Of TCP."""


def host_and_port(address: str) -> tuple[str, int]:
    """Host and port of an address "host:port". Raises `ValueError`."""
    host, _, port = address.rpartition(":")
    if not host or not port.isdecimal():
        raise ValueError(f"address: {address!r}, expected host:port")
    if not 0 < int(port) <= _HIGHEST_PORT:
        raise ValueError(f"address: {address!r}, expected a port of 1 to {_HIGHEST_PORT}")
    return host, int(port)


def serial_port(address: str) -> str:
    """The address, where it may be a serial port's. Raises `ValueError`."""
    if not address.strip():
        raise ValueError("address: empty, expected a serial port: /dev/ttyUSB0, COM3")
    if _is_of_network(address):
        raise ValueError(f'address: {address!r} is one of kind = "modbus-tcp", expected a serial port')
    return address


def _is_of_network(address: str) -> bool:
    with suppress(ValueError):
        ip_address(address)
        return True
    # Links by path have colons too; "socket://host:port" is a port of pyserial's.
    with suppress(ValueError):
        host, _ = host_and_port(address)
        return "/" not in host
    return False
