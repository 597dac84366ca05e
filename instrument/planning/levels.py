"""Which level to drive with: the lowest that is no slower, within what the rig can do."""

from dataclasses import dataclass

import numpy as np

from fitting.gravity import PUBLISHED_G_M_S2
from fitting.planning.aims import Aims
from fitting.planning.choice import Choice, choose
from fitting.planning.sensitivity import Sensitivity
from instrument.files.acceleration import in_both
from instrument.planning.outlook import Outlook
from instrument.planning.wish import LEVELS_G, Wish

_SLOWER = 1.1
"""Times the shortest rig time, or the least error, that a low level may take: high ones soften a core."""


@dataclass(frozen=True)
class Level:
    """One level, with the steps it would take."""

    level_g: float
    choice: Choice
    sensitivity: Sensitivity
    why_not: str = ""
    """Which limit of the rig it exceeds; empty for a level that can be driven."""


def levels_of(outlook: Outlook, aims: Aims, wish: Wish) -> list[Level]:
    """Each level that is considered, in ascending order."""
    asked = (wish.level_g,) if wish.level_g is not None else LEVELS_G
    one = outlook.sensitivity(1.0, wish.noise)
    found = []
    for level_g in asked:
        s = at_level(one, outlook, wish, level_g)
        choice = choose(s, aims, outlook.candidates.seconds, wish.target)
        found.append(Level(level_g, choice, s, _exceeds(outlook, s, wish, level_g)))
    return found


def at_level(one: Sensitivity, outlook: Outlook, wish: Wish, level_g: float) -> Sensitivity:
    """The readings of a sensitivity at 1 m/s^2, at another level: only the floor does not grow with it."""
    level = level_g * PUBLISHED_G_M_S2
    v = level * one.velocity_m_s
    std = wish.noise.std_m_s(v, outlook.candidates.dwell_s) / level
    s = one.with_noise(std)
    return Sensitivity(s.law, v, level * s.sigma_m_s, s.rows, s.prior, s.stated)


def chosen_level(levels: list[Level]) -> Level:
    """The lowest that the rig can drive and that is nearly as good as any."""
    able = [x for x in levels if not x.why_not] or levels[:1]
    least = min(float(x.choice.worst[-1]) for x in able)
    good = [x for x in able if x.choice.reached or x.choice.worst[-1] <= _SLOWER * least]
    shortest = min(float(x.choice.seconds[-1]) for x in good)
    return next(x for x in good if x.choice.seconds[-1] <= _SLOWER * shortest)


def _exceeds(outlook: Outlook, s: Sensitivity, wish: Wish, level_g: float) -> str:
    limits, level = wish.settings.limits, level_g * PUBLISHED_G_M_S2
    travel = level / (2 * np.pi * outlook.band_hz[0]) ** 2
    if level > limits.warn * limits.base_m_s2:
        return f"base acceleration {in_both(level)}, limit {in_both(limits.base_m_s2)}"
    for what, value, limit, unit in (
        ("travel of the base", 1e3 * travel, 1e3 * limits.travel_m, "mm"),
        ("velocity", float(np.abs(s.velocity_m_s).max()), limits.velocity_m_s, "m/s"),
    ):
        if value > limits.warn * limit:
            return f"{what} {value:.3g} {unit}, limit {limit:.3g} {unit}"
    return ""
