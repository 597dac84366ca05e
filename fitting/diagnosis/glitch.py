"""Local disturbances of a shear pair's sweep: where a fixture resonates by itself.

What a law, mass, gain, delay or softening may leave is smooth in frequency, seen through how the reading
depends on the core. That is taken off, robustly; stretches of the rest far above its scatter elsewhere are
flagged.
"""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex, Mask
from fitting.diagnosis.small_problem import SmallProblem
from fitting.identification.validation import rms
from fitting.laws import CoreLaw
from fitting.noise import groups_of

FEWEST = 60
"""Points of a curve below which a stretch of it says nothing."""
SIGMAS, LEAST = 7.0, 0.004
"""Above the scatter, and of the reading: a stretch is flagged beyond both."""
_A_KNOT = 0.45
"""In ln f: what a law's error may follow."""
_GROW, _GAP = 0.02, 0.06
"""In ln f: a stretch is taken a little wider; two that are nearer than that are one."""
_BETWEEN = 0.5
"""Of the narrower of two stretches, that is between them where they are lobes of one. A choice."""
_SHORTEST = 4
"""Points that are off together: fewer are outliers of another kind."""
_MOST = 0.5
"""Of a curve: what is off in more than that is not local."""
_MODULUS, _CHANNEL = 0.2, 0.01
"""How far modulus and channels may plausibly be off: what needs more of them is none of theirs."""
_HELD = 0.1
"""Weight of that beside the readings."""
_STEPS = 25
"""Of reweighting towards the least sum of sizes. A choice."""
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


def are_one(a_hz: tuple[float, float], b_hz: tuple[float, float]) -> bool:
    """Whether two stretches, by their ends, are one: they touch, or are lobes of one disturbance.

    Between its lobes that passes through nothing.
    """
    (low, high), (further, highest) = sorted(np.log([a_hz, b_hz]).tolist())
    return bool(further - high < max(_GAP, _BETWEEN * min(high - low, highest - further)))


def glitches(problem: SmallProblem, law: CoreLaw, v: Complex) -> tuple[Mask, tuple[Glitch, ...]]:
    """Points that a local disturbance spoils, of one shear pair's sweep, and the stretches they are in.

    `v` is what the fit predicts, m/s. Shape (points,).
    """
    sweep = problem.sweep
    aside, found = np.zeros(len(sweep), bool), list[Glitch]()
    if not sweep.has_phase:
        return aside, ()
    x = problem.rational.displacement(law.modulus(sweep.omega))
    feels = problem.feels(law, v)
    off = sweep.response_m_s / v - 1
    for group in groups_of(sweep):
        if len(group) < FEWEST:
            continue
        f = sweep.frequency_hz[group]
        rest = _rest(f, off[group], feels[group], np.abs(x[group]))
        scatter = float(np.median(np.abs(rest))) / _MEDIAN
        over = np.abs(rest) > max(SIGMAS * scatter, LEAST)
        for low, high in _stretches(f[over]):
            inside = (f >= low) & (f <= high)
            if np.sum(over & inside) < _SHORTEST:
                continue
            aside[group[inside]] = True
            off_by = np.abs(rest[inside])
            size = float(off_by.max()), rms(off_by)
            found.append(Glitch(float(f[inside].min()), float(f[inside].max()), *size))
        if aside[group].mean() > _MOST:
            aside[group] = False
            found = [g for g in found if not (f.min() <= g.low_hz <= f.max())]
    return aside, tuple(found)


def _rest(f: Array, off: Complex, feels: Complex, size: Array) -> Complex:
    """What is left of relative differences by least absolute residuals. Shape (points,)."""
    t = np.log(f)
    knots = np.linspace(t.min(), t.max(), max(3, int(np.ptp(t) / _A_KNOT) + 2))
    hats = np.maximum(0, 1 - np.abs(t[:, None] - knots) / (knots[1] - knots[0]))
    share = size / size.max()
    columns = [feels[:, None] * hats, np.ones((len(f), 1)), (1j * f / f.max())[:, None]]
    columns += [(feels * share)[:, None], (feels * share**2)[:, None]]
    A = np.hstack(columns)
    expected = np.array([*[_MODULUS] * len(knots), _CHANNEL, _CHANNEL, _MODULUS, _MODULUS])
    held = np.diag(np.sqrt(_HELD * LEAST * len(f)) / expected)
    rest = off
    weight = np.ones(len(f))
    for _ in range(_STEPS):
        rows = np.vstack([A * weight[:, None], held])
        coefficients = np.linalg.lstsq(rows, np.append(off * weight, np.zeros(len(held))), rcond=None)[0]
        rest = off - A @ coefficients
        weight = 1 / np.sqrt(np.maximum(np.abs(rest), 1e-4 * np.abs(off).max() + 1e-12))
    return np.asarray(rest)


def _stretches(f: Array) -> list[tuple[float, float]]:
    """Ranges that hold the frequencies, those close together in one, each a little wider."""
    if not len(f):
        return []
    f = np.sort(f)
    cuts = np.flatnonzero(np.diff(np.log(f)) > _GAP)
    first, last = np.concatenate([[0], cuts + 1]), np.concatenate([cuts, [len(f) - 1]])
    lobes = [(float(f[first[0]]), float(f[last[0]]))]
    for one in zip(f[first[1:]].tolist(), f[last[1:]].tolist(), strict=True):
        if are_one(lobes[-1], one):
            lobes[-1] = lobes[-1][0], one[1]
        else:
            lobes.append(one)
    return [(low * float(np.exp(-_GROW)), high * float(np.exp(_GROW))) for low, high in lobes]
