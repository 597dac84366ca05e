"""The budget of a law's uncertainty: a row a source."""

from collections.abc import Sequence

from instrument.cli.output import Output
from instrument.facts.budget import BudgetRow, BudgetSource

_LEAST_SHARE = 0.02
"""Share of the total below which a source is only in the JSON."""


def print_budget(out: Output, budget: Sequence[BudgetRow]) -> None:
    """G' in percent and eta at the band's ends and in its middle; small sources left out."""
    budget = [budget[k] for k in sorted({0, len(budget) // 2, len(budget) - 1})]
    names: dict[str, None] = {}
    at = [{s.source: s for s in row.sources} for row in budget]
    for row in budget:
        for s in row.sources:
            if (
                s.storage_modulus_percent > _LEAST_SHARE * row.storage_modulus_standard_error_percent
                or s.loss_factor > _LEAST_SHARE * row.loss_factor_standard_error
            ):
                names[s.source] = None
    columns = [c for row in budget for c in (f"G' / % {row.frequency_hz:.4g} Hz", "eta")]
    rows = [[name, *(c for s in at for c in _cells(s[name]))] for name in names]
    total = [
        c
        for row in budget
        for c in (
            f"{row.storage_modulus_standard_error_percent:.3f}",
            f"{row.loss_factor_standard_error:.5f}",
        )
    ]
    out.table(
        "Standard uncertainty by source, to first order", ["source", *columns], [*rows, ["all", *total]]
    )


def _cells(source: BudgetSource) -> tuple[str, str]:
    return f"{source.storage_modulus_percent:.3f}", f"{source.loss_factor:.5f}"
