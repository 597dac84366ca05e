"""The result of `viscorig predict`."""

from math import nan

from instrument.facts.number import Number
from instrument.facts.result import Result


class PointPredicted(Result):
    """Velocity at the pickup at one frequency: a phasor of e^{+i omega t}, zero to peak."""

    frequency_hz: Number
    velocity_re_m_s: Number
    velocity_im_m_s: Number
    velocity_m_s: Number
    velocity_standard_error_m_s: Number = nan
    """Given where the law and the plate are a fit's."""
    phase_standard_error_rad: Number = nan
    pickup: int | None = None
    """From 0, of several."""


class PredictionResult(Result):
    """The response at the pickup under the specimen's base acceleration, or for a force of 1 N."""

    points: tuple[PointPredicted, ...]
    notes: tuple[str, ...] = ()
