"""Law and unknowns of some effects fitted together: bounded least squares on whitened residuals."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from fitting.diagnosis.evidence import Evidence
from fitting.diagnosis.response import Response
from fitting.effects.base import Effect
from fitting.laws import CoreLaw

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Mask = NDArray[np.bool_]

_MOST_EVALUATIONS = 25
_ROUGH_EVALUATIONS = 10
ROUGH, GOOD = 1e-3, 1e-5
"""Relative change of chi-square and parameters at which a fit stops: to choose, and to compare."""


@dataclass(frozen=True, eq=False)
class Fitted:
    """Where a fit of a law and some effects ended."""

    effects: tuple[Effect, ...]
    law: CoreLaw
    u: Array
    velocity_m_s: Complex
    residuals: Array
    """Whitened; the bare plate's after the sweep's, then priors."""
    jacobian: Array
    """To the log parameters of the law and to the free unknowns as they are fitted."""
    data: int
    """How many of `residuals` are readings."""
    free: Array
    """Which of the unknowns are fitted. Shape (unknowns,), true or false."""
    noise_known: bool

    @property
    def parameters(self) -> int:
        """How many numbers were fitted."""
        return self.jacobian.shape[1]

    @property
    def chi2(self) -> float:
        """Sum of squares, priors counted in."""
        return float(self.residuals @ self.residuals)

    @property
    def chi2_per_dof(self) -> float:
        """Of the sweep alone."""
        dof = self.data - self.parameters
        return float(np.sum(self.residuals[: self.data] ** 2) / dof) if dof > 0 else float("nan")

    def of(self, effect: Effect) -> Array:
        """The unknowns of one of its effects."""
        start = sum(len(e.unknowns) for e in self.effects[: self.effects.index(effect)])
        return self.u[start : start + len(effect.unknowns)]

    @property
    def covariance(self) -> Array:
        """Of the fitted parameters, scaled by the residual: only upwards where the noise is known."""
        scale = np.linalg.norm(self.jacobian, axis=0)
        scale = np.where(scale > 0, scale, 1.0)
        _, s, Vt = np.linalg.svd(self.jacobian / scale, full_matrices=False)
        root = Vt.T / np.maximum(s, 1e-12 * s.max()) / scale[:, None]
        chi2 = self.chi2_per_dof
        if self.noise_known:
            chi2 = max(1.0, chi2)
        return np.asarray(root @ root.T * (chi2 if np.isfinite(chi2) else 1.0))


def refit(
    response: Response,
    evidence: Evidence,
    law: CoreLaw,
    u: Array,
    *,
    tolerance: float = GOOD,
    points: Mask | None = None,
    priors: Array | None = None,
) -> Fitted:
    """The best law and unknowns from `law` and `u` on; `points` limits the sweep's points that count."""
    problem = _Problem(response, evidence, law, u, points, priors)
    lower, upper = problem.limits
    found = least_squares(
        problem.residuals,
        np.clip(problem.start, lower, upper),
        jac=problem.jacobian,
        bounds=(lower, upper),
        x_scale="jac",
        xtol=tolerance,
        ftol=tolerance,
        gtol=1e-10,
        max_nfev=_ROUGH_EVALUATIONS if tolerance >= ROUGH else _MOST_EVALUATIONS,
    )
    return problem.fitted(found.x)


def kept(response: Response, evidence: Evidence, law: CoreLaw, u: Array, priors: Array) -> Fitted:
    """As `refit`, nothing moved."""
    problem = _Problem(response, evidence, law, u, None, priors)
    lower, upper = problem.limits
    return problem.fitted(np.clip(problem.start, lower, upper))


