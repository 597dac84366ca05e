"""Where a device on Modbus TCP answers."""

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
