"""Mains hum: readings near multiples of 50 or 60 Hz that leave the curve of their neighbours.

Every point is compared with a local rational curve through points well away from it and from all multiples,
so that no outlier bends the curve it is judged by. How far points leave that curve where no mains can reach
is the measure; its own uncertainty is kept by taking F instead of chi-square. A sine fit of dwell T sees hum
within about 1/T.
"""

from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Indices, Mask
from fitting.data.noise import FEWEST, Noise, around, evening, groups_of, local_model
from fitting.numerics.chances import chi2_density, chi2_median, f_above
from fitting.sweep import Sweep

MAINS_HZ = (50.0, 60.0)
"""Europe's and America's."""
FALSE_ALARM = 1e-4
"""Chance that a sweep without hum is said to have some, all its points near multiples together.

Found: one in 19400 sweeps of gaussian noise, of levels, densities and peaks of many kinds.
"""
_CORE_HZ = 0.3
"""Points so near to a multiple, or the nearest one, are where hum is looked for."""
_DECIMALS = 6
"""Of Hz: points on either side of a multiple are as near as each other to that."""
_REACH_HZ = 1.0
"""No curve takes points so near to a multiple, or to the point it judges."""
SPREAD_HZ = 10.0
"""Where hum is found, single points as far as this may be set aside."""
_BEYOND = 0.01
"""Of its frequency: how far beyond its neighbours a point is judged by their curve. A resonance just beyond a
coarse sweep's end would else pass for hum: damped structures have none that is narrower."""
_ONCE_FOUND = 1e-3
"""Chance that is enough for a further point, once there is hum."""
_FEWEST_POINTS = 2
"""Within `_REACH_HZ` of multiples of one mains: a single reading may be off by anything, by noise too that is
less even than it is taken to be. On sparse grids one in eight sweeps without hum had one such point."""
_NEIGHBOURS = 10
"""Points that the curve at a point is drawn through, and that it is held against. A choice."""
_STANDS_OUT = 1.5
"""Hum leaves the curve by this factor more than any of its neighbours away from multiples."""


@dataclass(frozen=True)
class HumSeen:
    """Hum as the readings show it."""

    mains_hz: float
    """300 Hz alone is a multiple of both: it is then called 50 Hz."""
    multiples: tuple[int, ...]
    """Which of them are seen."""
    points: Mask
    """Those to set aside. Shape (points,)."""
    size_m_s: float
    """Largest deviation from the neighbours' curve, in `Sweep.response_m_s`."""
    channel: Literal["velocity", "base"]
    """Which reading it is in."""


@dataclass(frozen=True)
class _Deviations:
    """How the points of a group, or of a sweep, leave their neighbours' curves. Shape (points,) each."""

    size: NDArray[Any]
    """Reading minus curve."""
    relative: NDArray[Any]
    """Over the curve."""
    chance: Array
    """Of as large a deviation by noise; 1 where nothing can be said."""
    stands_out: Mask
    between: Mask
    """Whether neighbours lie on both sides."""


@dataclass(frozen=True)
class _Channels:
    """Both channels, point by point."""

    response: _Deviations
    base: _Deviations | None

    @property
    def in_base(self) -> Mask:
        """Where the reference channel deviates more, and reads wrong: a base that truly moves is followed."""
        if self.base is None:
            return np.zeros(len(self.response.size), dtype=bool)
        follows = np.abs(self.response.relative + self.base.relative) >= np.abs(self.response.relative)
        return ~follows & (self.base.chance < self.response.chance)

    def worse(self, name: Literal["chance", "stands_out", "between"]) -> NDArray[Any]:
        """Of the channel that deviates more."""
        other = self.response if self.base is None else self.base
        return np.where(self.in_base, getattr(other, name), getattr(self.response, name))

    def base_explains(self, points: Mask) -> bool:
        """Whether the response at `points` deviates as a wrong reading of the base would make it."""
        if self.base is None:
            return False
        left = np.abs(self.response.relative + self.base.relative)[points]
        return bool(np.sum(left**2) < np.sum(np.abs(self.response.relative[points]) ** 2) / 2)


