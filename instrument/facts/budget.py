"""The budget of a law's uncertainty."""

from instrument.facts.number import Number
from instrument.facts.result import Result


class BudgetSource(Result):
    """Standard uncertainty by one source: noise, model error, a tolerance."""

    source: str
    storage_modulus_percent: Number
    loss_factor: Number


class BudgetRow(Result):
    """At one frequency, to first order; the largest source for G' first."""

    frequency_hz: Number
    storage_modulus_standard_error_percent: Number
    loss_factor_standard_error: Number
    sources: tuple[BudgetSource, ...]
