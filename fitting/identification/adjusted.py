"""The stated numbers as a joint fit found them, beside what was stated."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp

from fitting.arrays import Array
from fitting.nuisances.nuisance import Nuisance
from fitting.specimen import StatedSpecimen
from fitting.stated.tolerances import ADDED, NUMBERS, StatedValue


@dataclass(frozen=True)
class Adjusted:
    """One stated number; values in `unit`."""

    name: str
    stated: float
    tolerance: float
    """Standard deviation, as stated or typical."""
    found: float
    standard_error: float
    pull: float
    """(found - stated) in tolerances."""
    unit: str


def adjusted(
    specimen: StatedSpecimen, each: Sequence[Nuisance], z: Array, errors: Array
) -> tuple[Adjusted, ...]:
    """`z` and its standard `errors` in standard deviations of the tolerances. Shape (count,) both."""
    return tuple(
        _one(specimen, n, float(at), float(error)) for n, at, error in zip(each, z, errors, strict=True)
    )


def _one(specimen: StatedSpecimen, n: Nuisance, z: float, error: float) -> Adjusted:
    stated, factor, unit = stated_number(specimen, n)
    if is_relative(n):
        found, sigma = stated * exp(n.sigma * z), stated * n.sigma
        spread = found * n.sigma * error
    else:
        found, sigma, spread = stated + n.sigma * z, n.sigma, n.sigma * error
    return Adjusted(n.name, factor * stated, factor * sigma, factor * found, factor * spread, z, unit)


def is_relative(n: Nuisance) -> bool:
    """Whether a number is moved in its logarithm; else by so much."""
    return n.unit == "1" and n.kind not in ADDED


def stated_number(specimen: StatedSpecimen, n: Nuisance) -> StatedValue:
    """What is stated of it; of one that no specimen states, what the fit began with."""
    return specimen.stated_number(n.name) if n.stated is None else NUMBERS[n.kind].valued(n.stated)
