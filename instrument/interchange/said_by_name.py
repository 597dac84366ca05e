"""What the name of a column or an array says: unit, part of a phasor, the base's or not, an axis or not.

`velocity_mm_s`, `Velocity real [mm/s]`, `base_accel_m_s2`, `FRF (g/N)`, `Velocity [m/s rms]`.
"""

import re
from collections.abc import Iterable
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from instrument.errors import BadInput
from instrument.files.units import KNOWN, Unit, unit_of

Part = Literal["whole", "re", "im", "magnitude", "phase"]

BASE = {"base", "reference", "ref", "clamp", "excitation", "shaker", "input"}
"""Words of a motion of the base."""
_PARTS: dict[str, Part] = {
    **dict.fromkeys(("re", "real"), "re"),
    **dict.fromkeys(("im", "imag", "imaginary"), "im"),
    **dict.fromkeys(("mag", "magnitude", "amp", "amplitude", "abs", "modulus"), "magnitude"),
    **dict.fromkeys(("phase", "phi", "arg", "angle"), "phase"),
}
_MEASURED = {"velocity", "vel", "acceleration", "accel", "acc", "displacement", "disp", "force", "frf"}
"""Words of what is wanted: without its unit it is not passed over in silence."""
_RATIOS = {"frf", "tf", "transfer", "ratio", "h", "h1", "h2", "hv"}
"""Words of one signal over another: velocity over acceleration is in seconds, as times are."""
_STEMS = {"accelerance": "(m/s^2)/N", "inertance": "(m/s^2)/N", "mobility": "(m/s)/N", "receptance": "m/N"}
_SUFFIXES = (
    ("_mm_s2", "mm/s^2"),
    ("_m_s2", "m/s^2"),
    ("_mm_s", "mm/s"),
    ("_m_s", "m/s"),
    ("_mm", "mm"),
    ("_kn", "kN"),
    ("_m", "m"),
    ("_n", "N"),
    ("_g", "g"),
)
"""Units at the end of a name, longest first."""
_PEAKS = (
    (r"rms|eff", np.sqrt(2.0)),
    (r"pp|p2p|pkpk|(?:p|pk|peak) (?:to )?(?:p|pk|peak)", 0.5),
    (r"pk|peak|0 p", 1.0),
)
"""How a sine's size is stated, and what makes its amplitude of it."""
_ANGLES = {"deg": np.pi / 180, "degree": np.pi / 180, "degrees": np.pi / 180, "°": np.pi / 180, "rad": 1.0}
_TURN_RAD = 2 * np.pi
_LAST_GROUP = re.compile(r"\(((?:[^()]|\([^()]*\))*)\)\s*$")


def bracketed(name: str) -> tuple[str, list[str]]:
    """The unit in brackets at a name's end, and the words before it."""
    plain = name.strip()
    match = re.search(r"\[([^\]]*)\]\s*$", plain) or _LAST_GROUP.search(plain)
    if match and match[0].startswith("(") and plain[: match.start()].rstrip().endswith("/"):
        # (m/s)/(m/s^2): the first of the two groups is part of the unit.
        match = re.search(r"(\(.*)$", plain)
    before = plain[: match.start()] if match else plain
    return (match[1] if match else ""), [w for w in re.split(r"[^a-z0-9]+", before.lower()) if w]


def unit_in(name: str) -> Unit | None:
    """What it is in; None where the name does not say, or nothing known."""
    unit, words = bracketed(name)
    if unit.strip() == "s" and not _RATIOS & set(words):
        return None
    if unit:
        return unit_of(_without_size(unit))
    stem = next((_STEMS[w] for w in words if w in _STEMS), None)
    if stem is not None:
        return unit_of(stem)
    over, per, under = name.strip().lower().rpartition("_per")
    if per:
        units = [next((u for suffix, u in _SUFFIXES if end.endswith(suffix)), "") for end in (over, under)]
        return unit_of("({})/({})".format(*units))
    return next((unit_of(u) for suffix, u in _SUFFIXES if under.endswith(suffix)), None)


