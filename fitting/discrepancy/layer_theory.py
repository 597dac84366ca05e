"""The plate element's layer-wise theory for a wave of one wavenumber k, in closed form.

    u_b = k U_b sin kx,  u_c = k U_c sin kx,  w = W cos kx

The same strains and the same inertia as `fitting.plate.element`, x along k: three degrees of freedom, exact
on a simply supported plate; a fourth where the core shears its faces (`fitting.plate.face_shear`), the slip
k S sin kx. Taking k out of the in-plane motions leaves the stiffness as k^4 times a matrix of order one.
Source: the paper's Eq. (15) to (18).
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fitting.arrays import Array, Complex
from fitting.discrepancy.exact_layers import lowest
from fitting.plate.face_shear import slip_of
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face, as_isotropic

_STEPS = 30
"""A bound for Newton's method."""
_TOLERANCE = 1e-6
"""Last step of Newton in ln k, squared by the convergence."""
_W, _B, _C, _S = np.eye(4)
"""Deflection, stretch of the two faces, slip that the faces take: the unknowns of a wave."""


def layerwise_lambda(specimen: PlateSpecimen, k: ArrayLike, G: ArrayLike) -> Complex:
    """omega^2 in (rad/s)^2 of the plate at wavenumbers `k` in 1/m and core moduli `G` in Pa. Shape (n,)."""
    value, _ = _lambda_and_slope(specimen, np.atleast_1d(np.asarray(k, dtype=float)), np.asarray(G))
    return value


def wavenumber(specimen: PlateSpecimen, omega: ArrayLike, G: ArrayLike = 0.0) -> Array:
    """Wave in 1/m that resonates at `omega` in rad/s: k where sqrt(Re lambda(k, G)) = omega. Shape (n,)."""
    omega = np.atleast_1d(np.asarray(omega, dtype=float))
    s = specimen
    mass = sum(x.density_kg_m3 * x.thickness_m for x in (s.substrate, s.constraining, s.core) if x)
    rigidity = sum(_rigidity(x).real for x in (s.substrate, s.constraining) if x)
    # The uncoupled faces are softer than any core makes the plate: a k to begin with from above.
    log_k = np.log(omega**2 * mass / rigidity) / 4
    for _ in range(_STEPS):
        value, slope = _lambda_and_slope(s, np.exp(log_k), np.asarray(G))
        step = (np.log(value.real) - 2 * np.log(omega)) / slope
        log_k = log_k - np.clip(step, -1.0, 1.0)
        if np.abs(step).max() < _TOLERANCE:
            break
    return np.exp(log_k)


def _lambda_and_slope(specimen: PlateSpecimen, k: Array, G: NDArray[np.generic]) -> tuple[Complex, Array]:
    """lambda, and d ln Re lambda / d ln k at fixed G. Shape (n,) each."""
    K_0, K_shear, M_0, M_1 = _matrices(specimen, np.broadcast_to(G, k.shape).astype(complex))
    k_2 = (k**2)[:, None, None]
    M = M_0 + k_2 * M_1
    value, x = lowest(K_0 + K_shear / k_2, M)

    def form(A: Complex | Array) -> Complex:
        return np.asarray(np.einsum("ni,nij,nj->n", x, np.broadcast_to(A, M.shape), x))

    # First order: d lambda = x' (dK - lambda dM) x / x'Mx.
    change = -(form(K_shear) / k**2 + value * k**2 * form(M_1)) / form(M)
    slope = 2 * (2 * value + change).real / value.real
    return value * k**4, slope


def _rigidity(face: Face) -> complex:
    return _plane(face) * face.thickness_m**3 / 12


def _plane(face: Face) -> complex:
    """E/(1 - nu^2), complex with the face's loss factor."""
    face = as_isotropic(face)
    return face.young_pa * (1 + 1j * face.loss_factor) / (1 - face.poisson**2)


def _matrices(specimen: PlateSpecimen, G: Complex) -> tuple[Complex, Complex, Array, Array]:
    """K = K_0 + K_shear/k^2 and M = M_0 + k^2 M_1 over the unknowns.

    Shapes (n, 4, 4), then (4, 4); 3 where faces do not shear.
    """
    b, c, v = specimen.substrate, specimen.constraining, specimen.core
    K_0 = np.zeros((len(G), 4, 4), dtype=complex)
    K_shear = np.zeros_like(K_0)
    M_0, M_1 = np.zeros((2, 4, 4))
    sides = 2 if specimen.both_sides else 1
    slip = slip_of(specimen) if specimen.faces_shear else None
    turns = (slip.turn_b, slip.turn_c) if slip is not None else (0.0, 0.0)
    for face, row, times, turn in ((b, _B, 1, turns[0]), (c, _C, sides, turns[1])):
        # A bare plate keeps a degree of freedom that moves by itself.
        at = b if face is None else face
        K_0 += times * _plane(at) * at.thickness_m * np.outer(row, row)
        M_1 += times * at.density_kg_m3 * at.thickness_m * np.outer(row, row)
        if face is not None:
            K_0 += times * _rigidity(face) * np.outer(_W + turn * _S, _W + turn * _S)
            M_0 += times * face.density_kg_m3 * face.thickness_m * np.outer(_W, _W)
    if slip is not None:
        K_shear += slip.stiffness_pa_m * np.outer(_S, _S)
    if v is not None and c is not None:
        # In a plate treated alike on both sides the substrate's middle does not stretch.
        U_b = 0 * _B if specimen.both_sides else _B
        N_8 = _core_motion(b, c, U_b)
        stretch, shear = _core_stiffness(specimen, v, G, N_8, U_b)
        K_0 += stretch
        K_shear += shear
        M_0 += sides * v.density_kg_m3 * v.thickness_m * np.outer(_W, _W)
        M_0 += sides * v.glue_mass_kg_m2 * np.outer(_W, _W)
        M_1 += sides * v.density_kg_m3 * v.thickness_m * np.outer(N_8, N_8)
    moving = 4 if slip is not None else 3
    its = slice(moving)
    return K_0[:, its, its], K_shear[:, its, its], M_0[its, its], M_1[its, its]


def _core_stiffness(
    specimen: PlateSpecimen, v: Core, G: Complex, N_8: Array, U_b: Array
) -> tuple[Complex, Complex]:
    """The core's stretch and bending, a part of K_0, and its shear, one of K_shear. Shape (n, 4, 4) each."""
    H_v, sides = v.thickness_m, 2 if specimen.both_sides else 1
    plane = sides * (2 * G / (1 - v.poisson))[:, None, None]
    N_10 = (_C - U_b - specimen.apart_m * _W) / H_v
    if specimen.faces_shear:
        N_10 = N_10 - _S / H_v
    elif v.glue:
        # Of glue and core in series, as if all of it were the core's.
        G = G / (1 + G / (H_v * v.glue_stiffness_pa_m))
    stretch = plane * (H_v * np.outer(N_8, N_8) + H_v**3 / 12 * np.outer(_W, _W))
    shear = sides * G[:, None, None] * H_v * np.outer(N_10, N_10)
    return stretch, shear


def _core_motion(b: Face, c: Face, U_b: Array) -> Array:
    """N_8: the mean of the core's two interfaces, over the unknowns."""
    return np.asarray((_C + U_b - (c.thickness_m - b.thickness_m) / 2 * _W) / 2)
