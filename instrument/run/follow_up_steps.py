"""What of a diagnosis's offers a run can do, and the steps that one is: pure."""

from collections.abc import Collection, Sequence
from itertools import groupby

import numpy as np

from drivers.vibrometer.interface import Range
from fitting.gravity import PUBLISHED_G_M_S2
from instrument.check.forecast import range_for
from instrument.facts.follow_up import FollowUp, Support
from instrument.stepped_sine.plan import PlannedSegment
from instrument.stepped_sine.settings import Limits
from instrument.stream.derived import PointMeasured

MOST_OFFERS = 3
"""Of one diagnosis: asked for one after the other."""
_ROOM = 0.8
"""Of a limit, that a planned step may use: resonances are a little higher than they were read."""
_HANG = (
    "Take the plate out of its clamp, hang it by two threads, point the laser at {read}, and strike it at "
    "{hit} with the instrumented hammer when asked for a blow."
)
_STRIKE = (
    "Leave the plate in its clamp and the laser where it is, and strike it at {hit} with the instrumented "
    "hammer when asked for a blow."
)
_BY_STEPS = ("frequencies", "level", "reversed", "spot", "added_mass", "clamping")


def possible(
    offers: Sequence[FollowUp],
    points: Sequence[PointMeasured],
    limits: Limits,
    *,
    most_s: float,
    can_strike: bool,
    held: Collection[Support] = (),
) -> tuple[FollowUp, ...]:
    """Those that fit into this run, in the order they are given, in words for who does them there.

    `most_s` is the time left; `can_strike` whether there is a hammer test to make, `held` how the treated
    plate can be struck.
    """

    def fits(one: FollowUp) -> bool:
        struck = one.kind == "damped_struck" and one.held in held
        return one.kind in _BY_STEPS or (one.kind == "bare_hammer" and can_strike) or struck

    found = [one for one in offers if one.seconds <= most_s and fits(one) and _within(one, points, limits)]
    return tuple(_asked_in_a_run(one) for one in found[:MOST_OFFERS])


def clamped_again(offer: FollowUp) -> FollowUp:
    """What is to be done to a plate that was hung free, before it is driven."""
    todo = "Clamp the plate again at its mark, with the torque it had, nothing else on it."
    return offer.but(kind="clamping", todo=todo, spot_mm=None, struck_mm=None, held=None)


def _asked_in_a_run(offer: FollowUp) -> FollowUp:
    """Where the run records the blows nobody has to make a file of them."""
    if offer.kind != "damped_struck" or offer.struck_mm is None:
        return offer
    hit = _words(offer.struck_mm)
    if offer.held == "free" and offer.spot_mm is not None:
        return offer.but(todo=_HANG.format(hit=hit, read=_words(offer.spot_mm)))
    return offer.but(todo=_STRIKE.format(hit=hit))


def _words(place_mm: tuple[float, float]) -> str:
    return f"({place_mm[0]:.0f}, {place_mm[1]:.0f}) mm"


def follow_up_segments(
    offer: FollowUp, points: Sequence[PointMeasured], sweep: int, ranges: tuple[Range, ...] = ()
) -> tuple[PlannedSegment, ...]:
    """Its steps in order, each in the range that its frequency was read in.

    Where velocities are foreseen it is the finest of `ranges` with room for those of its segment. `sweep` is
    the number of the pass. A step that is named twice is made once.
    """
    level = PUBLISHED_G_M_S2 * offer.level_g if offer.level_g is not None else points[0].level_m_s2
    known = np.array([p.frequency_hz for p in points])
    steps = dict.fromkeys(zip(offer.frequencies_hz, offer.segments, strict=True))
    fastest: dict[int, float] = {}
    for segment, v in zip(offer.segments, offer.velocities_m_s, strict=False):
        fastest[segment] = max(v, fastest.get(segment, 0.0))

    def range_of(step: tuple[float, int]) -> str:
        if step[1] in fastest and ranges:
            return range_for(fastest[step[1]], ranges).name
        return points[int(np.argmin(np.abs(known - step[0])))].range_name

    planned = []
    for (segment, range_name), each in groupby(steps, key=lambda s: (s[1], range_of(s))):
        f = tuple(frequency for frequency, _ in each)
        planned.append(PlannedSegment(segment, sweep, f, (level,) * len(f), range_name))
    return tuple(planned)


def _within(offer: FollowUp, points: Sequence[PointMeasured], limits: Limits) -> bool:
    """Whether what was read, at its level, stays clear of the limits."""
    if offer.level_g is None:
        return True
    level = PUBLISHED_G_M_S2 * offer.level_g
    if level > limits.base_m_s2 or max(offer.velocities_m_s, default=0.0) > _ROOM * limits.velocity_m_s:
        return False
    times = [level / p.level_m_s2 for p in points]
    if max(times, default=0.0) <= 1.0:
        return True
    omega = [2 * np.pi * p.frequency_hz for p in points]
    used = [
        max(
            abs(p.velocity_m_s) * t / limits.velocity_m_s,
            p.drive_v * t / limits.drive_v,
            abs(p.base_m_s2) * t / w**2 / limits.travel_m,
        )
        for p, t, w in zip(points, times, omega, strict=True)
    ]
    return max(used) <= _ROOM
