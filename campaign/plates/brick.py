"""Quadratic bricks of 27 nodes on a tensor grid: integrals are products of integrals along the axes.

    K_(a i)(b j) = sum over k, l of C_ikjl int dN_a/dx_k dN_b/dx_l

Node (p, q, r) of a brick has number 9 p + 3 q + r; degree of freedom 3 node + axis. A thin brick locks in
transverse shear: dw/dx is linear along x, du/dz quadratic. So the shear strain xz is taken at two Gauss
points along x, yz at two along y (assumed strain as in MITC9, Bucalem and Bathe 1993); the limit is the same
solid.
"""

import numpy as np

from fitting.arrays import Array

_MASS = np.array([[4, 2, -1], [2, 16, 2], [-1, 2, 4]]) / 30
_STIFFNESS = np.array([[7, -8, 1], [-8, 16, -8], [1, -8, 7]]) / 3
_MIXED = np.array([[-3, -4, 1], [4, 0, -4], [-1, 4, 3]]) / 6
"""int dN_a N_b, of a brick's side one long."""
_TWO_POINTS = np.array([[1, 1, -0.5], [1, 4, 1], [-0.5, 1, 1]]) / 9
"""_MASS by two Gauss points: all that the assumed strain changes."""


def isotropic(lame_pa: float, shear_pa: float) -> Array:
    """C_ikjl of an isotropic solid. Shape (3, 3, 3, 3)."""
    one = np.eye(3)
    return np.asarray(
        lame_pa * np.einsum("ik,jl->ikjl", one, one)
        + shear_pa * (np.einsum("ij,kl->ikjl", one, one) + np.einsum("il,kj->ikjl", one, one))
    )


def metal(young_pa: float, poisson: float, rolled: float = 0.0) -> Array:
    """C_ikjl of a metal, its Young's modulus (1 + rolled/2) along x and (1 - rolled/2) along y, in Pa.

    Shape (3, 3, 3, 3).
    """
    if not rolled:
        shear = young_pa / (2 * (1 + poisson))
        return isotropic(2 * shear * poisson / (1 - 2 * poisson), shear)
    E = young_pa * np.array([1 + rolled / 2, 1 - rolled / 2, 1.0])
    S = np.diag(1 / E)
    for i, j in ((0, 1), (0, 2), (1, 2)):
        # nu_ij / E_i = nu_ji / E_j, the stated ratio their geometric mean.
        S[i, j] = S[j, i] = -poisson / np.sqrt(E[i] * E[j])
    normal, C = np.linalg.inv(S), np.zeros((3, 3, 3, 3))
    for i in range(3):
        for j in range(3):
            C[i, i, j, j] = normal[i, j]
            if i != j:
                shear = np.sqrt(E[i] * E[j]) / (2 * (1 + poisson))
                C[i, j, i, j] += shear
                C[i, j, j, i] += shear
    return C


def unit_core(poisson: float) -> Array:
    """C_ikjl of a core whose shear modulus is one. Shape (3, 3, 3, 3)."""
    return isotropic(2 * poisson / (1 - 2 * poisson), 1.0)


def stiffness(x: Array, y: Array, thickness_m: float, C: Array) -> Array:
    """Of the bricks between grid lines x and y. Shape (columns x, columns y, 81, 81)."""
    h = (np.diff(x), np.diff(y), np.array([thickness_m]))
    shape = (len(h[0]), len(h[1]))
    out = np.zeros((*shape, 27, 3, 27, 3))
    for k in range(3):
        for m in range(3):
            part = C[:, k, :, m]
            if not part.any():
                continue
            along = [_line(h[axis], axis == k, axis == m) for axis in range(3)]
            if k == m == 2:
                for axis in range(2):
                    assumed = list(along)
                    assumed[axis] = _TWO_POINTS * h[axis][:, None, None]
                    out[:, :, :, axis, :, axis] += part[axis, axis] * _product(assumed)
                out[:, :, :, 2, :, 2] += part[2, 2] * _product(along)
            else:
                out += _product(along)[:, :, :, None, :, None] * part[:, None, :]
    return out.reshape(*shape, 81, 81)


def _product(along: list[Array]) -> Array:
    """Of integrals along the axes. Shape (columns x, columns y, 27, 27)."""
    integral = np.einsum("pac,qbd,ref->pqabecdf", *along)
    return integral.reshape(*integral.shape[:2], 27, 27)


def _line(sizes: Array, first: bool, second: bool) -> Array:
    """Integrals along one axis, the first or the second factor derived. Shape (bricks, 3, 3)."""
    if first and second:
        return np.asarray(_STIFFNESS / sizes[:, None, None])
    if first or second:
        return np.broadcast_to(_MIXED if first else _MIXED.T, (len(sizes), 3, 3))
    return np.asarray(_MASS * sizes[:, None, None])


def mass(x: Array, y: Array, thickness_m: float, density_kg_m3: float) -> Array:
    """Shape (columns x, columns y, 81, 81)."""
    h = (np.diff(x), np.diff(y), np.array([thickness_m]))
    along = [_line(size, False, False) for size in h]
    out = density_kg_m3 * np.einsum("pqab,ij->pqaibj", _product(along), np.eye(3))
    return out.reshape(len(h[0]), len(h[1]), 81, 81)
