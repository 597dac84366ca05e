"""Units as other programs write them: what they measure, and their factor to SI."""

import re
from dataclasses import dataclass
from typing import Literal

from fitting.gravity import STANDARD_GRAVITY_M_S2

Quantity = Literal["displacement", "velocity", "acceleration", "force"]

DERIVATIVE: dict[Quantity, int] = {"displacement": 0, "velocity": 1, "acceleration": 2}
"""How often a motion is differentiated from displacement."""

_LENGTHS = {
    "m": 1.0,
    "cm": 1e-2,
    "mm": 1e-3,
    "um": 1e-6,
    "nm": 1e-9,
    "in": 0.0254,
    "mil": 2.54e-5,
    "ft": 0.3048,
}
_FORCES = {"N": 1.0, "kN": 1e3, "mN": 1e-3, "lbf": 4.4482216152605}
_SIMPLE: dict[str, tuple[Quantity, float]] = {
    **{unit: ("displacement", factor) for unit, factor in _LENGTHS.items()},
    **{f"{unit}/s": ("velocity", factor) for unit, factor in _LENGTHS.items()},
    "ips": ("velocity", _LENGTHS["in"]),
    **{f"{unit}/s^2": ("acceleration", factor) for unit, factor in _LENGTHS.items()},
    "g": ("acceleration", STANDARD_GRAVITY_M_S2),
    "gn": ("acceleration", STANDARD_GRAVITY_M_S2),
    **{unit: ("force", factor) for unit, factor in _FORCES.items()},
}
_IN_CAPITALS = {unit.upper(): unit for unit in _SIMPLE if unit != "mN"}
"""Programs that write in capitals write all so; MN is a thousand million mN."""
KNOWN_MOTIONS = f"{', '.join(_LENGTHS)}, these per s or per s^2, ips, g"
KNOWN = f"{KNOWN_MOTIONS}, {', '.join(_FORCES)}"
"""For people."""


@dataclass(frozen=True)
class Unit:
    """Of a signal, or of one signal over another."""

    quantity: Quantity
    factor: float
    """To SI."""
    per: Quantity | None = None


_RATIOS = {
    "s": Unit("velocity", 1.0, "acceleration"),
    "1/kg": Unit("acceleration", 1.0, "force"),
    "kg^-1": Unit("acceleration", 1.0, "force"),
    "s/kg": Unit("velocity", 1.0, "force"),
    "s^2/kg": Unit("displacement", 1.0, "force"),
}
"""In base units: what they measure is lost in them but for this program's few."""


def unit_of(text: str) -> Unit | None:
    """What a unit says: `mm/s`, `m/s²`, `g/N`, `(m/s)/(m/s^2)`, `s`; None where it is not known."""
    plain = _plain(text)
    ratio = _RATIOS.get(plain.lower())
    if ratio is not None:
        return ratio
    simple = _simple(plain)
    if simple is not None:
        return Unit(*simple)
    for k in (m.start() for m in re.finditer("/", plain)):
        over, under = _simple(_bare(plain[:k])), _simple(_bare(plain[k + 1 :]))
        if over is not None and under is not None:
            return Unit(over[0], over[1] / under[1], under[0])
    return None


def _simple(plain: str) -> tuple[Quantity, float] | None:
    """Of one signal, in small letters as they are or all in capitals."""
    return _SIMPLE.get(plain) or _SIMPLE.get(_IN_CAPITALS.get(plain, ""))


def _plain(text: str) -> str:
    """One spelling of each."""
    plain = re.sub(r"[\s\[\]]", "", text).replace("⁻", "^-").replace("¹", "1")
    for written, ours in (("²", "^2"), ("**2", "^2"), ("µ", "u"), ("μ", "u"), ("s2", "s^2"), ("S2", "S^2")):
        plain = plain.replace(written, ours)
    # m s^-2, mm·s^-1: as programs write it that know no stroke.
    plain = re.sub(r"[·⋅]?s\^-(1|\^?2)(?!\d)", lambda m: "/s" if m[1] == "1" else "/s^2", plain)
    return _bare(re.sub(r"/s/s(?![\w^])", "/s^2", plain))


def _bare(text: str) -> str:
    """Without brackets around the whole."""
    return text[1:-1] if re.fullmatch(r"\([^()]*\)", text) else text
