"""Nastran: MAT1 whose E, G and GE follow TABLED1 by MATF1. Large fields, 16 columns."""

from collections.abc import Sequence

from fitting.arrays import Array
from instrument.cards.card import Card, commented

_MATERIAL, _YOUNG, _SHEAR, _DAMPING = 1, 101, 102, 103
_WIDE, _NAME, _FIELDS = 16, 8, 4


def nastran(card: Card) -> str:
    """Bulk data for direct frequency response."""
    law = card.law
    middle = len(law.frequency_hz) // 2
    G, eta = float(card.storage[middle]), float(law.loss_factor[middle])
    lines = [
        *card.header(),
        f"MAT1 holds E = 2 (1 + nu) G', G', GE = eta at {law.frequency_hz[middle]:g} Hz; MATF1 puts the "
        "tables in their place, by frequency in Hz (direct frequency response)",
        card.about_table(),
    ]
    f = law.frequency_hz
    return "\n".join(
        [
            *commented("$", lines),
            *_entry("MAT1", [_MATERIAL, card.young_pa(G), G, card.poisson, None, None, None, eta]),
            *_entry("MATF1", [_MATERIAL, _YOUNG, _SHEAR, None, None, None, None, _DAMPING]),
            *_table(_YOUNG, f, 2 * (1 + card.poisson) * card.storage),
            *_table(_SHEAR, f, card.storage),
            *_table(_DAMPING, f, law.loss_factor),
            "",
        ]
    )


def _table(number: int, x: Array, y: Array) -> list[str]:
    pairs = [v for pair in zip(x.tolist(), y.tolist(), strict=True) for v in pair]
    return _entry("TABLED1", [number, *(None,) * 7, *pairs, "ENDT"])


def _entry(name: str, fields: Sequence[float | str | None]) -> list[str]:
    """Four fields a line, continued by lines that begin with a star."""
    found = []
    for k in range(0, len(fields), _FIELDS):
        begin = f"{name}*" if k == 0 else "*"
        found.append(f"{begin:<{_NAME}}" + "".join(_field(v) for v in fields[k : k + _FIELDS]).rstrip())
    return found


def _field(value: float | str | None) -> str:
    if value is None:
        text = ""
    elif isinstance(value, float):
        text = f"{value:.8E}"
    else:
        text = str(value)
    return f"{text:<{_WIDE}}"
