"""The result of `viscorig check`."""

from typing import Literal

from instrument.facts.number import MaybeNumber, Number
from instrument.facts.result import Result


class SegmentForecast(Result):
    """What a segment will look like."""

    segment: int
    low_hz: Number
    high_hz: Number
    steps: int
    range_name: str
    velocity_m_s: Number
    """Largest at the pickup, as the laser sees it."""
    travel_m: Number
    """Largest of the base."""
    seconds: Number


class ToleranceUsed(Result):
    """A tolerance under the key it has in a specimen's file, which ends with its unit."""

    name: str
    value: Number
    source: Literal["named", "typical"]


class SoakForecast(Result):
    """What the chamber is asked before the sweep."""

    set_point_c: Number
    within_c: Number
    soak_s: Number
    """To stay within, once it is there."""
    most_s: Number
    """For all of it."""


class CheckResult(Result):
    """A run that was not made."""

    segments: tuple[SegmentForecast, ...]
    modes_hz: tuple[Number, ...]
    hammer_record_s: MaybeNumber = None
    """None without a hammer test."""
    temperature: SoakForecast | None = None
    """None where the experiment asks for no temperature."""
    seconds: Number
    """In all; of a soak its own time, not the chamber's way to its set point."""
    exact: bool = False
    """Whether everything stated is taken as exact."""
    tolerances: tuple[ToleranceUsed, ...] = ()
    warnings: tuple[str, ...] = ()
    faults: tuple[str, ...] = ()
    """Where there is one nothing is forecast: segments and modes are empty, no time is needed."""
