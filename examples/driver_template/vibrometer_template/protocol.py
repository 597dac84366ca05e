"""The device's language: requests to bytes, replies to values. No I/O.

    ID?             VIBRO 1,serial 42
    RANGE?          2
    RANGE 1         OK
    LEVEL?          87                  percent of a full bar
    anything else   ERR <words>

ASCII, a line each, LF at the end.

Source: name the manual, its edition and the page here.
"""

from drivers.errors import Garbled, Refused
from drivers.vibrometer.interface import Range

LONGEST_LINE = 256
"""Bytes; a longer one is noise."""

RANGES = (
    Range("20mm/s/V", 20e-3, 10.0, 20e3, None, verified=False),
    Range("100mm/s/V", 100e-3, 10.0, 100e3, None, verified=False),
    Range("500mm/s/V", 500e-3, 10.0, 500e3, None, verified=False),
)
"""From the most sensitive to the coarsest: 0, 1, 2 to the device. `verified` once a manual says so."""


def encode(request: str) -> bytes:
    """The line as sent."""
    return f"{request}\n".encode("ascii")


def decode(line: bytes) -> str:
    """The text of a line. Raises `Garbled` for what is none, `Refused` where the device says no."""
    try:
        text = line.decode("ascii").strip()
    except UnicodeDecodeError:
        raise Garbled(f"{line!r}: expected ASCII") from None
    if text.startswith("ERR"):
        raise Refused(f"the device answers {text!r}")
    return text


def parse_identity(text: str) -> str:
    """Name and serial number. Raises `Garbled`."""
    if not text.startswith("VIBRO"):
        raise Garbled(f"{text!r}: expected a name that begins with VIBRO")
    return text


def parse_range(text: str) -> Range:
    """The range of a number. Raises `Garbled`."""
    if not text.isdecimal() or int(text) >= len(RANGES):
        raise Garbled(f"{text!r}: expected the number of a range, 0 to {len(RANGES) - 1}")
    return RANGES[int(text)]


def number_of(name: str) -> int:
    """What the device calls a range. Raises `Refused`, naming those there are."""
    for number, one in enumerate(RANGES):
        if one.name == name:
            return number
    raise Refused(f"no range {name!r}: there are {', '.join(r.name for r in RANGES)}")


def parse_level(text: str) -> float:
    """Light that comes back, 0 to 1. Raises `Garbled`."""
    if not text.isdecimal() or int(text) > 100:
        raise Garbled(f"{text!r}: expected a percentage, 0 to 100")
    return int(text) / 100


def check_done(text: str) -> None:
    """Raises `Garbled` where a setting is not acknowledged."""
    if text != "OK":
        raise Garbled(f"{text!r}: expected OK")
