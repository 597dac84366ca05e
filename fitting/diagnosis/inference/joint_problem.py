"""Residuals of readings, stated numbers, the law's bend and ties together, and their Jacobian."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex, Mask
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.response.response import Response
from fitting.diagnosis.response.unknowns import Unknowns
from fitting.effects.base import Effect
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.nuisances.sums import Kept

_APART = 1e-5
"""Of a column's size, what it must have of its own for its products to tell it from others: to 10^-6 then."""
_STEP = 1e-5
"""Of an unknown's size: what it is moved by to see what that changes of the bare plate. A choice."""


class JointProblem:
    """Residuals of everything that is known, and their Jacobian, at a law and unknowns in one vector `x`."""

    def __init__(
        self,
        response: Response,
        evidence: Evidence,
        law: CoreLaw,
        u: Array,
        points: Mask | None,
    ) -> None:
        self.response, self.law, self.u = response, law, np.asarray(u, float)
        self.points = points
        self.evidence = evidence if points is None else evidence.take(points)
        q = response.parameters
        self._z, self._n = len(response.nuisances), len(law.names)
        self.free = np.array([not x.fixed for x in q], dtype=bool)
        self.logarithmic = np.array([x.logarithmic for x in q], dtype=bool)
        self._seen: _Seen | None = None
        self._with_slopes: tuple[_Seen, Array] | None = None
        self._bare_shifts = Kept()

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

    def shortened(self, x: Array) -> Array:
        """Residuals turned, all together, so that only the first is not zero.

        Steps depend on products alone, so on any orthogonal turn of the rows. This one needs no Jacobian:
        none is made where a step is not taken. Infinite where a step leads to a structure that has no such
        modes, or less than no mass: it is then not taken. Shape (unknowns + 1 or fewer,).
        """
        try:
            r = self.residuals(x)
        except (OutsideModel, np.linalg.LinAlgError):
            if self._seen is None:
                raise
            return np.full(min(len(self._seen.r), len(x) + 1), np.inf)
        found = np.zeros(min(len(r), len(x) + 1))
        found[0] = np.linalg.norm(r)
        return found

    def condensed(self, x: Array) -> Array:
        """Jacobian in fewer rows, turned as `shortened` is: R of QR = [r J] without its first column.

        Each step decomposes it, which of a sweep's rows would take most of a long fit. Shape (unknowns + 1 or
        fewer, unknowns).
        """
        both = np.column_stack([self.residuals(x), self.jacobian(x)])
        R = _by_products(both)
        if R is None:
            R = np.asarray(np.linalg.qr(both, mode="r"), dtype=float)
        return -R[:, 1:] if R[0, 0] < 0 else R[:, 1:]

    def residuals(self, x: Array) -> Array:
        """Whitened, as `Refitted.residuals`. Shape (rows,)."""
        return self._at(x).r

    def jacobian(self, x: Array) -> Array:
        """Derivatives of `residuals` to the unknowns. Shape (residuals, unknowns)."""
        at = self._at(x)
        if self._with_slopes is None or self._with_slopes[0] is not at:
            J = self._jacobian(at.law, at.u, *self.response.with_derivatives(at.law, at.u))
            self._with_slopes = at, J
        return self._with_slopes[1]

    def _at(self, x: Array) -> "_Seen":
        """Kept: the latest, and the latest with derivatives, where a fit ends if no later step is taken."""
        key = x.tobytes()
        for known in (self._seen, self._with_slopes[0] if self._with_slopes else None):
            if known is not None and known.key == key:
                return known
        law, u = self._split(x)
        extra = self.response.derivatives_cost_extra
        both = None if extra else self.response.with_derivatives(law, u)
        v = both[0] if both else self.response.velocity(law, u)
        r = [self.evidence.residuals(v[self._part]), self._bare(u), u[: self._z]]
        r += [np.log(law.values[self._n - law.bend_count :]), law.breaches(), self._ties(u)]
        self._seen = _Seen(key, law, u, v, np.concatenate(r))
        if both:
            self._with_slopes = self._seen, self._jacobian(law, u, *both)
        return self._seen

    @cached_property
    def _each(self) -> list[tuple[Effect, slice]]:
        """Effects, and where the unknowns of each are among `u`."""
        effects = self.response.effects
        return list(zip(effects, Unknowns(self._z, effects).slices, strict=True))

    @property
    def _part(self) -> slice | Mask:
        return slice(None) if self.points is None else self.points

    def _jacobian(self, law: CoreLaw, u: Array, v: Complex, dv: Complex) -> Array:
        dv[self._n :][self.logarithmic] *= u[self.logarithmic][:, None]
        dv = dv[np.concatenate([np.ones(self._n, bool), self.free])]
        part = self._part
        rows = [self.evidence.jacobian(v[part], dv[:, part])]
        # Of the stated numbers, in standard deviations of their tolerances, and of the law's bend, whitened.
        known = np.eye(self._n + int(self.free.sum()))
        stated = known[self._n : self._n + self._z]
        bend = known[self._n - self.law.bend_count : self._n]
        by_logs = law.breaches_by_logs()
        breaches = np.hstack([by_logs, np.zeros((len(by_logs), len(known) - self._n))])
        return np.vstack([*rows, self._bare_by(u), stated, bend, breaches, self._ties_by()])

    def _bare(self, u: Array) -> Array:
        """Of the bare plate's frequencies, if there are any."""
        bare = self.evidence.bare
        if bare is None:
            return np.empty(0)
        # The same at every step along an effect's unknowns.
        z, nuisances = u[: self._z], self.response.nuisances
        expected = self._bare_shifts.get("shift", z, lambda: bare.stated_shift(nuisances, z))
        for e, part in self._each:
            expected = expected + e.bare_shift(bare, u[part])
        return -bare.whitened(expected)

    def _bare_by(self, u: Array) -> Array:
        bare, r = self.evidence.bare, self._bare(u)
        J = np.zeros((len(r), self._n + int(self.free.sum())))
        if bare is None:
            return J
        if self._z:
            by_z = bare.by_stated(self.response.nuisances, u[: self._z])
            J[:, self._n : self._n + self._z] = bare.whitened_change(by_z.T)
        for column, k in enumerate(np.flatnonzero(self.free)):
            if k < self._z:
                continue
            h = _STEP * (abs(u[k]) if self.logarithmic[k] else self.response.parameters[k].typical or 1.0)
            moved = u.copy()
            moved[k] += h
            slope = (self._bare(moved) - r) / h
            J[:, self._n + column] = slope * (u[k] if self.logarithmic[k] else 1.0)
        return J

    def _ties(self, u: Array) -> Array:
        """Of unknowns known beside others: their differences in standard deviations."""
        t, (first, other, sigma) = self._to_inner(u), self._tied
        return np.asarray((t[other] - t[first]) / sigma)

    def _ties_by(self) -> Array:
        column = self._n - 1 + np.cumsum(self.free)
        first, other, sigma = self._tied
        each = np.arange(len(sigma))
        J = np.zeros((len(sigma), self._n + int(self.free.sum())))
        J[each, column[first]], J[each, column[other]] = -1 / sigma, 1 / sigma
        return J

    @cached_property
    def _tied(self) -> tuple[NDArray[np.intp], NDArray[np.intp], Array]:
        """Places of both among `u`, and how near they are known to be. Shape (ties,) each."""
        first, other, sigma = list[int](), list[int](), list[float]()
        for e, part in self._each:
            for tie in e.ties:
                first.append(part.start + tie.first)
                other.append(part.start + tie.other)
                sigma.append(tie.sigma)
        return np.array(first, np.intp), np.array(other, np.intp), np.array(sigma)

    def fitted(self, x: Array) -> Refitted:
        """As a fit that ended there. `x` of shape (columns,)."""
        at = self._at(x)
        return Refitted(
            self.response.effects,
            at.law,
            at.u,
            at.v,
            at.r,
            self.jacobian(x),
            self.evidence.count,
            self.free,
            self._z,
            self.evidence.scale_known,
            least_scale=self.evidence.least_scale,
        )


def _by_products(A: Array) -> Array | None:
    """R of QR = A, square, from A^T A: a third of the time. None where a column is almost made of others.

    Stated numbers and bend have rows of their own, which keep columns apart.
    """
    products = A.T @ A
    if len(A) < len(products):
        return None
    try:
        R = np.asarray(np.linalg.cholesky(products).T)
    except np.linalg.LinAlgError:
        return None
    return R if np.all(np.diag(R) > _APART * np.sqrt(np.diag(products))) else None


@dataclass(frozen=True, eq=False)
class _Seen:
    """A place that was looked at."""

    key: bytes
    law: CoreLaw
    u: Array
    v: Complex
    """Phasors. Shape (points,)."""
    r: Array
    """Residuals. Shape (rows,)."""
