"""Whether a calibration is one: what no laser on the base gives, and what it points to."""

from math import log10

from instrument.stepped_sine.calibration import phase_left
from instrument.stream.derived import CalibrationFound, LimitExceeded, PointMeasured
from instrument.stream.event import Derived

_MOST_GAIN, _MOST_GAIN_STD = 0.3, 0.05
"""Off one, and uncertain, relative: beyond these a calibration is none."""
_NEAR_TEN = 0.06
"""In decades: a power of ten within what a calibration is off otherwise. A choice."""
_HARDLY_ANY = 0.05
"""Of the velocity, or twenty times it: no sensitivity is so far off, but a channel taken for another. A
choice."""
_MOST_PHASE_RAD = 0.2
"""Root mean square that a delay may leave of a calibration's phases: a sensor turned round leaves one or
more, a base that rocks some hundredths. A choice."""


def refused(found: CalibrationFound, points: list[PointMeasured]) -> list[Derived]:
    """What no laser on the base gives."""
    remedy = "is the laser on the base beside the accelerometer? are both sensitivities right?"
    where, uncertain = f"calibration in {found.range_name}:", found.gain_std / found.gain
    if abs(found.gain - 1) > _MOST_GAIN:
        what = f"{where} the laser's velocity over the accelerometer's, which should be 1, is"
        limit = 1 + _MOST_GAIN if found.gain > 1 else 1 - _MOST_GAIN
        return [LimitExceeded(0, what, found.gain, limit, "", _off_gain(found.gain, uncertain) or remedy)]
    if uncertain > _MOST_GAIN_STD:
        what = f"{where} the laser's velocity over the accelerometer's differs between frequencies by"
        return [LimitExceeded(0, what, 100 * uncertain, 100 * _MOST_GAIN_STD, "%", remedy)]
    left, turned = phase_left(points, found.delay_s) if points else (0.0, False)
    if left <= _MOST_PHASE_RAD:
        return []
    if turned:
        remedy = "one of the two faces the other way: invert = true of the accelerometer's or laser's channel"
    what = f"calibration in {found.range_name}: phase that no delay explains"
    return [LimitExceeded(0, what, left, _MOST_PHASE_RAD, "rad", remedy)]


def _off_gain(gain: float, uncertain: float) -> str:
    """What a gain so far off one points to; empty where it could be anything."""
    if uncertain < _MOST_GAIN_STD and abs((tens := log10(gain)) - round(tens)) < _NEAR_TEN:
        return (
            f"a factor of {10 ** abs(round(tens)):g}: is it in sensitivity_mv_per_unit of channels.base, "
            "or does the vibrometer stand in another range than it says?"
        )
    if gain < _HARDLY_ANY or gain > 1 / _HARDLY_ANY or uncertain > _MOST_GAIN_STD:
        return (
            "are two inputs exchanged (the velocity's with the accelerometer's or another sensor's)? else is "
            "the laser on the base beside the accelerometer, and are both sensitivities right?"
        )
    return ""
