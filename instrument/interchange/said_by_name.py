"""What is asked where the name of a column or an array does not say enough; axes and phases by name."""

import re
from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from instrument.errors import BadInput
from instrument.files.units import KNOWN, Quantity, Unit, unit_of
from instrument.interchange.unit_in_name import (
    ANGLES,
    EXPECTED_DB,
    RATIOS,
    STEMS,
    TRANSMISSIBILITY,
    UNWRAPPED,
    bracketed,
    in_db,
    part_in,
)
from instrument.interchange.words import plain, words_of

BASE = {"base", "reference", "ref", "clamp", "excitation", "shaker", "input"}
"""Words of a motion of the base."""
_QUANTITIES: dict[str, Quantity] = {
    **dict.fromkeys(("velocity", "vel"), "velocity"),
    **dict.fromkeys(("acceleration", "accel", "acc"), "acceleration"),
    **dict.fromkeys(("displacement", "disp"), "displacement"),
    "force": "force",
}
_OTHER_THAN = {"relative", "relativ", "rel", "against", "gegenuber", "gegenueber", "minus"}
"""Words before what a motion is told from: it is no motion of that."""
_CHANNEL = "input"
"""With a number it is one of a front-end's."""
_MEASURED = {*_QUANTITIES, "frf"}
"""Words of what is wanted: without its unit it is not passed over in silence."""
_OF_BASE = {"base", "clamp", "reference", "ref"}
"""Of a measured base: left out, its commanded level would stand in its place."""
ANGULAR = ("omega", "angular", "circular")
"""First words of an axis of 2 pi times the frequencies."""
ANGULAR_HZ = dict.fromkeys(("rad/s", "1/s", ""), 1 / (2 * np.pi))
"""Its units."""
_MOST_RAD = 8 * np.pi
"""Phases in rad, unwrapped over four turns: a resonance alone takes phases in degrees beyond that."""
_MOST_SAID_RAD = 2 * _MOST_RAD
"""The same where rad are said: 50 degrees, which a resonance takes too."""
_DENSITIES = frozenset(
    ("psd", "asd", "lsd", "csd", "esd", "density", "power", "autopower", "crosspower", "autospectrum", "gxx")
)
"""Words of what is a power, or of a bandwidth that a sine does not have."""


_OVER = re.compile(r"^[^\[(]*?(\w+)\s*(?:/|\bover\b)\s*[a-zA-Z]")
"""One signal over another, before a unit in brackets."""


class NotSaid(BadInput):
    """A name does not say enough, or nothing that is known."""


def is_of_base(words: Sequence[str]) -> bool:
    """Whether a name's words are of a motion of the base; `relative to clamp` and `Input 1` are not."""
    if not _OTHER_THAN.isdisjoint(words):
        return False
    return any(
        word in BASE and not (word == _CHANNEL and following.isdigit())
        for word, following in pairwise([*words, ""])
    )


