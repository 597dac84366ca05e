"""The result of `viscorig damping`, and of a run's hammer test."""

from math import nan
from typing import Literal

from instrument.facts.number import Number
from instrument.facts.result import Result

Method = Literal["rational_fit", "half_power", "lscf"]
METHODS: tuple[Method, ...] = ("rational_fit", "half_power", "lscf")
"""Methods in order; the ratio of the first is adopted."""


class RatioFound(Result):
    """A damping ratio by one method, as a fraction of critical."""

    ratio: Number
    standard_error: Number = nan


class ModeFound(Result):
    """One mode: what each method says, what is adopted, and what speaks against it."""

    frequency_hz: Number
    frequency_standard_error_hz: Number = nan
    damping_ratio: Number = nan
    """NaN where no method gives one."""
    channel: str = ""
    half_power: RatioFound | None = None
    """None where the method refused."""
    rational_fit: RatioFound | None = None
    lscf: RatioFound | None = None
    lines_in_bandwidth: Number = nan
    bandwidths_to_next: Number = nan
    """Distance to the nearest other mode; NaN for a single one."""
    coherence: Number = nan
    """Mean over its bandwidth; NaN for one hit, and of FRFs."""
    accepted: bool = True
    why: str = ""

    def by(self, method: Method) -> RatioFound | None:
        """The damping ratio that one method gives; None where it gives none."""
        found: RatioFound | None = getattr(self, method)
        return found


class HitUsed(Result):
    """A hit, or why it was left out."""

    source: str
    accepted: bool
    why: str = ""


class SensorOnPlate(Result):
    """The accelerometer on the bare plate."""

    mass_kg: Number
    x_m: Number
    y_m: Number


class DampingResult(Result):
    """Natural frequencies and damping ratios of the bare plate."""

    modes: tuple[ModeFound, ...]
    hits: tuple[HitUsed, ...] = ()
    warnings: tuple[str, ...] = ()
    band_hz: tuple[Number, Number] | None = None
    """Where modes were looked for."""
    sensor: SensorOnPlate | None = None
    """Where the rig states one."""

    @property
    def accepted(self) -> tuple[ModeFound, ...]:
        """The modes that are accepted."""
        return tuple(mode for mode in self.modes if mode.accepted)