def part_in(name: str) -> Part:
    """Which part of a phasor, or all of it."""
    _, words = bracketed(name)
    return next((_PARTS[w] for w in words if w in _PARTS), "whole")


def stem_of(name: str) -> tuple[str, ...]:
    """What the parts of one quantity have in common."""
    bracket, words = bracketed(name)
    lower = name.strip().lower()
    if not bracket:
        tail = next((suffix for suffix, _ in _SUFFIXES if lower.endswith(suffix)), "")
        words = [w for w in re.split(r"[^a-z0-9]+", lower.removesuffix(tail)) if w]
    return tuple(w for w in words if w not in _PARTS and w not in ("deg", "rad"))


def amplitude_factor(name: str) -> float:
    """Of a sine's size as stated to its amplitude: the square root of 2 for rms, a half for peak to peak."""
    said = " " + re.sub(r"[^a-z0-9]+", " ", name.lower()) + " "
    return float(next((factor for words, factor in _PEAKS if re.search(rf" (?:{words}) ", said)), 1.0))


def _without_size(unit: str) -> str:
    """A unit without how the size is stated: `m/s rms`."""
    first, _, rest = unit.strip().partition(" ")
    return first if any(re.fullmatch(words, rest.lower()) for words, _ in _PEAKS) else unit


def radians(source: str, name: str, values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Phases in rad; without a unit they are in degrees. Shape as given.

    Raises `BadInput` where that is in doubt.
    """
    unit, words = bracketed(name)
    said = unit.strip().lower() or next((w for w in words if w in _ANGLES), "")
    if said and said not in _ANGLES:
        raise BadInput(f"{source}: {name}: in {unit!r}, expected deg or rad")
    if not said and np.any(values) and np.max(np.abs(values)) <= _TURN_RAD:
        raise BadInput(
            f"{source}: {name}: no more than {np.max(np.abs(values)):.3g} in size, are these rad? "
            "expected deg or rad in its name"
        )
    return np.asarray(values * _ANGLES[said or "deg"])


def axis_of(
    source: str, names: Iterable[str], words: tuple[str, ...], units: dict[str, float], *, needed: bool = True
) -> tuple[str, float] | None:
    """The axis among some names and its factor, by its first word and unit; None where there is none.

    Raises `BadInput` where one is `needed` and the only one is in another unit.
    """
    found: list[tuple[int, str, float]] = []
    unknown, plain = "", {unit.lower(): factor for unit, factor in units.items()}
    for name in names:
        bracket, said = bracketed(name)
        if not said or said[0] not in words:
            continue
        unit = bracket.strip().lower() if bracket or len(said) == 1 else _last_unit(said[1:], plain)
        if unit in plain:
            found.append((len(said), name, plain[unit]))
        else:
            unknown = unknown or name
    if not found and unknown and needed:
        known = ", ".join(unit for unit in units if unit)
        raise BadInput(f"{source}: {unknown}: in which unit? expected one of {known} in its name")
    return min(found, key=lambda one: one[0])[1:] if found else None


def _last_unit(words: list[str], units: dict[str, float]) -> str:
    """The unit that the last words of a name are; "?" for none."""
    return next((u for u in ("/".join(words[-2:]), words[-1]) if u in units), "?")


def refuse_unknown(source: str, name: str, unit: Unit | None) -> None:
    """Raise `BadInput` for what decides a law, in no known unit, or for a ratio in that of one signal."""
    said, words = bracketed(name)
    if unit is not None:
        if _RATIOS & set(words):
            raise BadInput(f"{source}: {name}: a ratio in one unit, expected one over another")
        return
    decides = bool(_MEASURED & {word.rstrip("0123456789") for word in words})
    part = part_in(name) in ("re", "im", "magnitude") or bool(BASE & set(words))
    if said and decides:
        raise BadInput(f"{source}: {name}: in {said!r}, expected one of {KNOWN}, or one over another")
    if not said and decides and part:
        raise BadInput(f"{source}: {name}: no unit, expected one in its name: {KNOWN}, or one over another")
