"""Moduli at which a small structure would resonate without bound, at every frequency by itself.

    |det(A_0 + G K_1) / det A_0| = prod |1 + G l_j|,   l_j of A_0^-1 K_1,   A_0 = K_0 + i w C_1 - w^2 M

Times that, a motion is a polynomial in the modulus of the core: adj(A) times the load. That goes as
G^(rank of K_1 - 1), which is divided out.
"""

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.plate_answer import Asked
from fitting.dynamics.dynamic_stiffness import dynamic_stiffness
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate

_RIGID = 1e-12
"""Of the largest compliance: below it the core does not shear, and a power of its modulus is missing."""


def compliances(plate: EnrichedReducedPlate, change: Change, omega: Array) -> Complex:
    """l_j of a plate as something changes it, in 1/Pa. Shape (points,) of `omega`, rad/s, to (points, k)."""
    nothing = np.zeros(len(omega), complex)
    matrices = Asked(plate, omega, nothing, change, None, with_pitch=False).matrices
    A_0 = dynamic_stiffness(matrices, omega, nothing)
    return np.asarray(np.linalg.eigvals(np.linalg.solve(A_0, np.broadcast_to(matrices[1], A_0.shape))))


def away_from_poles(by_G: Complex, G: Complex) -> Array:
    """The determinant over all powers of the modulus but one: 1/G where inertia does not count.

    Shapes (points, k) and (..., points) in Pa, to (..., points).
    """
    share = np.abs(by_G * G[..., None])
    sheared = share > _RIGID * share.max(axis=-1, keepdims=True)
    each = np.abs(1 + by_G * G[..., None]) / np.where(sheared, share, 1.0)
    return np.asarray(each.prod(axis=-1) * np.abs(G))
