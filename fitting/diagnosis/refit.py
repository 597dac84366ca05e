"""Law and unknowns of some effects fitted together: bounded least squares on whitened residuals."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares

from fitting.arrays import Array, Complex, Mask
from fitting.diagnosis.evidence import Evidence
from fitting.diagnosis.pace import Steps, is_within_reach
from fitting.diagnosis.response import SweepResponse
from fitting.effects.base import Effect
from fitting.identification.uncertainty import limits_reached
from fitting.laws import CoreLaw

_MOST_EVALUATIONS = 25
"""To compare; what has not come to its end by then says `converged = False`. A bound on time."""
_TO_REST_EVALUATIONS = 150
"""To report: a valley that winds (a law against a drift) takes 75. A bound on time."""
_ROUGH_EVALUATIONS = 10
"""To choose between starts. A choice: what a good one gains it gains soon."""
_BRIEF_EVALUATIONS = 3
"""Where little is to be gained: a look whether that is so."""
_NO_SLOPE, _DEPENDENT = 1e-300, 1e-6
"""Of columns of a Jacobian: one that is zero; the share below which a direction is made of the others."""
ROUGH, COMPARABLE, AT_REST = 1e-3, 1e-5, 1e-8
"""Relative change of chi-square and parameters at which a fit stops: to choose, to compare, and to report."""


@dataclass(frozen=True, eq=False)
class Refitted:
    """Where a fit of a law and some effects ended."""

    effects: tuple[Effect, ...]
    law: CoreLaw
    u: Array
    """The stated numbers, in standard deviations, then the effects' unknowns. Shape (unknowns,)."""
    velocity_m_s: Complex
    residuals: Array
    """Whitened; the bare plate's after the sweep's, then the stated numbers', the bend's, the ties'."""
    jacobian: Array
    """To the log parameters of the law, to the stated numbers and to the free unknowns as they are fitted."""
    data: int
    """How many of `residuals` are readings."""
    free: Array
    """Which of `u` are fitted. Shape of `u`, true or false."""
    stated: int
    """How many of `u` are stated numbers."""
    noise_known: bool
    iterations: int = 0
    evaluations: int = 0
    converged: bool = True
    pace: float = np.inf
    """Chi-square gained by the better one of the last two steps; infinite where there were too few."""

    @property
    def parameter_count(self) -> int:
        """How many numbers were fitted that nothing was known of: neither stated ones nor the law's bend."""
        return self.jacobian.shape[1] - self.stated - self.law.bend_count

    @property
    def chi2(self) -> float:
        """Sum of squares, priors counted in."""
        return float(self.residuals @ self.residuals)

    @property
    def chi2_per_dof(self) -> float:
        """Of the sweep alone."""
        dof = self.data - self.parameter_count
        return float(np.sum(self.residuals[: self.data] ** 2) / dof) if dof > 0 else float("nan")

    def of(self, effect: Effect) -> Array:
        """The unknowns of one of its effects. Shape (parameters,)."""
        start = self.stated + sum(len(e.parameters) for e in self.effects[: self.effects.index(effect)])
        return self.u[start : start + len(effect.parameters)]

    @property
    def z(self) -> Array:
        """The stated numbers, in standard deviations of their tolerances. Shape (numbers,)."""
        return self.u[: self.stated]

    @property
    def owed(self) -> float:
        """Chi-square that one more step would gain, were the residuals linear; none at the end of a fit."""
        J = self.jacobian[:, self._moving]
        J = J / np.maximum(np.linalg.norm(J, axis=0), _NO_SLOPE)
        step = np.linalg.lstsq(J, self.residuals, rcond=_DEPENDENT)[0]
        return float(np.sum((J @ step) ** 2))

    def may_reach(self, goal: float) -> bool:
        """Whether a chi-square is within all the steps that a fit may have, at the pace of the last ones."""
        return is_within_reach(self.chi2, goal, self.pace)

    @property
    def unexplained(self) -> float:
        """What the stated numbers had to be moved: their sum of squares."""
        return float(self.z @ self.z)

    @property
    def covariance(self) -> Array:
        """Of the fitted parameters, scaled by the residual: only upwards where the noise is known.

        A parameter of the law that sits at a limit is taken as fixed there; what the data leave open is
        bounded by the ranges that are searched. Shape (columns, columns) of `jacobian`.
        """
        J, kept = self.weighted()
        found = np.zeros((len(kept), len(kept)))
        if not kept.any():
            return found
        size = np.linalg.norm(J, axis=0)
        size = np.where(size > 0, size, 1.0)
        _, s, Vt = np.linalg.svd(J / size, full_matrices=False)
        root = Vt.T / np.maximum(s, 1e-12 * s.max()) / size[:, None]
        found[np.ix_(kept, kept)] = root @ root.T
        return found

    def weighted(self) -> tuple[Array, Mask]:
        """The Jacobian of what may move, its rows of unit variance, and which columns those are.

        Below the rows of `residuals` stand those of the ranges that are searched, one a parameter. Shapes
        (rows, kept) and (columns,).
        """
        chi2 = self.chi2_per_dof
        scale = chi2 if np.isfinite(chi2) else 1.0
        if self.noise_known:
            scale = max(1.0, scale)
        kept = self._moving
        J = self.jacobian[:, kept]
        # An unknown noise is the readings'; a misfit is everyone's.
        J[slice(None) if self.noise_known else slice(self.data)] /= np.sqrt(scale)
        widths = self.law.search_widths
        bounds = np.zeros((len(widths), self.jacobian.shape[1]))
        bounds[:, : len(widths)] = np.diag(1 / widths)
        return np.vstack([J, bounds[:, kept]]), kept

    @property
    def _moving(self) -> Mask:
        """Which columns are of what does not sit at a limit of the law."""
        fixed = limits_reached(self.law)
        others = self.jacobian.shape[1] - len(self.law.names)
        return np.array([name not in fixed for name in self.law.names] + [True] * others)


