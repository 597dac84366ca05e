"""A law in tables: at frequencies of its band, and by its parameters."""

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import NamedTuple

from instrument.report.blocks import TableBlock
from instrument.results.error_words import is_below_floor, percent_words
from instrument.results.numbers import format_number, with_error
from instrument.results.typeset import quantity

_ROWS = 9
"""A curve is drawn beside them."""


class LawAt(NamedTuple):
    """The law at one frequency, with standard errors."""

    frequency_hz: float
    storage_modulus_pa: float
    storage_modulus_error_pa: float
    loss_factor: float
    loss_factor_error: float


def band_table(title: str, law: Sequence[LawAt]) -> TableBlock:
    """Some rows of a law, its ends among them."""
    every = max(1, -(-len(law) // _ROWS))
    shown = sorted({*range(0, len(law), every), len(law) - 1}) if law else []
    rows = tuple(
        (
            f"{at.frequency_hz:.4g}",
            with_error(at.storage_modulus_pa, at.storage_modulus_error_pa, 1e-6),
            with_error(at.loss_factor, at.loss_factor_error),
        )
        for at in (law[k] for k in shown)
    )
    return TableBlock(title, ("f / Hz", "G' / MPa", "loss factor"), rows)


def correlation_table(title: str, correlations: Mapping[str, Mapping[str, float]]) -> TableBlock:
    """Every parameter with every other; a dash beside one at a limit."""
    names = {name: quantity(name).split(" / ")[0] for name in correlations}
    rows = tuple(
        (names[name], *(f"{row[n]:+.3f}" if isfinite(row[n]) else "-" for n in names))
        for name, row in correlations.items()
    )
    return TableBlock(title, ("", *names.values()), rows)


def parameter_table(
    title: str, values: Mapping[str, float], errors: Mapping[str, float], bounds: Mapping[str, str]
) -> TableBlock:
    """Every parameter with its standard error; `bounds` are those that one sits at, by name."""
    rows = []
    for name, value in values.items():
        error = errors[name]
        said = format_number(value, 5) if is_below_floor(error, value) else with_error(value, error)
        bound = bounds.get(name)
        remark = f"at its {bound} bound" if bound else ""
        rows.append((quantity(name), said, percent_words(error, value), remark))
    return TableBlock(title, ("parameter", "value", "error / %", "remark"), tuple(rows))
