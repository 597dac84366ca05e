"""Readings that were made, on the grid of those that could be, and the joint fit so far."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls

from fitting.arrays import Array, Complex, Mask
from fitting.data.noise import Noise
from fitting.diagnosis.inference.evidence import BareModes, Evidence
from fitting.diagnosis.inference.refit import ROUGH, refit
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.several.responses import response_of
from fitting.laws import CoreLaw
from fitting.planning.sensitivity import ReadingNoise
from fitting.sweep import Sweep


@dataclass(frozen=True)
class Measured:
    """One reading a candidate, where there is one. Shape (candidates,) each."""

    response_m_s: Complex
    """Over the measured base, times the commanded one; anything where nothing was read."""
    std_m_s: Array
    """Standard deviation of each part of the reading."""
    taken: Mask


def on_grid(sweep: Sweep, frequency_hz: Array) -> Measured:
    """The points of a sweep on an ascending grid that has their frequencies. Shape (candidates,).

    Readings of one frequency are averaged by their noise.
    """
    at = np.searchsorted(frequency_hz, sweep.frequency_hz * (1 - 1e-12))
    std = sweep.response_std_m_s
    assert std is not None
    weight = np.bincount(at, 1 / std**2, len(frequency_hz))
    value = np.zeros(len(frequency_hz), complex)
    np.add.at(value, at, sweep.response_m_s / std**2)
    taken = weight > 0
    safe = np.where(taken, weight, 1.0)
    return Measured(np.where(taken, value / safe, 1.0), 1 / np.sqrt(safe), taken)


def fit_on_grid(
    problem: DiagnosisProblem,
    measured: Measured,
    errors: Complex,
    velocity_m_s: Complex,
    bare: BareModes | None,
    law: CoreLaw,
    z: Array,
) -> Refitted:
    """The joint fit of what was measured, from a law and stated numbers nearby.

    `errors` are the model's own, one standard deviation each, as changes of `velocity_m_s`. Shapes (any,
    candidates), (candidates,), `z` (stated numbers,).
    """
    kept = measured.taken
    v = np.where(kept, measured.response_m_s, velocity_m_s)
    sweep = Sweep(
        problem.sweep.frequency_hz,
        v,
        problem.sweep.commanded_m_s2,
        problem.sweep.segment,
        problem.sweep.sweep,
    )
    std = np.where(kept, measured.std_m_s, np.abs(velocity_m_s))
    evidence = Evidence.of(sweep, Noise(std, "stated"), errors, velocity_m_s, bare)
    return refit(response_of(problem, ()), evidence, law, z, tolerance=ROUGH, points=kept)


def noise_seen(velocity_m_s: Complex, std_m_s: Array, dwell_s: Array) -> ReadingNoise:
    """Floor and share that explain the noise of readings. Shapes (points,)."""
    columns = np.column_stack([1 / dwell_s, np.abs(velocity_m_s) ** 2])
    weight = 1 / std_m_s**2
    scale = np.abs(columns).max(axis=0)
    found, _ = nnls(columns / scale * weight[:, None], np.ones(len(weight)))
    floor, share = np.sqrt(found / scale)
    return ReadingNoise(float(floor), float(share))
