"""Where a LAN-XI module answers."""

from urllib.parse import urlsplit


def host_of(url: str) -> str:
    """Host of an address "http://host", with a port or without. Raises `ValueError`."""
    expected = f"address: {url!r}, expected http://<host>, as in 'http://192.168.1.10'"
    try:
        parts = urlsplit(url)
        host, port = parts.hostname, parts.port
    except ValueError:
        raise ValueError(expected) from None
    if parts.scheme != "http" or not host or port == 0 or any(c.isspace() for c in url):
        raise ValueError(expected)
    return host
