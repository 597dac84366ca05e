"""The modulus nearest to a law that explains a band's phasors: v is rational in G*, so there are several.

One complex unknown u a band, G(w) = G_law(w) exp(u). Newton's method from the law finds some root; starts
around the law find its rivals, if there are any.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex

VelocityOf = Callable[[Complex], tuple[Complex, Complex]]
"""G* at every point in Pa to v in m/s and dv/dG in m/(s Pa). Shape (points,) each."""

_REACH = 1.5
"""|ln(G/G_law)| at most: beyond, what was found has nothing to do with the law."""
_AS_NEAR = 2.0
"""A root is chosen for being this many times nearer to the law than the next one."""
APART = 3.0
"""Standard errors between two roots, at least: nearer ones, the linear error reaches across."""
_WORSE = 9.0
"""Chi-square by which a minimum is ruled out beside a better one."""
_MOST_STEPS = 40
"""A bound: a band that has not converged by then counts as without a root."""
_CONVERGED = 1e-3
"""Last step in standard errors."""
_LEAST_RADIUS = 0.3
"""|u| that starts lie around the law at, at least: however near the first root is. A choice."""
_RING = ((1.0, 8), (0.5, 4))
"""Shares of that radius, and how many starts lie evenly around the law at each. A choice."""
_SAME, _ROUNDING = 0.05, 1e-9
"""Standard errors, and a bit of u more, within which two starts have come to one root: fifty of their last
steps."""
_LONGEST = 0.5
"""|u| of one step, at most. A choice."""
_CUT = 4
"""By which a step that makes things worse is shortened, and the next lengthened after one that does not."""
_GIVEN_UP = 1e-6
"""Share of a whole step: where so little of it still makes things worse, nothing leads on."""


@dataclass(frozen=True)
class BandProblem:
    """Least squares in one complex unknown u a band."""

    velocity_of: VelocityOf
    G_law: Complex
    """Shape (points,), as the next three."""
    measured: Complex
    std: Array
    which: NDArray[np.intp]
    """Band of every point."""
    count: int
    """Bands."""

    @property
    def points(self) -> NDArray[np.intp]:
        """In each band. Shape (bands,)."""
        return np.bincount(self.which, minlength=self.count)

    def summed(self, x: Array) -> Array:
        """Over the points of each band. Shape (points,) to (bands,)."""
        return np.bincount(self.which, x, self.count).astype(float)

    def step(self, J: Complex, r: Complex) -> Complex:
        """What `r` at the points, over sigma, is worth in u: J^+ r. Shape (points,) to (bands,)."""
        Jr = J.conj() * r
        return np.asarray((self.summed(Jr.real) + 1j * self.summed(Jr.imag)) / self.summed(np.abs(J) ** 2))

    def sensitivity(self, u: Complex) -> Complex:
        """dv/du over sigma. Shape (bands,) to (points,)."""
        G = self.G_law * np.exp(u[self.which])
        return self.velocity_of(G)[1] * G / self.std

    def look(self, u: Complex) -> tuple[Array, Complex, Array]:
        """Chi-square, the Gauss-Newton step and its standard error. Shape (bands,) each."""
        G = self.G_law * np.exp(u[self.which])
        v, dv = self.velocity_of(G)
        J, r = dv * G / self.std, (v - self.measured) / self.std
        return self.summed(np.abs(r) ** 2), -self.step(J, r), self.summed(np.abs(J) ** 2) ** -0.5


@dataclass(frozen=True)
class BandMinima:
    """A minimum in each band. Shape (bands,) each."""

    u: Complex
    chi2: Array
    error: Array
    """Standard error of each part of u by the stated noise."""
    converged: NDArray[np.bool_]
    is_alone: NDArray[np.bool_]


def nearest_root(problem: BandProblem) -> BandMinima:
    """The root nearest to the law and whether it is the only one that near.

    Newton's method from the law itself finds some root; starts around the law, as far out as that
    root makes others matter, find the rest.
    """
    first = _newton(problem, np.zeros(problem.count, complex))
    far = np.maximum(_AS_NEAR * np.abs(first.u), np.abs(first.u) + APART * first.error)
    radius = np.where(first.converged, np.clip(far, _LEAST_RADIUS, _REACH), _REACH / 2)
    starts = [r * np.exp(2j * np.pi * (k + 0.5) / n) for r, n in _RING for k in range(n)]
    roots = [first, *(_newton(problem, radius * s) for s in starts)]
    u, chi2, error, converged = (
        np.array([getattr(r, name) for r in roots]) for name in ("u", "chi2", "error", "converged")
    )
    least = np.where(converged, chi2, np.inf).min(axis=0)
    slack = _WORSE * np.maximum(1, least / np.maximum(1, 2 * (problem.points - 1)))
    fits = converged & (np.abs(u) <= _REACH) & (chi2 <= least + slack)
    angle = np.angle(problem.G_law)[np.unique(problem.which, return_index=True)[1]] + u.imag
    fits &= np.abs(angle) < np.pi / 2
    distance = np.where(fits, np.abs(u), np.inf)
    nearest = distance.argmin(axis=0), np.arange(problem.count)
    best, its_error = u[nearest], error[nearest]
    apart = np.abs(u - best)
    near = (distance < _AS_NEAR * np.abs(best)) | (apart < APART * its_error)
    # A root that gives energy back is no rival: no core is so.
    passive = np.sin(angle) > -APART * error
    rival = fits & passive & near & (apart > _SAME * its_error + _ROUNDING)
    return BandMinima(best, chi2[nearest], its_error, fits[nearest], ~rival.any(axis=0))


def _newton(problem: BandProblem, u: Complex) -> BandMinima:
    """Gauss-Newton in every band at once; a step that makes things worse is cut."""
    with np.errstate(all="ignore"):
        chi2, step, error = problem.look(u)
        damping = np.ones(problem.count)
        for _ in range(_MOST_STEPS):
            done = np.abs(step) <= _CONVERGED * error
            lost = (damping < _GIVEN_UP) | (np.abs(u) > 2 * _REACH) | ~np.isfinite(step)
            if np.all(done | lost):
                break
            cut = np.minimum(damping, _LONGEST / np.abs(step))
            scored = np.where(done | lost, u, u + cut * step)
            looked = problem.look(scored)
            better = ~(done | lost) & (looked[0] <= chi2)
            u = np.where(better, scored, u)
            chi2, step, error = (
                np.where(better, new, old) for new, old in zip(looked, (chi2, step, error), strict=True)
            )
            damping = np.where(better, np.minimum(1, _CUT * damping), damping / _CUT)
        converged = np.abs(step) <= _CONVERGED * error
    return BandMinima(u, chi2, error, converged, np.ones(problem.count, bool))
