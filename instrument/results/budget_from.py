"""The budget of a law's uncertainty, read off its fit."""

import numpy as np

from fitting.diagnosis.inference.budget import Budget, budget_of
from fitting.identification.quoted import REFERENCE_FREQUENCIES_HZ
from instrument.facts.budget import BudgetRow, BudgetSource
from instrument.finding.identification import Identified


def budget(found: Identified) -> Budget | None:
    """At the band's ends and reference frequencies inside; None for the paper's method, or without errors."""
    if found.joint is None or np.isnan(found.result.uncertainty.covariance).any():
        return None
    f = found.result.band.frequency_hz
    low, high = float(f[0]), float(f[-1])
    at = sorted({low, high, *(r for r in REFERENCE_FREQUENCIES_HZ if low < r < high)})
    return budget_of(found.joint.begun, np.array(at))


def budget_from(b: Budget) -> tuple[BudgetRow, ...]:
    """A row a frequency: standard uncertainties by source, largest for G' first."""
    by_storage, by_loss = b.total(b.storage_relative), b.total(b.loss_factor)
    return tuple(
        BudgetRow(
            frequency_hz=float(f),
            storage_modulus_standard_error_percent=100 * float(by_storage[k]),
            loss_factor_standard_error=float(by_loss[k]),
            sources=tuple(
                BudgetSource(
                    source=name,
                    storage_modulus_percent=100 * float(part[k]),
                    loss_factor=float(b.loss_factor[name][k]),
                )
                for name, part in sorted(b.storage_relative.items(), key=lambda item: -item[1][k])
            ),
        )
        for k, f in enumerate(b.frequency_hz)
    )