def mains_hum(sweep: Sweep, noise: Noise) -> HumSeen | None:
    """Hum in the velocity or the reference channel, or None. `noise` says how it goes from point to point."""
    f = sweep.frequency_hz
    aside = np.zeros(len(f), dtype=bool)
    now = _channels(sweep, noise, aside)
    chance, stands_out = now.worse("chance"), now.worse("stands_out")
    cores = {line: _core(sweep, line) for line in _lines(f)}
    tests = sum(int(core.sum()) for core in cores.values()) * (1 if now.base is None else 2)
    least = {line: float(chance[core & stands_out].min(initial=1.0)) for line, core in cores.items()}
    # A sweep's first and last readings may be off by how it began and ended: alone they are no hum.
    inside = np.any(list(cores.values()), axis=0) & stands_out & now.worse("between") if cores else aside
    if not np.any(chance[inside] * tests < FALSE_ALARM):
        return None
    seen = {line: p for line, p in least.items() if p < _ONCE_FOUND}
    mains = max(MAINS_HZ, key=lambda hz: -sum(np.log(max(p, 1e-300)) for s, p in seen.items() if s % hz == 0))
    lines = [line for line in seen if line % mains == 0]
    reach = np.any([np.abs(f - line) <= SPREAD_HZ for line in lines], axis=0)
    more = np.any([cores[line] for line in lines], axis=0)
    # With the worst points gone from the curves and the scatter, the next ones show.
    while np.any(more & ~aside):
        aside = aside | more
        now = _channels(sweep, noise, aside)
        more = reach & (now.worse("chance") < _ONCE_FOUND)
    # Judged now, with the worst points out of all curves and the scatter.
    beside = np.any([np.abs(f - line) <= _REACH_HZ for line in lines], axis=0)
    shows = beside & (now.worse("chance") < _ONCE_FOUND)
    if int(shows.sum()) < _FEWEST_POINTS:
        return None
    return HumSeen(
        mains_hz=mains,
        multiples=tuple(int(line / mains) for line in lines),
        points=aside,
        size_m_s=float(np.abs(now.response.size[aside]).max()),
        channel="base" if now.base_explains(aside) else "velocity",
    )


def _channels(sweep: Sweep, noise: Noise, aside: Mask) -> _Channels:
    even = evening(sweep)
    response = _deviations(sweep, sweep.response_m_s * even, noise.std_m_s * even, aside)
    response = replace(response, size=response.size / even)
    if sweep.base_m_s2 is None:
        return _Channels(response, None)
    reading = sweep.base_m_s2 / sweep.commanded_m_s2
    even = np.ones(len(sweep))
    return _Channels(
        response, _deviations(sweep, reading if sweep.has_phase else np.abs(reading), even, aside)
    )


def _lines(f: Array) -> list[float]:
    """Multiples of any mains that hum could show at, ascending."""
    every = {hz * k for hz in MAINS_HZ for k in range(1, int((f.max() + _REACH_HZ) / hz) + 1)}
    return sorted(line for line in every if np.abs(f - line).min() <= _REACH_HZ)


def _core(sweep: Sweep, line: float) -> Mask:
    """The points of every group where hum at `line` is largest."""
    apart = np.round(np.abs(sweep.frequency_hz - line), _DECIMALS)
    core = apart <= _CORE_HZ
    for group in groups_of(sweep):
        nearest = apart[group].min()
        if nearest <= _REACH_HZ:
            core[group] |= apart[group] <= nearest
    return core


