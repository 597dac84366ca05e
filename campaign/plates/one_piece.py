"""Sweeps in one piece: one segment through every resonance of a band, as FRFs are handed in."""

from dataclasses import replace

import numpy as np

from campaign.draws import log_uniform
from campaign.noise import NoiseFigures
from campaign.plates.noise import PlateNoise
from campaign.plates.schedule import Resonance, in_passes
from campaign.schedule import Schedule

FEWEST = 5
"""Resonances of a band that is worth a sweep in one piece."""
_MOST = 6
"""The seventh of the solid is up to 0.16 % off a finer one, the sixth 0.06 % at most."""
_LINES = (400, 3200)
"""Of a sweep at one level; each number as likely in its logarithm."""
_BEGINS, _ENDS = (0.4, 0.8), (1.04, 1.1)
"""Of the first resonance, and of the last one."""
_UP_OR_DOWN = (0.8, 0.2)
"""How often such a sweep goes up, and down: hardly anybody sweeps down."""
_FLOOR = (3e-4, 2e-3)
"""Of the largest peak: one range serves all resonances, so what is read has 54 to 70 dB."""


def in_one_piece(
    rng: np.random.Generator, every: list[Resonance], known_to_hz: float = np.inf
) -> list[Resonance]:
    """Resonances of a band, from the first on; five or six. Raises `ArithmeticError` if fewer.

    The sweep ends below `known_to_hz`: what is simulated is no plate beyond.
    """
    count = int(rng.integers(FEWEST, _MOST + 1))
    known = [r for r in every if _ENDS[1] * r.frequency_hz < known_to_hz]
    if len(known) < FEWEST:
        raise ArithmeticError(f"{len(known)} resonances are excited and known, expected {FEWEST}")
    return known[:count]


def judged_of(chosen: list[Resonance]) -> list[Resonance]:
    """The first, a middle one and the last: where the law is judged."""
    return [chosen[0], chosen[(len(chosen) - 1) // 2], chosen[-1]]


def draw_whole(rng: np.random.Generator, chosen: list[Resonance], levels_g: tuple[float, ...]) -> Schedule:
    """Even lines from below the first to above the last; one pass at each level, from low to high."""
    count = int(log_uniform(rng, *_LINES) / len(levels_g))
    low, high = chosen[0].frequency_hz * rng.uniform(*_BEGINS), chosen[-1].frequency_hz * rng.uniform(*_ENDS)
    f = np.round(np.linspace(low, high, count), 4)
    up_or_down = str(rng.choice(["up", "down"], p=_UP_OR_DOWN))
    return in_passes(rng, [f], [0], up_or_down, levels_g)


def of_one_range(rng: np.random.Generator, noise: PlateNoise) -> PlateNoise:
    """Drifts as `noise` has them, over a floor that the largest peak alone decides."""
    floor = log_uniform(rng, *_FLOOR)
    return replace(noise, white=NoiseFigures(floor, noise.white.repeat_scatter))