def refit(
    response: SweepResponse,
    evidence: Evidence,
    law: CoreLaw,
    u: Array,
    *,
    tolerance: float = COMPARABLE,
    points: Mask | None = None,
    brief: bool = False,
    goal: float = np.inf,
) -> Refitted:
    """The best law and unknowns from `law` and `u` on; `points` limits the sweep's points that count.

    Shapes: `u` as in `Refitted`, `points` (points,). `brief` where little is to be gained. Ends early where
    a chi-square of `goal` is out of reach (`Refitted.may_reach`).
    """
    problem = JointProblem(response, evidence, law, u, points)
    lower, upper = problem.limits
    steps = Steps(goal)
    found = least_squares(
        lambda x: problem.condensed(x)[:, -1],
        np.clip(problem.start, lower, upper),
        jac=lambda x: problem.condensed(x)[:, :-1],
        bounds=(lower, upper),
        x_scale="jac",
        xtol=tolerance,
        ftol=tolerance,
        gtol=1e-10,
        max_nfev=_BRIEF_EVALUATIONS if brief else _most(tolerance),
        callback=steps,
    )
    return replace(
        problem.fitted(found.x),
        iterations=int(found.njev),
        evaluations=int(found.nfev),
        converged=bool(found.status > 0),
        pace=steps.pace,
    )


def _most(tolerance: float) -> int:
    if tolerance >= ROUGH:
        return _ROUGH_EVALUATIONS
    return _MOST_EVALUATIONS if tolerance >= COMPARABLE else _TO_REST_EVALUATIONS


def kept(response: SweepResponse, evidence: Evidence, law: CoreLaw, u: Array) -> Refitted:
    """As `refit`, nothing moved. Shape of `u` as in `Refitted`."""
    problem = JointProblem(response, evidence, law, u, None)
    lower, upper = problem.limits
    return problem.fitted(np.clip(problem.start, lower, upper))


