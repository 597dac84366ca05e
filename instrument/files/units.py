"""Units as other programs write them: what they measure, and their factor to SI."""

import re
from dataclasses import dataclass
from typing import Literal

from fitting.gravity import STANDARD_GRAVITY_M_S2

Quantity = Literal["displacement", "velocity", "acceleration", "force"]

DERIVATIVE: dict[Quantity, int] = {"displacement": 0, "velocity": 1, "acceleration": 2}
"""How often a motion is differentiated from displacement."""

_SIMPLE: dict[str, tuple[Quantity, float]] = {
    "m": ("displacement", 1.0),
    "mm": ("displacement", 1e-3),
    "um": ("displacement", 1e-6),
    "in": ("displacement", 0.0254),
    "m/s": ("velocity", 1.0),
    "mm/s": ("velocity", 1e-3),
    "um/s": ("velocity", 1e-6),
    "in/s": ("velocity", 0.0254),
    "m/s^2": ("acceleration", 1.0),
    "mm/s^2": ("acceleration", 1e-3),
    "g": ("acceleration", STANDARD_GRAVITY_M_S2),
    "gn": ("acceleration", STANDARD_GRAVITY_M_S2),
    "N": ("force", 1.0),
    "kN": ("force", 1e3),
    "mN": ("force", 1e-3),
    "lbf": ("force", 4.4482216152605),
}
KNOWN = ", ".join(_SIMPLE)
KNOWN_MOTIONS = ", ".join(name for name, (quantity, _) in _SIMPLE.items() if quantity != "force")


@dataclass(frozen=True)
class Unit:
    """Of a signal, or of one signal over another."""

    quantity: Quantity
    factor: float
    """To SI."""
    per: Quantity | None = None


def unit_of(text: str) -> Unit | None:
    """What a unit says: `mm/s`, `m/s²`, `g/N`, `(m/s)/(m/s^2)`, `s`; None where it is not known."""
    plain = _plain(text)
    if plain == "s":
        return Unit("velocity", 1.0, "acceleration")
    if plain in _SIMPLE:
        return Unit(*_SIMPLE[plain])
    for k in (m.start() for m in re.finditer("/", plain)):
        over, under = _bare(plain[:k]), _bare(plain[k + 1 :])
        if over in _SIMPLE and under in _SIMPLE:
            (quantity, a), (per, b) = _SIMPLE[over], _SIMPLE[under]
            return Unit(quantity, a / b, per)
    return None


def _plain(text: str) -> str:
    """One spelling of each."""
    plain = re.sub(r"[\s\[\]]", "", text)
    for written, ours in (("²", "^2"), ("**2", "^2"), ("µ", "u"), ("μ", "u"), ("s2", "s^2")):
        plain = plain.replace(written, ours)
    return _bare(re.sub(r"/s/s(?![\w^])", "/s^2", plain))


def _bare(text: str) -> str:
    """Without brackets around the whole."""
    return text[1:-1] if re.fullmatch(r"\([^()]*\)", text) else text
