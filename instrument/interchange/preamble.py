"""What a program writes above its table: units that names leave out, the layout where there are no names."""

import re
from collections.abc import Sequence

from instrument.files.table import Rows
from instrument.files.units import unit_of
from instrument.interchange.unit_in_name import bracketed

_STATED = r"{}[-_ ]*(?:axis)?[-_ ]*units?"
_X = re.compile(_STATED.format("(?:x|abscissa|frequency)"), re.I)
_Y = re.compile(_STATED.format("(?:y|ordinate|amplitude)"), re.I)
_BETWEEN = re.compile(r"[:=;,\t]")
_AXIS_UNITS = ("hz", "khz", "rad/s")
_AXIS_NAMES = ("", "x", "x axis", "linear", "abscissa", "hz", "freq", "frequency")
_PARTS = re.compile(r"re|real|im|imag|imaginary|mag|magnitude|amplitude|modulus", re.I)
_SHORT = 80


def with_stated_units(names: Sequence[str], preamble: Sequence[str]) -> tuple[list[str], list[str]]:
    """Names with the units that the lines above state, and what is to be said of it.

    Names that have units keep them. An axis that is only `X` or `Linear`, in Hz, is called a frequency.
    """
    x, y = _stated(_X, preamble), _stated(_Y, preamble)
    made: list[str] = []
    said: list[str] = []
    for k, name in enumerate(names):
        unit, words = bracketed(name)
        if not unit and name.lower().endswith(" hz"):
            unit, words = "Hz", words[:-1]
        unit = unit.strip() or x
        if k == 0 and unit.lower() in _AXIS_UNITS and " ".join(words) in _AXIS_NAMES:
            made.append(f"Frequency [{unit}]")
        elif y and _PARTS.fullmatch(name.strip()) and unit_of(y) is not None:
            made.append(f"{name.strip()} [{y}]")
            said = [f"in {y[:_SHORT]} as stated above the table"]
        else:
            made.append(name)
    return made, said


def named_by_preamble(preamble: Sequence[str], rows: Rows) -> list[str] | None:
    """Names of a table that has none where its head says the layout: PULSE's, with its number of lines.

    Its rows are number, frequency, and one value or two.
    """
    said = {
        key.strip().lower(): value.strip() for key, _, value in (line.partition(":") for line in preamble)
    }
    if "header size" not in said or "amplitudeunit" not in said or said.get("x-axis size") != str(len(rows)):
        return None
    unit, axis = said["amplitudeunit"], said.get("x-axis unit", "")
    complex_ = "complex" in said.get("data type", "").lower()
    counted = [row[0] for _, row in rows] == [str(n) for n in range(1, len(rows) + 1)]
    if not counted or len(rows[0][1]) != (4 if complex_ else 3):
        return None
    parts = [f"Real [{unit}]", f"Imag [{unit}]"] if complex_ else [f"Magnitude [{unit}]"]
    return ["", f"Frequency [{axis}]", *parts]


def _stated(pattern: re.Pattern[str], preamble: Sequence[str]) -> str:
    """The unit that the lines state; empty where none does, or several differ."""
    pairs = [_BETWEEN.split(line.replace('"', ""), maxsplit=1) for line in preamble]
    found = {pair[1].strip(" \t;,") for pair in pairs if len(pair) > 1 and pattern.fullmatch(pair[0].strip())}
    return found.pop() if len(found) == 1 else ""
