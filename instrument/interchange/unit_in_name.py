"""Unit, part of a phasor and how its size is stated, as the name of a column or an array says them.

`velocity_mm_s`, `Velocity real [mm/s]`, `FRF (g/N)`, `Real (m/s)/g`, `Velocity [m/s rms]`.
"""

import re
from dataclasses import replace
from typing import Literal

import numpy as np

from fitting.arrays import Array
from instrument.files.units import Unit, unit_of
from instrument.interchange.words import plain, words_of

Part = Literal["whole", "re", "im", "magnitude", "phase"]

_PARTS: dict[str, Part] = {
    **dict.fromkeys(("re", "real"), "re"),
    **dict.fromkeys(("im", "imag", "imaginary"), "im"),
    **dict.fromkeys(("mag", "magnitude", "amp", "amplitude", "abs", "modulus"), "magnitude"),
    **dict.fromkeys(("phase", "phi", "arg", "angle"), "phase"),
}
RATIOS = {"frf", "tf", "transfer", "ratio", "h", "h1", "h2", "hv"}
"""Words of one signal over another: velocity over acceleration is in seconds, as times are."""
TRANSMISSIBILITY = "transmissibility"
"""The ratio that needs no unit."""
STEMS = {
    "accelerance": "(m/s^2)/N",
    "inertance": "(m/s^2)/N",
    "mobility": "(m/s)/N",
    "receptance": "m/N",
    TRANSMISSIBILITY: "(m/s^2)/(m/s^2)",
}
"""Ratios that a word says, in the unit it is defined by."""
_NO_UNIT = {"": 1.0, "-": 1.0, "1": 1.0, "%": 0.01}
"""Of a transmissibility."""
_LENGTHS = ("cm", "mm", "um", "nm", "in", "ft", "m")
_SUFFIXES = (
    *((f"_{length}_s2", f"{length}/s^2") for length in _LENGTHS),
    *((f"_{length}_s", f"{length}/s") for length in _LENGTHS),
    ("_mm", "mm"),
    ("_cm", "cm"),
    ("_um", "um"),
    ("_kn", "kN"),
    ("_m", "m"),
    ("_n", "N"),
    ("_g", "g"),
)
"""Units at the end of a name, longest first."""
_PEAK = "p|pk|peak|spitze|crete"
_PEAKS = (
    (r"rms|eff|root mean square|effektiv|effektivwert|efficace", np.sqrt(2.0)),
    (rf"pp|p2p|pkpk|(?:{_PEAK}) (?:to |zu |a )?(?:{_PEAK})", 0.5),
    (r"pk|peak|0 p|spitze|spitzenwert|scheitelwert|crete", 1.0),
)
"""How a sine's size is stated, and what makes its amplitude of it."""
_DEGREES = ("deg", "degree", "degrees", "°", "grad", "degre", "degres")
ANGLES = {**dict.fromkeys(_DEGREES, np.pi / 180), "rad": 1.0}
"""Units of phases, in rad."""
UNWRAPPED = "unwrapped"
"""Of a phase, or of its name."""
_SPELT = re.compile(r"\s(?:in|/)\s+(\S+)\s*$", re.I)
"""A unit behind its word: `Mobility in mm/s/N`."""
_ONE = r"\([^()]*\)|\[[^\[\]]*\]"
_OVER = re.compile(
    rf"(?:\s+in)?(?:^|\s)((?:{_ONE}|[^\s()\[\]]+)\s*/\s*(?:{_ONE}|[^\s()\[\]/]+))(?=\s|$)", re.I
)
"""A unit over another that stands by itself: `Real (m/s)/g`."""
_AMIDST = re.compile(r"[\[(]([^\[\]()]*)[\])]")
"""A unit that other words follow: `Accelerance (g/N) real`."""
_PIECES = frozenset(("m", "cm", "mm", "um", "nm", "in", "ft", "s", "s2", "g", "n", "kn", "lbf"))
"""Of a unit written with underscores: `mobility_mm_s_n`."""
_LAST_GROUP = re.compile(r"\(((?:[^()]|\([^()]*\))*)\)\s*$")
_DECIBELS = re.compile(r"dB\b\s*(?:re[lf]?\b[.:]?)?\s*([\d.]+(?:e[-+]?\d+)?)?\s*(.*)", re.I)
EXPECTED_DB = "expected as in '[dB re 1 (m/s)/N]'"
"""For people."""
_HALF_DECADE_DB = 20.0


def bracketed(name: str) -> tuple[str, list[str]]:
    """The unit in brackets at a name's end, and the words before it."""
    whole = name.strip()
    match = re.search(r"\[([^\]]*)\]\s*$", whole) or _LAST_GROUP.search(whole)
    if match and match[0].startswith("(") and whole[: match.start()].rstrip().endswith("/"):
        # (m/s)/(m/s^2): the first of the two groups is part of the unit.
        match = re.search(r"(\(.*)$", whole)
    spelt = _SPELT.search(whole)
    if match and match[0].startswith("["):
        spelt = None
    elif over := next((m for m in _OVER.finditer(whole) if unit_of(m[1]) is not None), None):
        return over[1], words_of(whole[: over.start()] + " " + whole[over.end() :])
    if spelt and (unit_of(spelt[1]) or spelt[1].lower() in (*ANGLES, "hz", "khz", "rad/s", "%")):
        match = spelt
    before = whole[: match.start()] if match else whole
    unit = match[1] if match else ""
    if match is None and (amidst := _AMIDST.search(whole)) is not None:
        said = _with_stroke(amidst[1])
        if unit_of(said) is not None:
            unit, before = said, whole[: amidst.start()] + " " + whole[amidst.end() :]
    return unit, words_of(before)


