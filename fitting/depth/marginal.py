"""The density of the law's own parameters, everything else integrated out.

For a law the rest is as good as Gaussian: stated numbers and bend answer a change of G* linearly. Where they
go is found from the exact change of the law's curve, which takes out the curvature that its parameters have
among themselves; there all residuals are evaluated once, and what they still ask of the
rest is projected out.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex, Mask
from fitting.depth.many import ManyResiduals
from fitting.depth.sweep_task import SweepTask


@dataclass(frozen=True)
class MarginalLaw:
    """`own` parameters of the law are sampled, the rest follows."""

    many: ManyResiduals

    @property
    def task(self) -> SweepTask:
        """The joint fit that is marginalised."""
        return self.many.task

    @cached_property
    def own(self) -> Mask:
        """Which of the unknowns that move are the law's parameters, its bend not counted. Shape (kept,)."""
        plain = np.arange(len(self.task.whole)) < len(self.task.law.plain.names)
        return np.asarray(plain[self.task.kept])

    @cached_property
    def _rest(self) -> tuple[Array, Array, Array]:
        """Step to the rest's best, an orthonormal base of what it moves, a root of its covariance."""
        J = self.task.jacobian(self.task.mode)[:, ~self.own]
        Q, R = np.linalg.qr(J)
        inverse = np.linalg.pinv(R, rcond=1e-12)
        return inverse @ Q.T, Q, inverse

    @cached_property
    def _at(self) -> tuple[Complex, Array, Complex]:
        """Modulus and residuals where the fit ended, and by how much the velocity changes with G*."""
        law, omega = self.task.law, self.task.begun.problem.sweep.omega
        return law.modulus(omega), self.many(self.task.mode[None])[0], self.many.by_modulus

    def __call__(self, T: Array) -> tuple[Array, Array]:
        """Log density, and where the rest is best. Shapes (any, own) to (any,), (any, rest)."""
        task, evidence = self.task, self.task.begun.evidence
        step, Q, _ = self._rest
        X = np.tile(task.mode, (len(T), 1))
        X[:, self.own] = T
        G, r, by_G = self._at
        n, omega = len(task.law.names), task.begun.problem.sweep.omega
        moved = task.law.moduli(task.full(X)[:, :n], omega) - G
        v = task.begun.none.velocity_m_s
        count = evidence.count
        change = evidence.whitening(evidence.over_sigma(v, by_G * moved).T).T / task.worth[:count]
        rest = task.mode[~self.own] - (r[:count] + change) @ step[:, :count].T - step[:, count:] @ r[count:]
        X[:, ~self.own] = rest
        found = self.many(X)
        along = found @ Q
        density = -0.5 * (np.sum(found**2, axis=1) - np.sum(along**2, axis=1))
        return density, rest - found @ step.T

    def drawn(self, T: Array, rest: Array, rng: np.random.Generator) -> tuple[Array, Array]:
        """All unknowns, the rest drawn about its best, and its log density. Shapes (any, kept), (any,)."""
        _, _, root = self._rest
        xi = rng.standard_normal(rest.shape)
        X = np.empty((len(T), len(self.own)))
        X[:, self.own], X[:, ~self.own] = T, rest + xi @ root.T
        return X, -0.5 * np.sum(xi**2, axis=1)