class JointProblem:
    """Residuals of everything that is known, and their Jacobian, at a law and unknowns in one vector `x`."""

    def __init__(
        self,
        response: SweepResponse,
        evidence: Evidence,
        law: CoreLaw,
        u: Array,
        points: Mask | None,
    ) -> None:
        self.response, self.law, self.u = response, law, np.asarray(u, float)
        self.points = points
        self.evidence = evidence if points is None else evidence.take(points)
        q = response.parameters
        self._z = len(response.nuisances)
        self.free = np.array([not x.fixed for x in q], dtype=bool)
        self.logarithmic = np.array([x.logarithmic for x in q], dtype=bool)
        self._last: tuple[bytes, Array, Array, Complex] | None = None
        self._condensed: tuple[bytes, Array] | None = None

    @property
    def _n(self) -> int:
        return len(self.law.names)

    def _to_inner(self, u: Array) -> Array:
        return np.where(self.logarithmic, np.log(np.where(self.logarithmic, u, 1.0)), u)

    def _to_outer(self, t: Array) -> Array:
        return np.where(self.logarithmic, np.exp(np.where(self.logarithmic, t, 0.0)), t)

    @property
    def start(self) -> Array:
        """Log parameters of the law, then the free unknowns. Shape (unknowns,)."""
        return np.concatenate([np.log(self.law.values), self._to_inner(self.u)[self.free]])

    @property
    def limits(self) -> tuple[Array, Array]:
        """Of `x`, lower and upper. Shape (unknowns,) each."""
        low, high = self.law.log_limits
        stated = self.response.parameters[: self._z]
        found = [
            (np.array([q.lower for q in stated]), np.array([q.upper for q in stated])),
            *(e.limits(self.response.plate) for e in self.response.effects),
        ]
        u_low, u_high = (self._to_inner(np.concatenate([f[k] for f in found]))[self.free] for k in (0, 1))
        return np.concatenate([low, u_low]), np.concatenate([high, u_high])

    def _split(self, x: Array) -> tuple[CoreLaw, Array]:
        t = self._to_inner(self.u)
        t[self.free] = x[self._n :]
        return self.law.with_logs(x[: self._n]), self._to_outer(t)

    def condensed(self, x: Array) -> Array:
        """Jacobian and residuals as fewer rows of the same products, which are all that a step depends on.

        R of QR = [J r]: each step decomposes it, which of a sweep's rows would take most of a long fit. Shape
        (unknowns + 1 or fewer, unknowns + 1).
        """
        key = x.tobytes()
        if self._condensed is None or self._condensed[0] != key:
            r, J, _ = self._both(x)
            found = np.asarray(np.linalg.qr(np.column_stack([J, r]), mode="r"), dtype=float)
            self._condensed = key, found
        return self._condensed[1]

    def residuals(self, x: Array) -> Array:
        """Whitened, as `Refitted.residuals`. Shape (rows,)."""
        return self._both(x)[0]

    def jacobian(self, x: Array) -> Array:
        """Of `residuals`. Shape (residuals, unknowns)."""
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
        rows += [self._prior(u), self._bend(law), self._ties(u)]
        r, J = np.concatenate([a for a, _ in rows]), np.vstack([b for _, b in rows])
        self._last = key, r, J, v
        return r, J, v

    def _bare(self, u: Array) -> tuple[Array, Array]:
        bare = self.evidence.bare
        assert bare is not None

        def rows(u: Array) -> Array:
            start, expected = self._z, bare.stated_shift(self.response.nuisances, u[: self._z])
            for e in self.response.effects:
                stop = start + len(e.parameters)
                expected = expected + e.bare_shift(bare, u[start:stop])
                start = stop
            return -bare.whitened(expected)

        r = rows(u)
        J = np.zeros((len(r), self._n + int(self.free.sum())))
        if self._z:
            by_z = bare.by_stated(self.response.nuisances, u[: self._z])
            J[:, self._n : self._n + self._z] = bare.whitened_change(by_z.T)
        for column, k in enumerate(np.flatnonzero(self.free)):
            if k < self._z:
                continue
            h = 1e-5 * (abs(u[k]) if self.logarithmic[k] else self.response.parameters[k].typical or 1.0)
            moved = u.copy()
            moved[k] += h
            slope = (rows(moved) - r) / h
            J[:, self._n + column] = slope * (u[k] if self.logarithmic[k] else 1.0)
        return r, J

    def _prior(self, u: Array) -> tuple[Array, Array]:
        """Of the stated numbers: each in standard deviations of its tolerance."""
        J = np.zeros((self._z, self._n + int(self.free.sum())))
        J[:, self._n : self._n + self._z] = np.eye(self._z)
        return u[: self._z], J

    def _bend(self, law: CoreLaw) -> tuple[Array, Array]:
        """Of the law's bend, whitened."""
        J = np.zeros((law.bend_count, self._n + int(self.free.sum())))
        J[:, self._n - law.bend_count : self._n] = np.eye(law.bend_count)
        return np.log(law.values[self._n - law.bend_count :]), J

    def _ties(self, u: Array) -> tuple[Array, Array]:
        """Of unknowns known beside others: their differences in standard deviations."""
        t, column = self._to_inner(u), self._n - 1 + np.cumsum(self.free)
        first, other, sigma = list[int](), list[int](), list[float]()
        start = self._z
        for e in self.response.effects:
            for tie in e.ties:
                first.append(start + tie.first)
                other.append(start + tie.other)
                sigma.append(tie.sigma)
            start += len(e.parameters)
        over, each = 1 / np.array(sigma), np.arange(len(sigma))
        J = np.zeros((len(sigma), self._n + int(self.free.sum())))
        J[each, column[first]], J[each, column[other]] = -over, over
        return (t[other] - t[first]) * over, J

    def fitted(self, x: Array) -> Refitted:
        """As a fit that ended there. `x` of shape (columns,)."""
        r, J, v = self._both(x)
        law, u = self._split(x)
        return Refitted(
            self.response.effects,
            law,
            u,
            v,
            r,
            J,
            self.evidence.count,
            self.free,
            self._z,
            self.evidence.scale_known,
        )