def _deviations(sweep: Sweep, reading: NDArray[Any], std: Array, aside: Mask) -> _Deviations:
    count = len(sweep)
    size, relative = np.zeros((2, count), dtype=reading.dtype)
    chance, (stands_out, between) = np.ones(count), np.zeros((2, count), dtype=bool)
    for group in groups_of(sweep):
        found = _in_group(sweep.frequency_hz[group], reading[group], std[group], aside[group])
        if found is not None:
            size[group], relative[group] = found.size, found.relative
            chance[group], stands_out[group] = found.chance, found.stands_out
            between[group] = found.between
    return _Deviations(size, relative, chance, stands_out, between)


def _in_group(f: Array, v: NDArray[Any], std: Array, aside: Mask) -> _Deviations | None:
    """None where there are too few points away from multiples, or no noise at all."""
    lines = _lines(f)
    nearest = np.array([min(lines, key=lambda line: abs(line - at), default=np.inf) for at in f])
    away = np.abs(f - nearest) > _REACH_HZ
    middle = np.where(away, f, nearest)
    quiet = away & ~aside
    near = _neighbours(f, middle, quiet)
    if near is None:
        quiet, near = away, _neighbours(f, middle, away)
    if near is None:
        return None
    apart = f[near] - f[:, None]
    t = apart / np.abs(apart).max(axis=1, keepdims=True)
    solve = np.linalg.pinv(local_model(t, v[near]))
    unknowns = np.einsum("pun,pn->pu", solve, v[near])
    curve = unknowns[:, 0]
    # The linearised equation at a neighbour carries its noise times the denominator there.
    denominator = 1 - unknowns[:, 3:4] * t if np.iscomplexobj(v) else np.ones_like(t)
    variance = std**2 + np.sum(np.abs(solve[:, 0] * denominator * std[near]) ** 2, axis=1)
    z2 = np.abs(v - curve) ** 2 / variance
    parts = 2 if np.iscomplexobj(v) else 1
    scale2 = np.median(z2[quiet]) / chi2_median(parts)
    if not scale2 > 0:
        return None
    # Blows scatter by more where their force has little, and a curve is worst where a response turns.
    order = np.argsort(f[quiet], kind="stable")
    places = np.searchsorted(f[quiet][order], f).clip(max=len(order) - 1)
    z2 = z2 / np.maximum(scale2, around(z2[quiet][order], len(order))[places] / chi2_median(parts))
    chance = f_above(z2 / parts, parts, _freedom(int(quiet.sum()), parts))
    between = (apart.min(axis=1) < 0) & (apart.max(axis=1) > 0)
    chance = np.where(between | _is_near(f, apart), chance, 1.0)
    beside = np.argsort(np.where(quiet, np.abs(f - middle[:, None]), np.inf), axis=1)[:, :_NEIGHBOURS]
    stands_out = z2 > _STANDS_OUT**2 * z2[beside].max(axis=1)
    return _Deviations(v - curve, (v - curve) / curve, chance, stands_out, between)


def _is_near(f: Array, apart: Array) -> Mask:
    """Where the curve reaches little beyond its neighbours, if at all: a sweep's end.

    `apart` has shape (points, neighbours).
    """
    return np.asarray(np.abs(apart).min(axis=1) <= np.maximum(2 * _REACH_HZ, _BEYOND * f))


def _neighbours(f: Array, middle: Array, quiet: Mask) -> Indices | None:
    """The quiet points nearest to each, out of reach of its `middle`. Shape (points, neighbours)."""
    apart = np.abs(f - f[:, None])
    apart[~quiet[None, :] | (np.abs(f - middle[:, None]) <= _REACH_HZ)] = np.inf
    near = np.argsort(apart, axis=1, kind="stable")[:, :_NEIGHBOURS]
    enough = quiet.sum() >= FEWEST and np.isfinite(np.take_along_axis(apart, near, axis=1)).all()
    return near if enough else None


def _freedom(count: int, parts: int) -> float:
    """Degrees of freedom a variance by the median is worth: 2 / (its relative variance)."""
    median = float(chi2_median(parts))
    density = float(chi2_density(median, parts))
    return 8 * count * (density * median) ** 2
