"""Residuals of the joint fit at many unknowns at once.

About where the fit ended the plate is moved to its stated numbers as found, and its response stays exact in
the law. What stated numbers change beyond that is taken to first order: as the change of the modulus that
does the same to the response, since both move the same poles, and the rest of it added. The channel's gain,
delay and phase are exact; the hammer test is linear.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex
from fitting.depth.sweep_task import SweepTask
from fitting.nuisances.moved_plate import moved_plate
from fitting.reduced.rational import RationalSweep, rational_sweep
from fitting.reduced.reduced_plate import ReducedPlate

_BLOCK = 64
"""Sets of unknowns worked out in one call: a choice between calls and memory."""
_DEAF = 0.05
"""Relative change of the response by one of the modulus, below which none stands in for a stated number."""

_H = 1e-6
"""Step of differences in a law's logarithms: moduli are good to 1e-15, their curvature is of order one."""


@dataclass(frozen=True)
class ManyResiduals:
    """Of one task; `reduced` is the plate as stated."""

    task: SweepTask
    reduced: ReducedPlate

    @cached_property
    def _plate(self) -> RationalSweep:
        problem, z = self.task.begun.problem, self.task.begun.none.z
        plate = self.reduced
        if len(z):
            plate = moved_plate(plate, problem.nuisances, self.task.begun.plate, z)
        return rational_sweep(plate, problem.sweep.omega)

    @cached_property
    def _stated(self) -> tuple[Complex, Complex]:
        """The modulus that stands in for a stated number's step, and the rest. Shape (stated, points)."""
        problem, none = self.task.begun.problem, self.task.begun.none
        n, omega = len(none.law.names), problem.sweep.omega
        _, dv = self.task.problem.response.with_derivatives(none.law, none.u)
        by = dv[n : n + none.stated].copy()
        for k in problem.nuisances.by_reading(none.velocity_m_s, omega, none.z):
            by[k] = 0.0
        by = by / self._channel(none.z[None])[0] / (1j * omega * problem.points.drive_amplitude)
        G = none.law.modulus(omega)
        x, slope = self._plate.with_derivative(G)
        deaf = _DEAF * np.abs(x / G)
        instead = by * np.conj(slope) / (np.abs(slope) ** 2 + deaf**2)
        return instead, by - instead * slope

    @cached_property
    def by_modulus(self) -> Complex:
        """Derivative of what is read to the modulus at the fit. Shape (points,)."""
        none, points = self.task.begun.none, self.task.begun.problem.points
        _, slope = self._plate.with_derivative(none.law.modulus(points.omega))
        read = self._channel(none.z[None])[0]
        return np.asarray(1j * points.omega * points.drive_amplitude * slope * read)

    def _channel(self, z: Array) -> Complex:
        """What the velocity channel makes of a velocity. Shapes (any, stated) to (any, points)."""
        problem = self.task.begun.problem
        return problem.nuisances.channel.factor(problem.sweep.omega, z)

    def velocity(self, X: Array) -> Complex:
        """Velocities as the sweep reads them, of many sets of unknowns.

        Shapes (any, kept) to (any, points).
        """
        whole, G, off = self._moved(X)
        x = self._plate.displacement(G + off @ self._stated[0]) + off @ self._stated[1]
        return self._read(x, whole)

    def _moved(self, X: Array) -> tuple[Array, Complex, Array]:
        """All unknowns, the law's moduli, and how far the stated numbers are off the fit's."""
        none = self.task.begun.none
        whole, n = self.task.full(X), len(none.law.names)
        G = none.law.moduli(whole[:, :n], self.task.begun.problem.points.omega)
        return whole, G, whole[:, n : n + none.stated] - none.z

    def _read(self, x: Complex, whole: Array) -> Complex:
        """What is read of displacements for a unit of drive. Shapes (any, points), (any, unknowns)."""
        points, none = self.task.begun.problem.points, self.task.begun.none
        n = len(none.law.names)
        v = 1j * points.omega * points.drive_amplitude * x
        return np.asarray((v + points.base_m_s) * self._channel(whole[:, n : n + none.stated]))

    def jacobians(self, X: Array) -> Array:
        """Derivatives of the rows. Shapes (any, kept) to (any, rows, kept)."""
        task, evidence = self.task, self.task.begun.evidence
        v, dv = self._with_derivatives(X)
        change = evidence.over_sigma(v[:, None], dv)[:, task.kept] * task.slope(X)[:, :, None]
        many, kept, count = change.shape
        readings = evidence.whitening(change.reshape(-1, count).T).T.reshape(many, kept, count)
        readings = (readings / task.worth[:count]).transpose(0, 2, 1)
        others = np.broadcast_to(self._others[1], (many, *self._others[1].shape))
        return np.concatenate([readings, others], axis=1)

    def _with_derivatives(self, X: Array) -> tuple[Complex, Complex]:
        """As read, and what all unknowns change of it. Shapes (any, points), (any, unknowns, points)."""
        problem, none = self.task.begun.problem, self.task.begun.none
        whole, G, off = self._moved(X)
        n, omega = len(none.law.names), problem.points.omega
        instead, rest = self._stated
        x, slope = self._plate.with_derivative(G + off @ instead)
        v = self._read(x + off @ rest, whole)
        z = whole[:, n : n + none.stated]
        drive = (1j * omega * problem.points.drive_amplitude) * self._channel(z)
        dv = np.zeros((*whole.shape, len(omega)), complex)
        for k in range(n):
            # Away from the upper limit, where a law stays within it.
            step = np.where(whole[:, k] < self.task.problem.limits[1][k] - _H, _H, -_H)
            near = whole[:, :n].copy()
            near[:, k] += step
            dv[:, k] = drive * slope * (none.law.moduli(near, omega) - G) / step[:, None]
        dv[:, n : n + none.stated] = drive[:, None] * (slope[:, None] * instead + rest)
        for j, by in problem.nuisances.by_reading(v, omega, z).items():
            dv[:, n + j] = by
        return v, dv

    def __call__(self, X: Array) -> Array:
        """Rows as `DepthTask.residuals` has them. Shapes (any, kept) to (any, rows)."""
        return np.concatenate([self._block(X[k : k + _BLOCK]) for k in range(0, len(X), _BLOCK)])

    def _block(self, X: Array) -> Array:
        task, evidence = self.task, self.task.begun.evidence
        v = self.velocity(X)
        data = evidence.readings.data(evidence.readings.off(v) / evidence.sigma_m_s)
        readings = evidence.whitening(data.T).T / task.worth[: evidence.count]
        at, J = self._others
        return np.hstack([readings, at + (X - task.mode) @ J.T])

    @cached_property
    def _others(self) -> tuple[Array, Array]:
        """Rows that are linear, at the fit, and their Jacobian."""
        count = self.task.begun.evidence.count
        return self.task.residuals(self.task.mode)[count:], self.task.jacobian(self.task.mode)[count:]
