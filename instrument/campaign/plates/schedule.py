"""Which points a sweep has, and when each is read: three segments around resonances that the base excites."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Integers
from instrument.campaign.draws import order_of_time
from instrument.campaign.law import TrueLaw
from instrument.campaign.plates.geometry import TruePlate
from instrument.campaign.plates.reduced import MODES, ReducedSolid
from instrument.campaign.schedule import Schedule

_POINTS = (60, 121)
"""In a segment."""
_SEEN = 0.008
"""Peak velocity of a resonance at the spot over the largest: a lab would not measure less."""
_APART = 1.25
"""Ratio of frequencies of two resonances that get a segment each."""
_HALF_WIDTHS = 1.3
"""Half of a segment in loss factors of its resonance, within the next."""
_SHARE = (0.08, 0.22)
_STILL = 1e-3
_SETTLED, _MOST_STEPS = 1e-6, 12
CYCLES = 30
SECONDS = 1.2
"""A point takes this and so many cycles."""
LATE_S = 0.05
"""Mean of what a point takes beyond that, exponentially distributed."""
_BETWEEN_S = (40.0, 160.0)


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
    lam, _ = plate.modes(1e6, MODES)
    for r in range(len(lam)):
        omega = float(np.sqrt(lam[r]))
        for _ in range(_MOST_STEPS):
            G = complex(law.modulus(omega))
            squared, phi = plate.modes(G.real, MODES)
            last, omega = omega, float(np.sqrt(squared[r]))
            if abs(omega / last - 1) < _SETTLED:
                break
        shape = phi[:, r]
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
    omega = float(np.sqrt(plate.modes(1e6, MODES)[0][-2]))
    for _ in range(_MOST_STEPS):
        last, omega = omega, float(np.sqrt(plate.modes(complex(law.modulus(omega)).real, MODES)[0][-2]))
        if abs(omega / last - 1) < _SETTLED:
            break
    return omega / (2 * np.pi)


def measured_resonances(plate: ReducedSolid, spot_m: tuple[float, float], law: TrueLaw) -> list[Resonance]:
    """The first three that the spot sees and that stand apart. Raises `ArithmeticError` if fewer."""
    chosen = seen_apart(resonances(plate, spot_m, law))
    if len(chosen) < 3:
        raise ArithmeticError(f"{len(chosen)} resonances seen at {spot_m}, expected three: move the spot")
    return chosen[:3]


def seen_apart(every: list[Resonance]) -> list[Resonance]:
    """Those that show at the spot and stand apart, in ascending order."""
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
    up = list(range(len(chosen)))
    order = {0: up, 1: up[::-1], 2: list(rng.permutation(len(up)))}[int(rng.integers(3))]
    along = str(rng.choice(["up", "down", "random"], p=[0.7, 0.15, 0.15]))
    parts: list[tuple[Array, Integers, Integers, Array, Array]] = []
    now = 0.0
    for level in levels_g:
        for k in order:
            f = segments[k]
            count = len(f)
            in_time = order_of_time(rng, count, along)
            takes = SECONDS + CYCLES / f[in_time] + rng.exponential(LATE_S, count)
            when = now + np.cumsum(takes)
            now = float(when[-1]) + between_s(rng)
            time = np.empty(count)
            time[in_time] = when
            segment, number = np.full(count, k + 1, np.intp), np.full(count, len(parts) + 1, np.intp)
            parts.append((f, segment, number, np.full(count, level), np.round(time, 3)))
    return Schedule(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _around(rng: np.random.Generator, r: Resonance, points: tuple[int, int]) -> Array:
    count = int(rng.integers(*points))
    half = float(np.clip(_HALF_WIDTHS * r.loss_factor, *_SHARE))
    low, high = (half * float(rng.uniform(0.85, 1.15)) for _ in range(2))
    return np.round(np.linspace(r.frequency_hz * (1 - low), r.frequency_hz * (1 + high), count), 3)


def between_s(rng: np.random.Generator) -> float:
    """From one pass to the next."""
    return float(rng.uniform(*_BETWEEN_S))


def widest_band_hz(plate: ReducedSolid, true: TruePlate) -> tuple[float, float]:
    """Where segments may lie, no law drawn yet: the first resonance at 0.3 MPa to the third at 2 MPa."""
    soft, stiff = (
        TrueLaw("maxwell", (0.3e6, 1e3, 1e-3)),
        TrueLaw("maxwell", (2e6, 1e3, 1e-3)),
    )
    low, high = (resonances(plate, true.spot_m, law) for law in (soft, stiff))
    return 0.75 * low[0].frequency_hz, 1.15 * high[2].frequency_hz
