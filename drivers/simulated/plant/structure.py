"""A linear viscoelastic structure: M q'' + C q' + (K + sum over branches of G_b* K_b) q = loads."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import cholesky, eigh, solve_triangular

from drivers.arrays import Array, Complex
from drivers.simulated.plant.law import MaxwellLaw
from drivers.simulated.plant.one_thread import one_thread


@dataclass(frozen=True)
class Branch:
    """A stiffness times a Maxwell law."""

    K: Array
    law: MaxwellLaw


@dataclass(frozen=True)
class Structure:
    """Matrices in one set of coordinates."""

    M: Array
    C: Array
    K: Array
    """Elastic, without the branches."""
    branches: tuple[Branch, ...]
    loads: Array
    """Force per unit of each input. Shape (n, inputs)."""
    readings: Array
    """Rows that read displacements. Shape (readings, n)."""

    def dynamic_stiffness(self, omega: float) -> Complex:
        """-w^2 M + i w C + K + sum of G* K_b. Shape (n, n)."""
        Z = self.K - omega**2 * self.M + 1j * omega * self.C
        for branch in self.branches:
            Z = Z + branch.law.modulus(omega) * branch.K
        return np.asarray(Z)

    def response(self, omega: float) -> Complex:
        """Displacements per unit of each input. Shape (n, inputs)."""
        return np.asarray(np.linalg.solve(self.dynamic_stiffness(omega), self.loads))

    def with_laws(self, *laws: MaxwellLaw) -> "Structure":
        """The structure with other laws in the first branches."""
        changed = tuple(replace(b, law=law) for b, law in zip(self.branches, laws, strict=False))
        return replace(self, branches=changed + self.branches[len(laws) :])

    def projected(self, V: Array) -> "Structure":
        """On the columns of V. Shape (n, m)."""
        branches = tuple(Branch(V.T @ b.K @ V, b.law) for b in self.branches)
        M, C, K = (V.T @ A @ V for A in (self.M, self.C, self.K))
        return Structure(M, C, K, branches, V.T @ self.loads, self.readings @ V)


def modal_damping(M: Array, K: Array, ratios: Array) -> Array:
    """C = M Phi diag(2 zeta_r w_r) Phi^T M over the first modes. Shape (n, n)."""
    lam, phi = eigh(K, M)
    U = M @ phi[:, : len(ratios)]
    return np.asarray((U * (2 * ratios * np.sqrt(lam[: len(ratios)]))) @ U.T)


@one_thread
def condensed(
    structure: Structure,
    laws: tuple[MaxwellLaw, ...],
    band_hz: tuple[float, float] = (4.0, 700.0),
    count: int = 90,
) -> tuple[Structure, Array]:
    """The structure on its responses over the band under each of `laws`, and the basis. M becomes one.

    The basis of shape (n, m).
    """
    snapshots = []
    for law in laws:
        under = structure.with_laws(law)
        for omega in 2 * np.pi * np.geomspace(*band_hz, count):
            X = under.response(omega)
            X = X[:, structure.loads.any(axis=0)]
            snapshots.append(X / np.sqrt(np.abs(np.einsum("ij,ij->j", X.conj(), structure.M @ X))))
    S = np.hstack(snapshots)
    S = np.hstack([S.real, S.imag])
    R = cholesky(structure.M)
    u, size, _ = np.linalg.svd(R @ S, full_matrices=False)
    V = solve_triangular(R, u[:, size > SMALLEST * size[0]])
    return structure.projected(V), V


SMALLEST = 3e-7
"""Of the singular values kept, to the largest."""


def first_order(structure: Structure) -> tuple[Array, Array, Array]:
    """State equation x' = A x + B f of a structure with M = 1, and the scale of x.

    Physical states: q, q', then for each branch and relaxing element z with tau z' = tau F^T q' - z, where
    K_b = F F^T. Scaled by `scale` the energy is |x|^2/2 and A is skew but for its losses: well conditioned.
    Returns A and B in scaled states and the matrix that scales physical states. Shapes (N, N), (N, inputs)
    and (N, N).
    """
    n = len(structure.M)
    relaxed = structure.K + sum((b.law.g_inf_pa * b.K for b in structure.branches), np.zeros((n, n)))
    elastic = cholesky(relaxed, lower=True)
    couplings, rates, roots = [elastic], [np.zeros(n)], [elastic.T]
    for branch in structure.branches:
        F = factor(branch.K)
        for g, tau in zip(branch.law.g_pa, branch.law.tau_s, strict=True):
            couplings.append(np.sqrt(g) * F)
            rates.append(np.full(F.shape[1], 1 / tau))
            roots.append(np.sqrt(g) * np.eye(F.shape[1]))
    inner = np.hstack(couplings)
    size = n + inner.shape[1]
    A = np.zeros((size, size))
    of_q, of_v, of_z = slice(0, n), slice(n, 2 * n), slice(2 * n, size)
    A[of_q, of_v], A[of_v, of_q] = elastic.T, -elastic
    A[of_v, of_v] = -structure.C
    A[of_z, of_v], A[of_v, of_z] = inner[:, n:].T, -inner[:, n:]
    A[of_z, of_z] = -np.diag(np.concatenate(rates)[n:])
    B = np.zeros((size, structure.loads.shape[1]))
    B[of_v] = structure.loads
    scale = np.zeros((size, size))
    scale[of_v, of_v] = np.eye(n)
    at = 0
    for k, root in enumerate(roots):
        here = of_q if k == 0 else slice(2 * n + at, 2 * n + at + len(root))
        at += 0 if k == 0 else len(root)
        scale[here, here] = root
    return A, B, scale


def factor(K: Array) -> Array:
    """F of K = F F^T, of the rank of K. Shape (n, rank)."""
    lam, u = eigh(K)
    kept = lam > 1e-13 * lam[-1]
    return np.asarray(u[:, kept] * np.sqrt(lam[kept]))