def radians(source: str, name: str, values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Phases in rad; without a unit they are in degrees. Shape as given.

    Raises `NotSaid` where that is in doubt.
    """
    unit, words = bracketed(name)
    pieces = [piece for piece in re.split(r"[,;\s]+", plain(unit)) if piece]
    if UNWRAPPED in pieces:
        words, pieces = [*words, UNWRAPPED], [piece for piece in pieces if piece != UNWRAPPED]
    said = " ".join(pieces) or next((w for w in words if w in ANGLES), "")
    if unit.strip() == "grad":
        raise NotSaid(f"{source}: {name}: degrees or gradians? expected deg or rad")
    if said and said not in ANGLES:
        raise NotSaid(f"{source}: {name}: in {unit!r}, expected deg or rad")
    if not said and np.any(values) and _most(values) <= _MOST_RAD:
        raise NotSaid(
            f"{source}: {name}: no more than {_most(values):.3g} in size, are these rad? "
            "expected deg or rad in its name"
        )
    if said == "rad" and UNWRAPPED not in words and _most(values) > _MOST_SAID_RAD:
        raise NotSaid(
            f"{source}: {name}: up to {_most(values):.4g}, are these degrees? expected 'unwrapped' in its "
            "name where they are not"
        )
    return np.asarray(values * ANGLES[said or "deg"])


def _most(values: Array) -> float:
    """The largest size; 0 of none."""
    return float(np.nanmax(np.abs(values), initial=0.0))


def axis_of(
    source: str, names: Iterable[str], words: tuple[str, ...], units: dict[str, float], *, needed: bool = True
) -> list[tuple[str, float]]:
    """Axes among some names and their factors, by first word and unit: those of the fewest words, or none.

    Raises `NotSaid` where one is `needed` and the only one is in another unit.
    """
    found: list[tuple[int, str, float]] = []
    unknown, plain = "", {unit.lower(): factor for unit, factor in units.items()}
    for name in names:
        bracket, said = bracketed(name)
        if not said or said[0] not in words:
            continue
        # Of an angular frequency, and of a circular one.
        rest = [word for word in said[1:] if word != "frequency"]
        unit = bracket.strip().lower() if bracket or not rest else _last_unit(rest, plain)
        if unit in plain:
            found.append((len(said), name, plain[unit]))
        else:
            unknown = unknown or name
    if not found and unknown and needed:
        known = ", ".join(unit for unit in units if unit)
        raise NotSaid(f"{source}: {unknown}: in which unit? expected one of {known} in its name")
    fewest = min((count for count, *_ in found), default=0)
    return [(name, factor) for count, name, factor in found if count == fewest]


def _last_unit(words: list[str], units: dict[str, float]) -> str:
    """The unit that the last words of a name are; "?" for none."""
    return next((u for u in ("/".join(words[-2:]), words[-1]) if u in units), "?")


def refuse_contradiction(source: str, name: str, unit: Unit) -> None:
    """Raise `NotSaid` where a name's words and its unit are of different quantities, or a power is meant."""
    _, words = bracketed(name)
    density = _DENSITIES & set(words)
    if density:
        raise NotSaid(
            f"{source}: {name}: {min(density)!r} is a power or a density, expected a sine's amplitude, "
            "or a ratio"
        )
    stems = [u for word in words if word in STEMS and (u := unit_of(STEMS[word])) is not None]
    said = {_QUANTITIES[w] for word in words if (w := word.rstrip("0123456789")) in _QUANTITIES}
    is_other = unit.per is None and bool(said) and unit.quantity not in said
    ratio = _OVER.match(name)
    if unit.per is not None and ratio is not None and is_of_base(words_of(ratio[1])):
        raise NotSaid(f"{source}: {name}: of the base over the response? expected the response over the base")
    if TRANSMISSIBILITY in words and unit.quantity == unit.per:
        return
    if is_other or any((u.quantity, u.per) != (unit.quantity, unit.per) for u in stems):
        over = f" over {unit.per}" if unit.per else ""
        raise NotSaid(f"{source}: {name}: its unit is of {unit.quantity}{over}: which is it?")


def refuse_unknown(source: str, name: str, unit: Unit | None) -> None:
    """Raise `NotSaid` for what decides a law, in no known unit, or for a ratio in that of one signal."""
    said, words = bracketed(name)
    if unit is not None:
        if RATIOS & set(words):
            raise NotSaid(f"{source}: {name}: a ratio in one unit, expected one over another")
        return
    decides = bool((_MEASURED | STEMS.keys()) & {word.rstrip("0123456789") for word in words})
    is_part = part_in(name) in ("re", "im", "magnitude")
    part = is_part or is_of_base(words)
    base = bool(_OF_BASE & set(words)) and (is_part or (bool(said) and set(words) <= BASE))
    if in_db(name) is not None and (decides or part or STEMS.keys() & set(words)):
        raise NotSaid(f"{source}: {name}: dB of what? {EXPECTED_DB}")
    if said and (decides or base):
        raise NotSaid(f"{source}: {name}: in {said!r}, expected one of {KNOWN}, or one over another")
    if not said and ((decides and part) or base or STEMS.keys() & set(words)):
        raise NotSaid(f"{source}: {name}: no unit, expected one in its name: {KNOWN}, or one over another")