def _with_stroke(unit: str) -> str:
    """`g per N` as `g/N`."""
    return re.sub(r"\s+per\s+", "/", unit, flags=re.I)


def reference_of_db(name: str) -> float | None:
    """What 0 dB stand for in the unit of `unit_in`, where a name's unit is in dB; else None.

    `FRF [dB re 1 (m/s)/N]`, `Velocity [dB re 1e-9 m/s]`.
    """
    match = in_db(name)
    return None if match is None or _of_level(match, name) is None else float(match[1] or 1.0)


def in_db(name: str) -> re.Match[str] | None:
    """Where its unit is in dB, their reference and what it is of."""
    return _DECIBELS.fullmatch(bracketed(name)[0].strip())


def _of_level(match: re.Match[str], name: str) -> Unit | None:
    """What 0 dB are of; of a ratio of like quantities that need not be said."""
    is_plain = not match[2] and TRANSMISSIBILITY in bracketed(name)[1]
    return unit_of(STEMS[TRANSMISSIBILITY] if is_plain else match[2])


def of_decibels(values: Array, reference: float) -> Array:
    """Sizes of levels: 20 dB are a factor of ten. Shape as given."""
    return np.asarray(reference * 10 ** (values / _HALF_DECADE_DB))


def unit_in(name: str) -> Unit | None:
    """What it is in; None where the name does not say, or nothing known."""
    unit, words = bracketed(name)
    level = in_db(name)
    if level is not None:
        return _of_level(level, name)
    if unit.strip().lower() == "s" and not RATIOS & set(words):
        return None
    if _is_t(name, unit, words):
        return _transmissibility(unit)
    if TRANSMISSIBILITY in words and unit.strip() in _NO_UNIT:
        return _transmissibility(unit)
    if unit:
        return unit_of(_without_size(_with_stroke(unit)))
    stem = next((STEMS[w] for w in words if w in STEMS), None)
    if stem is not None:
        spelt = _pieces(words)
        return _of_pieces(spelt) if spelt else unit_of(stem)
    over, per, under = name.strip().lower().rpartition("_per")
    if per:
        units = [next((u for suffix, u in _SUFFIXES if end.endswith(suffix)), "") for end in (over, under)]
        return unit_of("({})/({})".format(*units))
    return next((unit_of(u) for suffix, u in _SUFFIXES if under.endswith(suffix)), None)


def _transmissibility(unit: str) -> Unit | None:
    """In parts or in percent."""
    like = unit_of(STEMS[TRANSMISSIBILITY])
    return like if like is None else replace(like, factor=_NO_UNIT[unit.strip()])


def _is_t(name: str, unit: str, words: list[str]) -> bool:
    """Whether it is a transmissibility by its letter alone: a part of it, or said to have no unit."""
    alone = [w for w in words if w not in _PARTS] == ["t"] and unit.strip() in _NO_UNIT
    return alone and (bool(unit) or part_in(name) in ("re", "im", "magnitude"))


def is_unit_said(name: str) -> bool:
    """Whether a ratio's name has a unit, or is in the one that its word is defined by."""
    unit, words = bracketed(name)
    return bool(unit) or bool(_pieces(words)) or TRANSMISSIBILITY in words or not STEMS.keys() & set(words)


def _pieces(words: list[str]) -> list[str]:
    """The words of a name that are a unit's, those of a part left out."""
    rest = [w for w in words if w not in _PARTS and w not in STEMS]
    while rest and rest[0] not in _PIECES:
        rest = rest[1:]
    return rest if all(w in _PIECES or w == "per" for w in rest) else []


def _of_pieces(pieces: list[str]) -> Unit | None:
    """`mm s n`, `g per n`: one over a force, the last of them; None for anything else."""
    *over, under = (w for w in pieces if w != "per")
    return unit_of(f"({'/'.join(over)})/{under}") or unit_of(f"({'/'.join(over)})/{under.upper()}")


def part_in(name: str) -> Part:
    """Which part of a phasor, or all of it."""
    _, words = bracketed(name)
    return next((_PARTS[w] for w in words if w in _PARTS), "whole")


def stem_of(name: str) -> tuple[str, ...]:
    """What the parts of one quantity have in common."""
    bracket, words = bracketed(name)
    lower = plain(name.strip())
    if not bracket:
        tail = next((suffix for suffix, _ in _SUFFIXES if lower.endswith(suffix)), "")
        words = words_of(lower.removesuffix(tail))
    return tuple(w for w in words if w not in _PARTS and w not in ("deg", "rad", UNWRAPPED))


def amplitude_factor(name: str) -> float:
    """Of a sine's size as stated to its amplitude: the square root of 2 for rms, a half for peak to peak."""
    stated = stated_factor(name)
    return 1.0 if stated is None else stated


def stated_factor(name: str) -> float | None:
    """A factor as for `amplitude_factor`, None where the name does not say how the size is stated."""
    said = f" {_letters(name)} "
    return next((float(factor) for words, factor in _PEAKS if re.search(rf" (?:{words}) ", said)), None)


def _without_size(unit: str) -> str:
    """A unit without how the size is stated: `m/s rms`."""
    first, _, rest = unit.strip().partition(" ")
    return first if any(re.fullmatch(words, _letters(rest)) for words, _ in _PEAKS) else unit


def _letters(text: str) -> str:
    """Small letters and digits, one space for whatever is between: `Pk-Pk` is pk pk."""
    return re.sub(r"[^a-z0-9]+", " ", plain(text)).strip()
