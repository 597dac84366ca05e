"""A core found band by band, and whether it is a causal one."""

from math import nan

from instrument.facts.number import MaybeNumber, Number
from instrument.facts.result import Result


class BandFound(Result):
    """G' and the loss factor of one band; NaN where nothing was found."""

    frequency_hz: Number
    storage_modulus_pa: Number = nan
    loss_factor: Number = nan
    storage_modulus_standard_error_pa: Number = nan
    loss_factor_standard_error: Number = nan
    points: int
    determined: bool
    reason: str | None = None
    """Why it is not determined."""


class CausalityTest(Result):
    """Whether G' and the loss factor, found apart from each other, belong to one causal core."""

    consistent: bool
    p_value: MaybeNumber = None
    chi2_per_dof: MaybeNumber = None
    bands: int
    words: str
