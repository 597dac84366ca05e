"""Still air on a plate: the added mass of incompressible air on both faces, no baffle around the plate.

The air's potential is odd in z and jumps by psi across the plate, so at wavenumber k the plate's velocity is
w = -|k| psi / 2, and psi is zero beyond the edges. Galerkin, with psi = sum of c_i f_i over functions that
have the edges' square root, f = sqrt(1-s^2) U_m(s) sqrt(1-t^2) U_n(t) on half sides of one:

    N c = -C^T w,   N_ij = integral of f_i* f_j |k|/2 d^2k/(2 pi)^2,   C_i = integral of f_i on the plate
    M_air = rho C N^-1 C^T = rho L L^T,   the air's pressure jump being rho d(psi)/dt

The transform of sqrt(1-s^2) U_m(s) is (-i)^m pi (m+1) J_(m+1)(p)/p.
"""

from dataclasses import dataclass
from math import factorial

import numpy as np
import scipy.linalg as la
from scipy.special import jv

from fitting.arrays import Array
from fitting.dynamics.real_modes import RealModes
from fitting.plate.element import THETA_Y, W
from fitting.plate.plate import Plate

LONG_SIDE, SHORT_SIDE = 8, 6
"""Functions along the plate's sides: on aspect 1.5 the air's mass in each of ten modes to 0.2 %."""
_SMOOTH_FROM = 128.25 * np.pi
"""Beyond this p, J_mu J_nu is taken at its mean over an oscillation; cut where what is lost changes sign.

An error of 1e-5 in the energy with eight functions along a side, of 2e-4 with fourteen.
"""


@dataclass(frozen=True)
class StillAir:
    """The air's inertia for unit density, of rank r."""

    L: Array
    """M_air = rho L L^T over the plate's free degrees of freedom. Shape (n, r)."""
    heave: Array
    """L^T of all nodes, the held ones too, moving by w = 1. A base acceleration a loads the plate by
    -rho L heave a: the air feels the absolute motion. Shape (r,)."""
    pitch: Array
    """The same for a plate that turns about its root by w = x. Shape (r,)."""


def air_factor(plate: Plate) -> Array:
    """L of M_air = rho L L^T over the free degrees of freedom. Shape (n, r)."""
    return still_air(plate).L


def still_air(plate: Plate, counts: tuple[int, int] | None = None) -> StillAir:
    """The air around a plate. `counts` of functions along x and y, not above 14; by default 48 in all."""
    mesh = plate.mesh
    if counts is None:
        wide = mesh.width_m > mesh.length_m
        counts = (SHORT_SIDE, LONG_SIDE) if wide else (LONG_SIDE, SHORT_SIDE)
    N = _kinetic(mesh.length_m / 2, mesh.width_m / 2, counts)
    L = la.solve_triangular(la.cholesky(N, lower=True), _coupling(plate, counts).T, lower=True).T
    heave, pitch = np.zeros((2, mesh.nodes, mesh.dofs))
    heave[:, W] = 1.0
    pitch[:, W] = mesh.node_positions()[:, 0]
    pitch[:, THETA_Y] = -1.0
    return StillAir(L[plate.free], heave.ravel() @ L, pitch.ravel() @ L)


def air_lowering(plate: Plate, modes: RealModes, density_kg_m3: float) -> Array:
    """Relative fall of each natural frequency that the air brings: rho |L^T phi|^2 / 2.

    First order, with shapes normalised to the mass in vacuum. What is left out is 3/2 of its square: of
    one percent, 0.015 %.
    """
    carried = air_factor(plate).T @ modes.shapes
    return np.asarray(density_kg_m3 * (carried**2).sum(axis=0) / 2)


