"""Local disturbances of a shear pair's sweep: where a fixture resonates by itself.

What a law, mass, gain, delay or softening may leave is smooth in frequency, seen through how the reading
depends on the core. That is taken off (`smooth_core`); stretches of the rest far above its scatter elsewhere
are flagged. Every curve by itself: no law, and no other file, has a say in it.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import median_filter

from fitting.arrays import Array, Mask
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


def glitches(problem: SmallProblem, law: CoreLaw) -> tuple[Mask, tuple[Glitch, ...]]:
    """Points that a local disturbance spoils, of one shear pair's sweep, and the stretches they are in.

    `law` is a first guess of the core. Shape (points,).
    """
    sweep = problem.sweep
    aside, found = np.zeros(len(sweep), bool), list[Glitch]()
    if not sweep.has_phase:
        return aside, ()
    for group in groups_of(sweep):
        if len(group) < FEWEST:
            continue
        at = group[np.argsort(sweep.frequency_hz[group], kind="stable")]
        curve = sweep.take(at)
        rest = np.abs(unexplained(curve, problem.rational.at(at), problem.specimen.reads, law))
        inside = _stretches(curve.frequency_hz, rest)
        if not inside or np.any(inside, axis=0).mean() > _MOST:
            continue
        for here in inside:
            aside[at[here]] = True
            f = curve.frequency_hz[here]
            size = float(rest[here].max()), rms(rest[here])
            at_end = bool(here[0] or here[-1])
            found.append(Glitch(float(f.min()), float(f.max()), *size, int(here.sum()), at_end))
    return aside, tuple(found)


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
