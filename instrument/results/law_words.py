"""A law at a few frequencies as people read it: in a terminal, and in a notebook's print."""

from collections.abc import Sequence

from instrument.facts.rows import LawRow
from instrument.results.numbers import with_error

_ROWS = 6
"""Or one or two more: the last is always shown."""
LAW_COLUMNS = ("frequency/Hz", "G'/MPa", "loss factor")


def sources_words(method: str, noise: str) -> str:
    """What is in a fit's standard errors, by its method and where it has its noise from (`Noise.source`)."""
    if method != "direct":
        return "what the fit leaves"
    known = noise not in ("unknown", "misfit")
    return "noise, model error, tolerances" if known else "what the fit leaves, tolerances"


def a_few(law: Sequence[LawRow]) -> list[LawRow]:
    """Rows spread over the band, its ends among them."""
    every = max(1, len(law) // _ROWS)
    return [law[k] for k in sorted({*range(0, len(law), every), len(law) - 1})] if law else []


def law_cells(rows: Sequence[LawRow], frequency: str = ".1f", sign: str = "+-") -> list[list[str]]:
    """Cells under `LAW_COLUMNS`, each value with its standard error behind the sign."""
    return [
        [
            f"{r.frequency_hz:{frequency}}",
            with_error(r.storage_modulus_pa, r.storage_modulus_standard_error_pa, 1e-6, sign),
            with_error(r.loss_factor, r.loss_factor_standard_error, sign=sign),
        ]
        for r in rows
    ]


def aligned(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """A table as lines of text, cells to the right."""
    widths = [max(map(len, column)) for column in zip(columns, *rows, strict=True)]
    return [
        "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))
        for row in (columns, *rows)
    ]
