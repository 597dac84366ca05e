"""What a law predicts at the points of a sweep, and how that changes with its parameters."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex, Mask
from fitting.laws import CoreLaw
from fitting.reduced.rational import RationalSweep
from fitting.specimen import Reading
from fitting.sweep import Sweep


def velocity(omega: Array, displacement: Complex, reads: Reading) -> Complex:
    """Velocity per base acceleration, in s: i omega x, and 1/(i omega) more where the reading is absolute.

    Shape (points,).
    """
    relative = 1j * omega * displacement
    return relative + 1 / (1j * omega) if reads == "absolute" else relative


@dataclass(frozen=True)
class SweepModel:
    """The plate's response at a sweep's points; several points may share a frequency."""

    rational: RationalSweep
    index: NDArray[np.intp]
    """Grid frequency of every point. Shape (points,)."""
    drive_amplitude: Array
    """Commanded: m/s^2 of the base, or newtons where a force drives. Shape (points,)."""
    reads: Reading
    at_rest: Mask | None = None
    """Points whose base does not move; None: that of all does. Shape (points,)."""

    @classmethod
    def of(cls, sweep: Sweep, rational: RationalSweep, reads: Reading) -> "SweepModel":
        """`rational` must hold every frequency of the sweep, ascending."""
        index = np.searchsorted(rational.omega, sweep.omega * (1 - 1e-12))
        return cls(rational, index, sweep.commanded_m_s2, reads)

    def velocity(self, law: CoreLaw) -> Complex:
        """Phasors in m/s. Shape (points,)."""
        return self.velocities(self.rational.displacement(law.modulus(self.rational.omega)))

    def velocities(self, displacement: Complex) -> Complex:
        """Phasors in m/s from displacements on the grid. Shapes (..., grid) to (..., points)."""
        omega = self.rational.omega
        v = velocity(omega, displacement, self.reads)[..., self.index]
        if self.at_rest is not None:
            v = np.where(self.at_rest, velocity(omega, displacement, "relative")[..., self.index], v)
        return np.asarray(v * self.drive_amplitude)

    def with_derivatives(self, law: CoreLaw) -> tuple[Complex, Complex]:
        """Phasors and their derivatives to the log parameters. Shapes (points,), (parameters, points)."""
        omega = self.rational.omega
        x, dx_dG = self.rational.with_derivative(law.modulus(omega))
        dG = law.jacobian(omega) * law.values[:, None]
        v = self.velocities(x)
        dv = (1j * omega * dx_dG * dG)[:, self.index] * self.drive_amplitude
        return v, dv

    def take(self, points: NDArray[np.intp] | NDArray[np.bool_]) -> "SweepModel":
        """The model at some of the points. Numbers or shape (points,), true or false."""
        used, index = np.unique(self.index[points], return_inverse=True)
        at_rest = None if self.at_rest is None else self.at_rest[points]
        return SweepModel(self.rational.at(used), index, self.drive_amplitude[points], self.reads, at_rest)
