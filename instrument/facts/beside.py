"""Somebody's measurement of the material beside a law."""

from instrument.facts.number import MaybeNumber, Number
from instrument.facts.result import Result


class BesideTemperature(Result):
    """Rows of one temperature, less the law."""

    temperature_c: Number
    """NaN where it is not stated."""
    rows: int
    storage_modulus_mean_difference_percent: Number
    storage_modulus_rms_difference_percent: Number
    loss_factor_mean_difference: Number
    loss_factor_rms_difference: Number
    chi2: Number
    degrees_of_freedom: int
    p_value: Number
    differs: bool | None
    """None where it cannot be told."""
    noise: str
    """Where that of the rows is known from: `stated`, `scatter`, `unknown`."""


class BesideTable(Result):
    """A table beside the law, inside the band."""

    source: str
    """Name of the table's file."""
    kind: str
    poisson: MaybeNumber = None
    """With which a modulus of tension became one of shear."""
    rows: int
    rows_in_band: int
    temperatures: tuple[BesideTemperature, ...]