def _coupling(plate: Plate, counts: tuple[int, int]) -> Array:
    """C: each degree of freedom's deflection times f_i, integrated; held ones too. Shape (dofs nodes, r)."""
    mesh = plate.mesh
    a, b = mesh.sides_m
    shape = mesh.shape
    # An element's deflection is a polynomial: its coefficients are the derivatives at corner one.
    w = np.array(
        [
            [shape.deflection(0.0, 0.0, dx=p, dy=q) / (factorial(p) * factorial(q)) for q in range(4)]
            for p in range(4)
        ]
    )
    X, Y = _moments(a, mesh.n_x, counts[0]), _moments(b, mesh.n_y, counts[1])
    each = np.einsum("pqd,pim,qjn->ijdmn", w, X, Y, optimize=True)
    dofs = mesh.element_dofs()
    C = np.zeros((mesh.size, counts[0] * counts[1]))
    np.add.at(C, dofs, each.reshape(*dofs.shape, -1))
    return C


def _moments(step_m: float, elements: int, count: int) -> Array:
    """Integrals over each element of x^p sqrt(1-s^2) U_m(s), x from its first corner, p to 3.

    Shape (4, elements, count).
    """
    side = step_m * elements
    corners = step_m * np.arange(elements + 1)
    angle = np.arccos(np.clip(1 - 2 * corners / side, -1, 1))
    # With s = -cos(angle) nothing is singular at the edges: sqrt(1-s^2) U_m(s) = (-1)^m sin((m+1) angle).
    t, weight = np.polynomial.legendre.leggauss(8)
    half = np.diff(angle)[:, None] / 2
    theta = angle[:-1, None] + half * (t + 1)
    x = side * (1 - np.cos(theta)) / 2 - corners[:-1, None]
    dx = side * np.sin(theta) / 2 * half * weight
    m = np.arange(count)
    f = (-1.0) ** m * np.sin((m + 1) * theta[:, :, None])
    return np.einsum("peg,eg,egm->pem", x ** np.arange(4)[:, None, None], dx, f, optimize=True)


def _kinetic(a: float, b: float, counts: tuple[int, int]) -> Array:
    """N for half sides a and b in m, p = a k_x and q = b k_y. Shape (r, r)."""
    p, weight = _wavenumbers()
    k = np.hypot(p[:, None] / a, p / b)
    A, B = (_spectra(p, count) * weight for count in counts)
    # (a b)^2 of the transforms, 1/(a b) of d^2k; four quadrants alike.
    N = 4 * a * b * np.einsum("mMp,pq,nNq->mnMN", A, k / 2, B, optimize=True) / (2 * np.pi) ** 2
    r = counts[0] * counts[1]
    return np.asarray(N.reshape(r, r))


def _spectra(p: Array, count: int) -> Array:
    """Products of the transforms of two functions of s; zero for opposite parities, whose products are odd.

    Shape (count, count, points).
    """
    m = np.arange(count)
    apart = m[:, None] - m
    sign = np.where(apart % 2 == 0, (-1.0) ** (apart // 2), 0.0)[:, :, None]
    J = jv(m[:, None] + 1, np.minimum(p, _SMOOTH_FROM))
    # The mean of J_mu J_nu has the same sign, which squares.
    product = np.where(p < _SMOOTH_FROM, sign * J[:, None] * J, sign**2 / (np.pi * p))
    return np.asarray(np.pi**2 * np.outer(m + 1, m + 1)[:, :, None] * product / p**2)


def _wavenumbers() -> tuple[Array, Array]:
    """Quadrature over p > 0: graded to the origin, where |k| has its cone, even, and geometric far out."""
    near = np.r_[0.0, 2.0 ** np.arange(-8, 1)]
    even = np.linspace(1.0, _SMOOTH_FROM, 101)[1:]
    far = _SMOOTH_FROM * 4.0 ** np.arange(1, 13)
    edges = np.r_[near, even, far]
    t, weight = np.polynomial.legendre.leggauss(8)
    half = np.diff(edges)[:, None] / 2
    return (edges[:-1, None] + half * (t + 1)).ravel(), (half * weight).ravel()
