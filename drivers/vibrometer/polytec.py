"""Polytec's serial language: commands to bytes, replies to values. No I/O.

One rule: a command is one line of words with commas between, a reply one line of text.

    GetDevInfo,<device>,<index>,<item>      what there is to choose from, or an identity
    Get,<device>,<index>,<item>             the present value
    Set,<device>,<index>,<item>,<value>     change it; nothing, or an acknowledge, comes back

Lines are sent with CR LF and accepted with LF. A quantity is a number, a prefix and a unit: `5mm/s/V`,
`20 kHz`, `1.1 ms`. The micro sign comes in several encodings, or not at all where the line garbled it.

Source: RS-232 Interface Commands of the OFV-5000 user manual, as quoted by public programs that use it.
"""

import re
from dataclasses import dataclass

from drivers.errors import Garbled, Refused

LONGEST_LINE = 1024
"""Bytes; a longer one is noise."""
NOT_AVAILABLE = "Not Available"
"""The reply where an option is not installed or an item does not exist."""

_VERBS = ("GetDevInfo", "Get", "Set")
_PREFIXES = {
    "": 1.0,
    "n": 1e-9,
    "u": 1e-6,
    "µ": 1e-6,
    "μ": 1e-6,
    "\ufffd": 1e-6,
    "m": 1e-3,
    "k": 1e3,
    "M": 1e6,
}
_SWITCH = {"on": True, "1": True, "off": False, "0": False}
_REFUSALS = ("error", "not available", "not installed", "invalid", "unknown")


@dataclass(frozen=True)
class PolytecCommand:
    """One line to the device."""

    verb: str
    """`GetDevInfo`, `Get` or `Set`."""
    device: str
    index: int
    item: str
    value: str | None = None
    """Of a `Set` only."""

    def __str__(self) -> str:
        words = [self.verb, self.device, str(self.index), self.item]
        return ",".join(words if self.value is None else [*words, self.value])


def info(device: str, index: int, item: str) -> PolytecCommand:
    """Ask for an identity or for what there is to choose from."""
    return PolytecCommand("GetDevInfo", device, index, item)


def get(device: str, index: int, item: str) -> PolytecCommand:
    """Ask for the present value."""
    return PolytecCommand("Get", device, index, item)


def put(device: str, index: int, item: str, value: str) -> PolytecCommand:
    """Change a value."""
    return PolytecCommand("Set", device, index, item, value)


def encode(command: PolytecCommand) -> bytes:
    """A command as the line that is sent."""
    return f"{command}\r\n".encode("ascii")


def decode(line: bytes) -> str:
    """The text of a received line, without its end; bytes that are no text become U+FFFD."""
    return line.decode("utf-8", errors="replace").strip()


def parse_command(text: str) -> PolytecCommand:
    """A line as the device reads it: case and blanks do not matter. Raises `Garbled`."""
    words = [word.strip() for word in text.split(",", maxsplit=4)]
    verb = next((v for v in _VERBS if words[0].lower() == v.lower()), None)
    wanted = 5 if verb == "Set" else 4
    if verb is None or len(words) != wanted or not words[2].isdecimal():
        raise Garbled(f"{text!r}: expected GetDevInfo, Get or Set, a device, an index, an item")
    return PolytecCommand(verb, words[1], int(words[2]), words[3], words[4] if verb == "Set" else None)


def parse_text(reply: str) -> str:
    """A name. Raises `Garbled` on what is no printable text."""
    if not reply or not reply.isprintable() or "\ufffd" in reply:
        raise Garbled(f"{reply!r}: expected a name")
    return reply


def parse_optional_text(reply: str) -> str | None:
    """A name, or None where the device has no such thing."""
    return None if is_missing(reply) else parse_text(reply)


def parse_quantity(reply: str, unit: str) -> float:
    """A number in the unit's base: `5mm/s/V` with unit `m/s/V` is 0.005. Raises `Garbled`."""
    found = re.fullmatch(r"([-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)\s*(.*?)(?:\s*LP)?", reply.strip())
    if found and found[2].endswith(unit):
        factor = _PREFIXES.get(found[2].removesuffix(unit))
        if factor is not None:
            return float(found[1]) * factor
    raise Garbled(f"{reply!r}: expected a number in {unit}")


def parse_optional_quantity(reply: str, unit: str) -> float | None:
    """A number as `parse_quantity` reads it, or None where the device states none."""
    return None if is_missing(reply) else parse_quantity(reply, unit)


def parse_integer(reply: str) -> int:
    """A whole number, such as the signal level. Raises `Garbled`."""
    if not re.fullmatch(r"[-+]?\d{1,9}", reply.strip()):
        raise Garbled(f"{reply!r}: expected a whole number")
    return int(reply)


def parse_switch(reply: str) -> bool:
    """`On`, `Off`, `1` or `0`. Raises `Garbled`."""
    try:
        return _SWITCH[reply.strip().lower()]
    except KeyError:
        raise Garbled(f"{reply!r}: expected On, Off, 1 or 0") from None


def check_acknowledge(reply: str) -> None:
    """Raises `Refused` where the device says no. Its yes is not trusted: what was set is read back."""
    if reply.strip().lower().startswith(_REFUSALS):
        raise Refused(f"the device answers {reply.strip()!r}")


def is_missing(reply: str) -> bool:
    """Whether the device says that there is no such thing."""
    return reply.strip().lower() == NOT_AVAILABLE.lower()


def is_same_name(a: str, b: str) -> bool:
    """Whether two spellings name one range: manuals and firmwares differ in blanks and case."""
    return "".join(a.split()).lower() == "".join(b.split()).lower()
