"""Local disturbances of a shear pair's sweep: where a fixture resonates by itself.

What a law, mass, gain, delay or softening may leave is smooth in frequency, seen through how the reading
depends on the core. That is taken off (`smooth_core`); stretches of the rest far above its scatter elsewhere
are flagged. Every curve by itself: no law, and no other file, has a say in it. But what another level of
the same does not show is no fixture's, which is linear: pads slip or soften so, and that stays in.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import median_filter

from fitting.arrays import Array, Mask
from fitting.data.levels import are_of
from fitting.data.noise import groups_of
from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.problem.smooth_core import unexplained
from fitting.identification.validation import rms
from fitting.laws import CoreLaw

FEWEST = 60
"""Points of a curve below which a stretch of it says nothing."""
SIGMAS, LEAST = 7.0, 0.004
"""Above the scatter, and of the reading: a stretch is flagged beyond both."""
_GROW, _GAP = 0.02, 0.06
"""In ln f: a stretch is taken a little wider; two that are nearer than that are one."""
_EDGE = 3.0
"""Scatters: where a stretch ends. A choice."""
_TOGETHER = 5
"""Neighbours whose median says so."""
_SHORTEST = 4
"""Points that are off together: fewer are outliers of another kind."""
_MOST = 0.5
"""Of a curve: what is off in more than that is not local."""
_LINEAR = 1 / 3
"""Of what one level is off by: another level of a linear disturbance is not off by less, nor by its noise. A
choice."""
_MEDIAN = 1.177
"""Of a complex normal variable's size, in standard deviations of a part."""


@dataclass(frozen=True)
class Glitch:
    """A stretch of a curve that is set aside."""

    low_hz: float
    high_hz: float
    largest: float
    """Off by so much, of the reading."""
    rms: float
    """The same, all over it."""
    points: int
    at_end: bool = False
    """Whether it goes on up to an end of its curve: nothing shows then that it is local."""
    at_peak: bool = False
    """Whether the pads move most in it: they may slip or soften there, and the fixture be quiet."""


def glitches(problem: SmallProblem, law: CoreLaw) -> tuple[Mask, tuple[Glitch, ...]]:
    """Points that a local disturbance spoils, of one shear pair's sweep, and the stretches they are in.

    `law` is a first guess of the core. Shape (points,).
    """
    sweep = problem.sweep
    aside, found = np.zeros(len(sweep), bool), list[Glitch]()
    if not sweep.has_phase:
        return aside, ()
    curves = [_looked_at(problem, group, law) for group in groups_of(sweep) if len(group) >= FEWEST]
    for curve in curves:
        others = [other for other in curves if not are_of(curve.level_m_s2, np.array(other.level_m_s2))]
        inside = _stretches(curve.frequency_hz, curve.rest)
        if not inside or np.any(inside, axis=0).mean() > _MOST:
            continue
        for here in inside:
            f, rest = curve.frequency_hz[here], curve.rest[here]
            if any(other.is_calm(float(f.min()), float(f.max()), rms(rest)) for other in others):
                continue
            aside[curve.at[here]] = True
            size = float(rest.max()), rms(rest)
            at_end = bool(here[0] or here[-1])
            at_peak = bool(here[np.argmax(curve.moves)])
            found.append(Glitch(float(f.min()), float(f.max()), *size, int(here.sum()), at_end, at_peak))
    return aside, tuple(found)


@dataclass(frozen=True)
class _Curve:
    """One curve of a sweep, ascending in frequency. Shapes (points,)."""

    at: NDArray[np.intp]
    level_m_s2: float
    frequency_hz: Array
    rest: Array
    """What no core explains, relative."""
    moves: Array
    """The pads' shear, up to a factor."""

    def is_calm(self, low_hz: float, high_hz: float, off: float) -> bool:
        """Whether it shows nothing where another level is off by so much."""
        f = self.frequency_hz
        inside = (f >= low_hz) & (f <= high_hz)
        return int(inside.sum()) >= _SHORTEST and rms(self.rest[inside]) < _LINEAR * off


def _looked_at(problem: SmallProblem, group: NDArray[np.intp], law: CoreLaw) -> _Curve:
    sweep = problem.sweep
    at = group[np.argsort(sweep.frequency_hz[group], kind="stable")]
    curve, rational = sweep.take(at), problem.rational.at(at)
    left, G = unexplained(curve, rational, problem.specimen.reads, law)
    level = float(np.median(curve.commanded_m_s2))
    return _Curve(at, level, curve.frequency_hz, np.abs(left), np.abs(rational.displacement(G)))


def _stretches(f: Array, rest: Array) -> list[Mask]:
    """Points of each range in which a curve is off, its edges where it comes down to its scatter.

    In ascending order; shapes (points,).
    """
    t, scatter = np.log(f), float(np.median(rest)) / _MEDIAN
    over = rest > max(SIGMAS * scatter, LEAST)
    # Neighbours that are off together: by chance one reading of a hundred is that far off.
    off = over | (median_filter(rest, _TOGETHER, mode="nearest") > _EDGE * max(scatter, LEAST / SIGMAS))
    at = np.flatnonzero(off)
    runs = np.split(at, np.flatnonzero(np.diff(t[at]) > _GAP) + 1)
    return [
        (t >= t[run[0]] - _GROW) & (t <= t[run[-1]] + _GROW) for run in runs if np.sum(over[run]) >= _SHORTEST
    ]
