"""Rows that an identification and a diagnosis both have."""

from collections.abc import Mapping

from instrument.facts.number import Number
from instrument.facts.result import Result


class LawRow(Result):
    """The law at one frequency, with standard errors."""

    frequency_hz: Number
    storage_modulus_pa: Number
    loss_factor: Number
    storage_modulus_standard_error_pa: Number
    loss_factor_standard_error: Number


class LawKnown(Result):
    """How well the law's curve is known as a whole: ln G' at a few frequencies, then eta."""

    frequency_hz: tuple[Number, ...]
    covariance: tuple[tuple[Number, ...], ...]
    """Of the lower triangle, the diagonal last in each row; so too the next."""
    of_another_measurement: tuple[tuple[Number, ...], ...]
    """How far curves would scatter, were the same law measured again."""
    stated: Mapping[str, tuple[Number, ...]] = {}
    """What the tolerance of each stated number passes on to the curve."""


class HeldOut(Result):
    """A segment predicted from the others, in amplitude."""

    segment: int
    rms_percent: Number
    noise_percent: Number


class AdjustedNumber(Result):
    """A stated number beside what the fit found it to be, both in `unit`."""

    name: str
    stated: Number
    tolerance: Number
    found: Number
    standard_error: Number
    pull: Number
    """(found - stated) in tolerances."""
    unit: str


class PointSetAside(Result):
    """A reading that takes no part in the fit."""

    frequency_hz: Number
    segment: int
    sweep: int
    level_m_s2: Number
    measured_m_s: Number
    """The reading, as in `points`."""
    why: str
    """`signal_dropout`, `mains_hum`, or another effect that spoils single readings; `fixture_resonance`;
    `insensitive` where the core hardly shows and the rig's own error does."""
    file: int | None = None
    """From 1, of several."""
    pickup: int | None = None
    """From 0, of several."""


class StretchSetAside(Result):
    """A stretch of one of several files that takes no part."""

    file: int
    """From 1."""
    name: str
    from_hz: Number
    to_hz: Number
    largest_percent: Number
    """By which it is off what lies about it."""
    points: int
