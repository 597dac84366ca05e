"""Whether a measurement that could be made was made already, and would be the same once more."""

from collections.abc import Iterable

from instrument.facts.follow_up import FollowUp
from instrument.planning.measurement import Measurable

_SAME_MM = 1.0
"""Places as near as this are one: a laser or a mass is put no better."""


def made_before(one: Measurable, done: Iterable[FollowUp]) -> bool:
    """Whether one of `done` was of the same kind, place, level and segments, and no shorter.

    What somebody has prepared is the same however long it is then read.
    """
    return any(_same(one, other) for other in done)


def _same(one: Measurable, other: FollowUp) -> bool:
    if one.kind != other.kind or one.held != other.held:
        return False
    mass_m = tuple(one.mass.values[1:]) if one.mass is not None else None
    places = ((one.spot_m, other.spot_mm), (one.struck_m, other.struck_mm), (mass_m, other.mass_at_mm))
    if not all(_one_place(m, mm) for m, mm in places):
        return False
    if one.frequencies_hz and other.level_g is not None and abs(one.level_g / other.level_g - 1) > 0.01:
        return False
    shorter = not one.needs_hands and len(one.frequencies_hz) > len(other.frequencies_hz)
    return set(one.segments) <= set(other.segments) and not shorter


def _one_place(place_m: tuple[float, ...] | None, place_mm: tuple[float, ...] | None) -> bool:
    if place_m is None or place_mm is None:
        return place_m is place_mm
    return all(abs(1e3 * m - mm) <= _SAME_MM for m, mm in zip(place_m, place_mm, strict=True))
