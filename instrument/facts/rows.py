"""Rows that an identification and a diagnosis both have."""

from instrument.facts.number import Number
from instrument.facts.result import Result


class LawRow(Result):
    """The law at one frequency, with standard errors."""

    frequency_hz: Number
    storage_modulus_pa: Number
    loss_factor: Number
    storage_modulus_standard_error_pa: Number
    loss_factor_standard_error: Number


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
