"""Ansys Mechanical APDL: material 1 by TB,PRONY, material 2 by TB,EXPERIMENTAL."""

from fitting.arrays import Array
from instrument.cards.card import Card, commented

_AT_ONCE = 6
"""Constants of one TBDATA."""


def ansys(card: Card) -> str:
    """Commands of two materials; add MP,DENS."""
    lines = [
        *card.header(),
        "material 1: " + card.about_series(),
        "material 2: complex moduli by frequency (harmonic analyses); " + card.about_table(),
        "EX is instantaneous: 2 (1 + nu) G0; shares are of G0 and K0",
    ]
    return "\n".join([*commented("!", lines), "/UNITS,SI", *_by_series(card), *_by_table(card), ""])


def _elastic(card: Card, material: int) -> list[str]:
    young = card.young_pa(card.prony.g_0_pa)
    return [f"MP,EX,{material},{young:.9E}", f"MP,PRXY,{material},{card.poisson:.9g}"]


def _by_series(card: Card) -> list[str]:
    p = card.prony
    constants = [v for pair in zip(p.shares.tolist(), p.tau_s.tolist(), strict=True) for v in pair]
    data = [
        f"TBDATA,{k + 1}," + ",".join(f"{v:.9E}" for v in constants[k : k + _AT_ONCE])
        for k in range(0, len(constants), _AT_ONCE)
    ]
    found = _elastic(card, 1)
    for part in ("SHEAR", "BULK"):
        found += [f"TB,PRONY,1,1,{len(p.g_pa)},{part}", *data]
    return found


def _by_table(card: Card) -> list[str]:
    """Frequency in Hz, storage and loss modulus in Pa."""
    ratio = card.bulk_over_shear()
    found = _elastic(card, 2)
    for part, factor in (("GMODULUS", 1.0), ("KMODULUS", ratio)):
        found += [f"TB,EXPERIMENTAL,2,,,{part}", *_points(card, factor * card.storage, factor * card.loss)]
    return found


def _points(card: Card, storage: Array, loss: Array) -> list[str]:
    rows = zip(card.law.frequency_hz, storage, loss, strict=True)
    return [f"TBPT,,{f:.9E},{a:.9E},{b:.9E}" for f, a, b in rows]
