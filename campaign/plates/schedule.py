"""Which points a sweep has, and when each is read: three segments around resonances that the base excites."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from campaign.draws import along, order_of_segments, order_of_time
from campaign.law import TrueLaw
from campaign.plates.geometry import TruePlate
from campaign.plates.reduced import MODES, ReducedSolid
from campaign.schedule import LATE_S, Pass, Schedule, between_s
from fitting.arrays import Array

_POINTS = (60, 121)
"""In a segment."""
_SEEN = 0.008
"""Peak velocity of a resonance at the spot over the largest: a lab would not measure less."""
_APART = 1.25
"""Ratio of frequencies of two resonances that get a segment each."""
_HALF_WIDTHS = 1.3
"""Half of a segment in loss factors of its resonance, within the next."""
_SHARE = (0.08, 0.22)
"""Of the resonance's frequency: of a narrow resonance some more, of a broad one not all of the band."""
_UNEVEN = (0.85, 1.15)
"""Of that half to either side: nobody hits the middle."""
_STILL = 1e-3
"""Share of the load that a mode takes: less, and it is odd in y, which the base does not excite."""
_BEGUN_PA = 1e6
"""Modulus at which a search for a mode's own frequency begins: within the campaign's range."""
_SETTLED, _MOST_STEPS = 1e-6, 12
"""Relative, of such a frequency, and how often it is improved."""
_CYCLES = 30
_SECONDS = 1.2
"""A point takes this and so many cycles."""


PROBES = tuple(TrueLaw("maxwell", (g, 1e3, 1e-3)) for g in (0.3e6, 2e6))
"""About the softest and the stiffest core that is drawn: a law holds over all of what they reach."""
BESIDE = (0.75, 1.15)
"""Of the first and the last resonance: how far a segment may reach beside it."""
LARGEST_LOSS = 0.35
"""Of a resonance: beyond it no peak is left to measure around."""
MOST_LAWS = 200
"""Draws until one serves; a tenth is seldom needed."""


@dataclass(frozen=True)
class Resonance:
    """One that the base excites."""

    frequency_hz: float
    loss_factor: float
    """That the core gives it."""
    seen: float
    """Peak velocity at the spot, in any unit."""


def resonances(plate: ReducedSolid, spot_m: tuple[float, float], law: TrueLaw) -> list[Resonance]:
    """The even ones in ascending order, the core's modulus taken at each frequency."""
    found = []
    row = plate.reading(*spot_m)
    lam, _ = plate.modes(_BEGUN_PA, MODES)
    for r in range(len(lam)):
        omega, G, shape = _at_its_own(plate, law, r, float(np.sqrt(lam[r])))
        pushed = float(shape @ plate.load[:, 0])
        if pushed**2 < _STILL * float(plate.load[:, 0] @ np.linalg.solve(plate.M, plate.load[:, 0])):
            continue
        eta = G.imag * float(shape @ plate.whole_core @ shape) / omega**2
        found.append(Resonance(omega / (2 * np.pi), eta, abs(float(row @ shape) * pushed) / (eta * omega)))
    return found


def known_to_hz(plate: ReducedSolid, law: TrueLaw) -> float:
    """The last but one of the modes on whose basis a solid stands: up to there it is one.

    Up to there ten solids are within 0.2 % of the layer-wise plate, beyond the last one 4 % off and more.
    """
    lam, _ = plate.modes(_BEGUN_PA, MODES)
    return _at_its_own(plate, law, -2, float(np.sqrt(lam[-2])))[0] / (2 * np.pi)


def _at_its_own(plate: ReducedSolid, law: TrueLaw, r: int, omega: float) -> tuple[float, complex, Array]:
    """Angular frequency, modulus there and shape of the r-th mode, from a guess of the first."""
    for _ in range(_MOST_STEPS):
        G = complex(law.modulus(omega))
        squared, phi = plate.modes(G.real, MODES)
        last, omega = omega, float(np.sqrt(squared[r]))
        if abs(omega / last - 1) < _SETTLED:
            break
    return omega, G, phi[:, r]


def measured_resonances(plate: ReducedSolid, spot_m: tuple[float, float], law: TrueLaw) -> list[Resonance]:
    """The first three that the spot sees and that stand apart. Raises `ArithmeticError` if fewer."""
    chosen = seen_apart(resonances(plate, spot_m, law))
    if len(chosen) < 3:
        raise ArithmeticError(f"{len(chosen)} resonances seen at {spot_m}, expected three: move the spot")
    return chosen[:3]


def seen_apart(every: list[Resonance]) -> list[Resonance]:
    """Resonances that show at the spot and stand apart, in ascending order."""
    largest = max((r.seen for r in every), default=0.0)
    chosen: list[Resonance] = []
    for r in every:
        apart = not chosen or r.frequency_hz > _APART * chosen[-1].frequency_hz
        if r.seen > _SEEN * largest and apart:
            chosen.append(r)
    return chosen


def draw_schedule(
    rng: np.random.Generator,
    chosen: list[Resonance],
    levels_g: tuple[float, ...],
    points: tuple[int, int] = _POINTS,
) -> Schedule:
    """A dense segment for each; levels from low to high, the segments of each in the same order."""
    segments = [_around(rng, r, points) for r in chosen]
    order = order_of_segments(rng, len(segments))
    return in_passes(rng, segments, order, along(rng), levels_g)


def takes_s(frequency_hz: Array) -> Array:
    """What each point takes at least. Shape of `frequency_hz`."""
    return _SECONDS + _CYCLES / frequency_hz


def in_passes(
    rng: np.random.Generator,
    segments: Sequence[Array],
    order: Sequence[int],
    up_or_down: str,
    levels_g: Sequence[float],
) -> Schedule:
    """Segments in an order, level after level; that of their points as `order_of_time` has it.

    Each of shape (points,).
    """
    passes: list[Pass] = []
    now = 0.0
    for level in levels_g:
        for k in order:
            f = segments[k]
            in_time = order_of_time(rng, len(f), up_or_down)
            when = now + np.cumsum(takes_s(f[in_time]) + rng.exponential(LATE_S, len(f)))
            now = float(when[-1]) + between_s(rng)
            time = np.empty(len(f))
            time[in_time] = when
            passes.append(Pass(k + 1, f, level, time))
    return Schedule.of_passes(passes)


def _around(rng: np.random.Generator, r: Resonance, points: tuple[int, int]) -> Array:
    count = int(rng.integers(*points))
    half = float(np.clip(_HALF_WIDTHS * r.loss_factor, *_SHARE))
    low, high = (half * float(rng.uniform(*_UNEVEN)) for _ in range(2))
    return np.round(np.linspace(r.frequency_hz * (1 - low), r.frequency_hz * (1 + high), count), 3)


def widest_band_hz(plate: ReducedSolid, true: TruePlate) -> tuple[float, float]:
    """Where segments may lie, no law drawn yet."""
    soft, stiff = (resonances(plate, true.spot_m, law) for law in PROBES)
    return BESIDE[0] * soft[0].frequency_hz, BESIDE[1] * stiff[2].frequency_hz
