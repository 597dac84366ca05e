"""Steady response of a reduced plate on a moving base, G* as the law has it. Phasors of e^{i w t}."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from campaign.plates.reduced import REFERENCE_MODULUS_PA, ReducedSolid
from drivers.simulated.plant.one_thread import one_thread
from fitting.arrays import Array, Complex

_CHUNK = 64
"""Points solved at once."""


def remaining_damping(plate: ReducedSolid, ratios: Array) -> Array:
    """C_1 = M Phi diag(2 zeta_r w_r) Phi^T M over the first modes at `REFERENCE_MODULUS_PA`. Shape (k, k)."""
    lam, phi = plate.modes(REFERENCE_MODULUS_PA, len(ratios))
    U = plate.M @ phi
    return np.asarray((U * (2 * ratios * np.sqrt(lam))) @ U.T)


@dataclass(frozen=True)
class BaseMotion:
    """How the base moves, per acceleration of its heave: pitch and roll about the middle of the root."""

    pitch_rad_m: Complex
    """Angular acceleration per acceleration at each point."""
    roll_rad_m: Complex

    @classmethod
    def pure(cls, points: int) -> "BaseMotion":
        """Heave alone."""
        return cls(np.zeros(points, complex), np.zeros(points, complex))

    def at(self, x_m: float, y_m: float, width_m: float) -> Complex:
        """Acceleration of the base's rigid motion at a point, per acceleration of its heave.

        Shape (points,).
        """
        return np.asarray(1 + x_m * self.pitch_rad_m + (y_m - width_m / 2) * self.roll_rad_m)

    @property
    def vector(self) -> Complex:
        """Heave, pitch, roll. Shape (points, 3)."""
        return np.stack([np.ones_like(self.pitch_rad_m), self.pitch_rad_m, self.roll_rad_m], axis=1)


@dataclass(frozen=True)
class Shaken:
    """A reduced plate at every point of a sweep."""

    plate: ReducedSolid
    C_1: Array
    omega: Array
    motion: BaseMotion
    attached: tuple[Array, Complex, Complex] | None = None
    """Rows that read the deflection where something hangs on, shape (places, k); its dynamic stiffness there,
    shape (places, points); and its force on the plate per base acceleration, same shape."""

    @cached_property
    def loads(self) -> Complex:
        """Force per acceleration of the base. Shape (points, k)."""
        loads = -(self.motion.vector @ self.plate.load.T)
        if self.attached is not None:
            loads = loads + self.attached[2].T @ self.attached[0]
        return np.asarray(loads)

    @one_thread
    def displacements(self, G: Complex, points: NDArray[np.intp] | None = None) -> Complex:
        """Relative motion q per acceleration of the base, at all or some points. Shape (points, k).

        `G` is the modulus of each group of the core there, shape (points, groups), or (points,) if alike.
        """
        p, at = self.plate, np.arange(len(self.omega)) if points is None else points
        K_1 = p.whole_core[None] if G.ndim == 1 else p.K_1
        G = G[:, None] if G.ndim == 1 else G
        flat = K_1.reshape(len(K_1), -1)
        out = np.empty((len(at), len(p.M)), complex)
        for first in range(0, len(at), _CHUNK):
            now = at[first : first + _CHUNK]
            w, g = self.omega[now, None, None], G[first : first + _CHUNK]
            core = (g.real @ flat + 1j * (g.imag @ flat)).reshape(len(now), *p.M.shape)
            Z = p.K_0 + 1j * p.rubbing - w**2 * p.M + 1j * w * self.C_1 + core
            if self.attached is not None:
                rows, stiffness, _ = self.attached
                Z = Z + np.einsum("ap,ai,aj->pij", stiffness[:, now], rows, rows)
            out[first : first + _CHUNK] = np.linalg.solve(Z, self.loads[now, :, None])[:, :, 0]
        return out
