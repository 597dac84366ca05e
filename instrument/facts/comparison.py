"""The result of `viscorig compare`."""

from instrument.facts.number import MaybeNumber, Number
from instrument.facts.result import Result

Range = tuple[Number, Number]
"""From and to, both of them in it."""


class ComparedAt(Result):
    """Both laws at one frequency: B less A, and that in joint standard errors."""

    frequency_hz: Number
    storage_modulus_difference_percent: Number
    """Difference in percent of A's storage modulus."""
    storage_modulus_z: Number
    loss_factor_difference: Number
    loss_factor_z: Number


class ComparedPair(Result):
    """Two laws over the band that both have."""

    a: str
    b: str
    """Files, with their folders where names alone are not told apart."""
    verdicts: tuple[str, str]
    temperatures_c: tuple[MaybeNumber, MaybeNumber] = (None, None)
    """Of both laws; null where the file does not say."""
    band_hz: Range | None
    """None where they have none in common."""
    chi2: Number
    degrees_of_freedom: Number
    p_value: Number
    """Probability of so large a difference by chance, at all frequencies together."""
    differs: bool | None
    """None where it cannot be told."""
    covariance: str | None
    """Whence that of the curves is: `posterior` of both fits, or `standard errors` of one of them."""
    repeatability_percent: Number = 0.0
    """Standard deviation from mount to mount, counted in for either law; zero where none was stated."""
    alike: tuple[str, ...] = ()
    """Stated numbers that both laws are off by together, being of one specimen."""
    storage_modulus_differs_hz: tuple[Range, ...]
    """Where it does beyond 1.96 joint standard errors."""
    loss_factor_differs_hz: tuple[Range, ...]
    frequencies: tuple[ComparedAt, ...]


class SpreadSize(Result):
    """A relative standard deviation between specimens or mounts; zero where none is needed."""

    percent: Number
    interval_95_percent: Range


class SpreadAt(Result):
    """The common law at one frequency, and how far specimens lie about it."""

    frequency_hz: Number
    storage_modulus_pa: Number
    storage_modulus_standard_error_pa: Number
    """How well the mean of all such specimens is known."""
    storage_modulus_spread: SpreadSize
    loss_factor: Number
    loss_factor_standard_error: Number
    loss_factor_spread: SpreadSize


class SpecimenApart(Result):
    """A specimen or mount that is not like the others, beside their mean at the band's middle."""

    name: str
    p_value: Number
    """Chance that any of an honest group lies so far off."""
    storage_modulus_difference_percent: Number
    loss_factor_difference_percent: Number


class SpreadResult(Result):
    """The spread between specimens, or between mounts of one, told from the uncertainty of each."""

    specimens: tuple[str, ...]
    """Files."""
    frequencies: tuple[SpreadAt, ...]
    apart: tuple[SpecimenApart, ...] = ()
    """Those that are not like the others."""
    without_apart: tuple[SpreadAt, ...] = ()
    """The same without them; empty where none is apart, or fewer than three are left."""


class CompareResult(Result):
    """Laws, each with each."""

    pairs: tuple[ComparedPair, ...]
    spread: SpreadResult | None = None
    """Where it was asked for."""
    repeatability: SpreadResult | None = None
    """Between mounts of one specimen, where the files are those."""
