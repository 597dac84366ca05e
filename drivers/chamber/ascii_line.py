"""A thermometer's line of text: one number, in degrees Celsius. No I/O."""

import re

from drivers.chamber.registers import refuse_senseless
from drivers.errors import Garbled

LONGEST_LINE = 120
_NUMBER = re.compile(r"(?<![\w.])[+-]?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?(?![\d.])")
_OTHER_UNIT = re.compile(r"\s*°?(?:deg)?\s*[FK]\b")


def decode(line: bytes) -> float:
    """Degrees Celsius.

    A digit within a word ("T1") is no number. Raises `Garbled` for a line without a number, with several, in
    another unit, or with what cannot be a temperature.
    """
    text = line.decode("latin-1").strip()
    came = repr(text[:40])
    found = list(_NUMBER.finditer(text))
    if len(found) != 1:
        raise Garbled(f"{came}: a line with one number expected, {len(found)} found")
    if _OTHER_UNIT.match(text, found[0].end()):
        raise Garbled(f"{came}: degrees Celsius expected: switch the thermometer over")
    return refuse_senseless(float(found[0][0]), came)
