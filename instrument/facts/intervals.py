"""Intervals of a law's numbers by one method, beside those of its linear errors."""

from instrument.facts.number import Number
from instrument.facts.result import Result

Bounds = tuple[Number, Number]
"""Lower and upper; null where it is open."""


class QuantityInterval(Result):
    """Of a parameter, or of G' or eta at a frequency, in its own unit."""

    quantity: str
    value: Number
    interval_68_percent: Bounds
    interval_95_percent: Bounds
    linear_68_percent: Bounds
    linear_95_percent: Bounds


class IntervalsFound(Result):
    """By profile, posterior or bootstrap; what follows `advice` is the posterior's alone."""

    method: str
    quantities: tuple[QuantityInterval, ...]
    advice: str
    samples: int | None = None
    seconds: Number | None = None
    full_evaluations_in_that_time: Number | None = None
    acceptance: Number | None = None
    effective_samples: dict[str, Number] | None = None
    """Number of independent samples, by quantity."""
    r_hat: dict[str, Number] | None = None
    """How far the chains are from agreeing (1 where they do), by quantity."""
    checked_in_full: int | None = None
    """Samples that were evaluated in full."""
    weights_effective_share: Number | None = None
    """Effective share of the samples by their importance weights."""
    weights_log_standard_deviation: Number | None = None
