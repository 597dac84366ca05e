"""A basis of few motions for a solid: modes at several moduli of its core, and what steady forces stir."""

from collections.abc import Sequence

import numpy as np
import scipy.sparse as sp
from scipy.linalg import cholesky, solve_triangular
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from drivers.arrays import Array
from drivers.simulated.plant.law import MaxwellLaw

MODES = 10
MODULI = 5
_BAND = 2 * np.pi * np.geomspace(5.0, 2000.0, 40)
_ROOM = 3.0
"""The moduli reach so much beyond the law's over the band: softening, drift."""
_SMALLEST = 1e-12
"""Of the basis' vectors, relative, in kinetic energy: the slip of a thin core moves next to no mass."""


def moduli(law: MaxwellLaw) -> Array:
    """Real ones that enclose a law's over the band. Shape (moduli,)."""
    size = np.abs(law.modulus(_BAND))
    return np.geomspace(size.min() / _ROOM, size.max() * _ROOM, MODULI)


def motions(
    K: sp.csr_array, M: sp.csr_array, load: Array, modes: int = MODES, stirred: Sequence[sp.csr_array] = ()
) -> Array:
    """Modes, what `load` (n, loads) moves at rest, and what forces of `stirred` on the modes move.

    Each of unit kinetic energy. Shape (n, k).
    """
    options = {"SymmetricMode": True}
    lu = splu(K.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    solve = LinearOperator(K.shape, matvec=lu.solve, dtype=float)
    start = np.sin(np.arange(1, K.shape[0] + 1))
    _, phi = eigsh(K, modes, M, sigma=0.0, OPinv=solve, v0=start)
    forces = np.hstack([load, *(S @ phi for S in stirred)])
    X = np.hstack([phi, lu.solve(np.ascontiguousarray(forces))])
    return np.asarray(X / np.sqrt(np.einsum("ij,ij->j", X, M @ X)))


def basis_of(X: Array, M: sp.csr_array) -> Array:
    """What X spans, orthonormal in M. Shape (n, k)."""
    lam, u = np.linalg.eigh(X.T @ (M @ X))
    kept = lam > _SMALLEST * lam[-1]
    V = X @ (u[:, kept] / np.sqrt(lam[kept]))
    R = cholesky(V.T @ (M @ V))
    return np.asarray(solve_triangular(R, V.T, trans="T").T)
