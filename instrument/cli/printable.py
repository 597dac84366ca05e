"""Text of files and instruments, safe for a terminal."""

import re

_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069]")


def printable(text: str) -> str:
    """Control, escape and direction characters as their codes: nobody's file steers the reader's terminal."""
    return _CONTROL.sub(lambda m: f"\\x{ord(m[0]):02x}", text)
