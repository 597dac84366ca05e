"""What a plate or another structure opposes to a motion at a frequency."""

import numpy as np

from fitting.arrays import Array, Complex

Matrices = Complex
"""K_0, K_1, M and C_1, one after the other. Shape (4, k, k)."""


def stacked(K_0: Complex, K_1: Array, M: Array, C_1: Array) -> Matrices:
    """K_0, K_1, M and C_1 as one array, which is multiplied at once. Shape (k, k) each."""
    return np.array([K_0, K_1, M, C_1], dtype=complex)


def dynamic_stiffness(
    structure: Matrices, omega: Complex | Array, G: Complex, square: Complex | Array | None = None
) -> Complex:
    """K_0 + G K_1 + i w C_1 - w^2 M at every w, or with another `square` of it.

    Shape (omegas,) of `omega`, `G` and `square` to (omegas, k, k).
    """
    factors = np.empty((len(omega), 4), complex)
    factors[:, 0], factors[:, 1], factors[:, 3] = 1.0, G, 1j * omega
    factors[:, 2] = -(omega**2 if square is None else square)
    # One product: several times faster than sums of stacks of matrices.
    return np.asarray((factors @ structure.reshape(4, -1)).reshape(len(omega), *structure.shape[1:]))
