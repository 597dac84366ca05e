"""Residuals of readings, stated numbers, the law's bend and ties together, and their Jacobian."""

import numpy as np

from fitting.arrays import Array, Complex, Mask
from fitting.diagnosis.evidence import Evidence
from fitting.diagnosis.refitted import Refitted
from fitting.diagnosis.response import SweepResponse
from fitting.laws import CoreLaw


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
        self._z, self._n = len(response.nuisances), len(law.names)
        self.free = np.array([not x.fixed for x in q], dtype=bool)
        self.logarithmic = np.array([x.logarithmic for x in q], dtype=bool)
        self._last: tuple[bytes, Array, Array, Complex] | None = None
        self._condensed: tuple[bytes, Array] | None = None

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
