"""How readings at candidate frequencies move with everything that is not known, over their noise.

The posterior of any choice of readings follows without another look at the plate:

    C = (P + sum of a_i^T a_i)^-1

a_i are the two rows of one phasor: derivatives to the law's log parameters, its bend, the stated numbers
and the model's own errors, each in its units of the joint inference (`fitting.diagnosis.inference.begin`),
over the reading's standard deviation. P holds what is known without any reading: the ranges that are
searched, the bend's and the tolerances' priors, the hammer test. Linear about a law and stated numbers: an
error of the law is one of this matrix too.
"""

from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.inference.evidence import BareModes
from fitting.diagnosis.inference.whitening import SHARE
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.model_error import model_error
from fitting.diagnosis.several.responses import response_of
from fitting.laws import CoreLaw
from fitting.laws.bent_law import BentLaw
from fitting.reduced.reduced_plate import ReducedPlate


@dataclass(frozen=True)
class ReadingNoise:
    """What scatters one reading: a floor that a longer dwell lowers, and a share of the reading."""

    floor_m_s: float
    """Standard deviation of each part of a phasor of velocity, read over one second."""
    share: float
    """Of the reading, each part: what repeats do not agree in."""

    def std_m_s(self, velocity_m_s: Complex | Array, dwell_s: Array) -> Array:
        """Standard deviation of each part of a reading. Shape (points,)."""
        return np.asarray(
            np.hypot(self.floor_m_s / np.sqrt(dwell_s), self.share * np.abs(velocity_m_s)), dtype=float
        )


@dataclass(frozen=True)
class Sensitivity:
    """Of all candidates about one law."""

    law: CoreLaw
    """With its bend."""
    velocity_m_s: Complex
    """Expected. Shape (candidates,)."""
    sigma_m_s: Array
    """Noise of each part and the white part of the model's error. Shape (candidates,)."""
    rows: Array
    """Shape (candidates, 2, unknowns)."""
    prior: Array
    """P. Shape (unknowns, unknowns)."""
    stated: int
    """How many of the unknowns, behind the law's, are stated numbers; the model's errors come last."""

    @property
    def of_law(self) -> int:
        """How many of the unknowns are the law's."""
        return len(self.law.names)

    def precision(self, taken: Array) -> Array:
        """C^-1 with so many readings at each candidate. Shape (unknowns, unknowns)."""
        kept = np.flatnonzero(taken)
        A = (self.rows[kept] * np.sqrt(taken[kept])[:, None, None]).reshape(-1, len(self.prior))
        return np.asarray(self.prior + A.T @ A)

    def covariance(self, taken: Array) -> Array:
        """C. Shape (unknowns, unknowns)."""
        return np.asarray(np.linalg.inv(self.precision(taken)))

    def with_noise(self, std_m_s: Array) -> "Sensitivity":
        """The same readings, each part with another noise. Shape (candidates,)."""
        sigma = sigma_of(std_m_s, self.velocity_m_s)
        rows = self.rows * (self.sigma_m_s / sigma)[:, None, None]
        return replace(self, sigma_m_s=sigma, rows=rows)


def sigma_of(std_m_s: Array, velocity_m_s: Complex) -> Array:
    """Noise, and what the model leaves white, as the joint fit has them. Shape (points,)."""
    return np.asarray(np.hypot(std_m_s, SHARE * np.abs(velocity_m_s)))


def sensitivity(
    problem: DiagnosisProblem,
    reduced: ReducedPlate,
    law: CoreLaw,
    *,
    z: Array,
    noise: ReadingNoise | Array,
    dwell_s: Array,
    bare: BareModes | None = None,
    errors: Complex | None = None,
) -> Sensitivity:
    """At every point of `problem`, whose segments are the candidates' regions.

    `noise` as a model, or each reading's; `errors` are the changes of the velocity by what the model gets
    wrong, one standard deviation each, where they are known. Shapes (points,), `errors` (any, points).
    """
    v, dv = response_of(problem, ()).with_derivatives(law, z)
    if errors is None:
        errors = model_error(problem, reduced, law, v)
    std = noise.std_m_s(v, dwell_s) if isinstance(noise, ReadingNoise) else noise
    sigma = sigma_of(std, v)
    every = np.concatenate([dv, errors]) / sigma
    rows = np.stack([every.real, every.imag], axis=0).transpose(2, 0, 1)
    n, stated = len(law.names), len(problem.nuisances)
    prior = np.zeros(len(every))
    widths = law.search_widths
    prior[: len(widths)] = 1 / widths**2
    prior[len(widths) :] = 1.0
    P = np.diag(prior)
    if bare is not None and stated:
        J = bare.whitened_change(bare.by_stated(problem.nuisances, z).T)
        P[n : n + stated, n : n + stated] += J.T @ J
    return Sensitivity(law, v, sigma, np.ascontiguousarray(rows), P, stated)


def bent(law: CoreLaw, problem: DiagnosisProblem) -> CoreLaw:
    """The law as the joint fit has it: free to bend, unless everything stated is exact."""
    if problem.specimen.exact:
        return law.lifted()
    return BentLaw.over(law.lifted(), problem.sweep.frequency_hz, problem.freedom)
