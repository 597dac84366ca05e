"""What a plate or another structure opposes to a motion at a frequency."""

import numpy as np

from fitting.arrays import Array, Complex

Matrices = tuple[Complex, Array, Array, Array]
"""K_0, K_1, M and C_1. Shape (k, k) each."""


def dynamic_stiffness(
    structure: Matrices, omega: Complex | Array, G: Complex, square: Complex | Array | None = None
) -> Complex:
    """K_0 + G K_1 + i w C_1 - w^2 M at every w, or with another `square` of it.

    Shape (omegas,) of `omega`, `G` and `square` to (omegas, k, k).
    """
    K_0, K_1, M, C_1 = structure
    squares = omega**2 if square is None else square
    factors = np.stack([np.ones_like(G), G, -squares, 1j * omega], axis=1)
    # One product: several times faster than sums of stacks of matrices.
    parts = np.stack([K_0, K_1, M, C_1]).astype(complex).reshape(4, -1)
    return np.asarray((factors @ parts).reshape(len(omega), *M.shape))
