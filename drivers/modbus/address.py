"""Where a device on Modbus TCP answers."""


def host_and_port(address: str) -> tuple[str, int]:
    """Host and port of an address "host:port". Raises `ValueError`."""
    host, _, port = address.rpartition(":")
    if not host or not port.isdecimal() or not 0 < int(port) < 65536:
        raise ValueError(f"address: {address!r}, expected host:port")
    return host, int(port)