class _Problem:
    def __init__(
        self,
        response: Response,
        evidence: Evidence,
        law: CoreLaw,
        u: Array,
        points: Mask | None,
        priors: Array | None,
    ) -> None:
        self.response, self.law, self.u = response, law, np.asarray(u, float)
        self.points = points
        self.evidence = evidence if points is None else evidence.take(points)
        self.priors = np.full(len(self.u), np.inf) if priors is None else priors
        q = response.unknowns
        self.free = np.array([not x.fixed for x in q], dtype=bool)
        self.logarithmic = np.array([x.logarithmic for x in q], dtype=bool)
        self._last: tuple[bytes, Array, Array, Complex] | None = None

    @property
    def _n(self) -> int:
        return len(self.law.names)

    def _to_inner(self, u: Array) -> Array:
        return np.where(self.logarithmic, np.log(np.where(self.logarithmic, u, 1.0)), u)

    def _to_outer(self, t: Array) -> Array:
        return np.where(self.logarithmic, np.exp(np.where(self.logarithmic, t, 0.0)), t)

    @property
    def start(self) -> Array:
        return np.concatenate([np.log(self.law.values), self._to_inner(self.u)[self.free]])

    @property
    def limits(self) -> tuple[Array, Array]:
        low, high = self.law.log_limits
        found = [e.limits(self.response.plate) for e in self.response.effects]
        u_low, u_high = (
            self._to_inner(np.concatenate([np.empty(0), *(f[k] for f in found)]))[self.free] for k in (0, 1)
        )
        return np.concatenate([low, u_low]), np.concatenate([high, u_high])

    def _split(self, x: Array) -> tuple[CoreLaw, Array]:
        t = self._to_inner(self.u)
        t[self.free] = x[self._n :]
        return self.law.with_logs(x[: self._n]), self._to_outer(t)

    def residuals(self, x: Array) -> Array:
        return self._both(x)[0]

    def jacobian(self, x: Array) -> Array:
        return self._both(x)[1]

    def _both(self, x: Array) -> tuple[Array, Array, Complex]:
        key = x.tobytes()
        if self._last is not None and self._last[0] == key:
            return self._last[1:]
        law, u = self._split(x)
        v, dv = self.response.with_derivatives(law, u)
        dv[self._n :][self.logarithmic] *= u[self.logarithmic][:, None]
        dv = dv[np.concatenate([np.ones(self._n, bool), self.free])]
        part = slice(None) if self.points is None else self.points
        r, J = self.evidence.residuals(v[part]), self.evidence.jacobian(v[part], dv[:, part])
        rows = [(r, J)]
        if self.evidence.bare is not None:
            rows.append(self._bare(u))
        rows.append(self._prior(u))
        r, J = np.concatenate([a for a, _ in rows]), np.vstack([b for _, b in rows])
        self._last = key, r, J, v
        return r, J, v

    def _bare(self, u: Array) -> tuple[Array, Array]:
        bare = self.evidence.bare
        assert bare is not None

        def rows(u: Array) -> Array:
            start, expected = 0, np.zeros(len(bare.shift))
            for e in self.response.effects:
                stop = start + len(e.unknowns)
                expected = expected + e.bare_shift(bare.lowering_per_density, u[start:stop])
                start = stop
            return -bare.whitened(expected)

        r = rows(u)
        J = np.zeros((len(r), self._n + int(self.free.sum())))
        for column, k in enumerate(np.flatnonzero(self.free)):
            h = 1e-5 * (abs(u[k]) if self.logarithmic[k] else self.response.unknowns[k].typical or 1.0)
            moved = u.copy()
            moved[k] += h
            slope = (rows(moved) - r) / h
            J[:, self._n + column] = slope * (u[k] if self.logarithmic[k] else 1.0)
        return r, J

    def _prior(self, u: Array) -> tuple[Array, Array]:
        known = np.flatnonzero(self.free & np.isfinite(self.priors))
        neutral = np.array([self.response.unknowns[k].neutral for k in known], dtype=float)
        r = (u[known] - neutral) / self.priors[known]
        J = np.zeros((len(known), self._n + int(self.free.sum())))
        place = np.cumsum(self.free) - 1
        for row, k in enumerate(known):
            J[row, self._n + place[k]] = 1 / self.priors[k]
        return r, J

    def fitted(self, x: Array) -> Fitted:
        r, J, v = self._both(x)
        law, u = self._split(x)
        return Fitted(
            self.response.effects,
            law,
            u,
            v,
            r,
            J,
            self.evidence.count,
            self.free,
            self.evidence.scale_known,
        )
