"""Exact elasticity of a stack of isotropic layers bending with an in-plane wavenumber k.

    u = U(z) sin kx,  w = W(z) cos kx;  both outer faces free of traction, all layers bonded

A simply supported plate of isotropic layers bends in such waves, k^2 = (m pi/a)^2 + (n pi/b)^2: its exact
modes are this plane-strain problem, x along k. Polynomials of high order through each layer's thickness
make it a small eigenvalue problem. With kappa = k h and zeta = z/h, h the stack's thickness,

    U = h kappa (zeta W_0 + V(zeta)),  W = h (W_0 + kappa^2 Y(zeta)),  Y(0) = 0

takes the common factor kappa^4 of thin-plate bending out of the stiffness. The unknowns are W_0, V(0) and
V', Y' as Legendre series, so that no strain is a difference of displacements: nothing cancels, however thin
the plate.

Source: N.J. Pagano, Exact solutions for rectangular bidirectional composites and sandwich plates,
J. Compos. Mater. 4 (1970) 20-34, for the problem; displacements and variational form are standard.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from fitting.arrays import Array, Complex

ORDER = 7
"""Order of the polynomials in each layer: omega^2 to rounding in thin ones, to 1e-6 where a layer holds half
a wavelength of shear."""
_RIGID = 1e4
"""How much stiffer than it is a layer becomes where a deformation is ruled out."""
TOLERANCE = 1e-8
"""Change of lambda from the last step: each step leaves a small part of the error of the one before."""
_STEPS = 12
"""Of inverse iteration for all at once; branches that are not apart by then are taken by all eigenvalues."""


@dataclass(frozen=True)
class ElasticLayer:
    """One layer. The three switches rule out, one by one, what a plate theory leaves out.

    Attributes
    ----------
    shear_pa
        Shear modulus, complex where it loses energy; a number or one for each wavenumber.
    stretches
        Whether its thickness may change; if not, it is in plane stress and W is constant in it.
    shears
        Whether it may shear across its thickness.
    turns
        Whether its rotation has inertia about its own mid-plane.
    """

    thickness_m: float
    shear_pa: ArrayLike
    poisson: float
    density_kg_m3: float
    stretches: bool = True
    shears: bool = True
    turns: bool = True


def exact_lambda(layers: tuple[ElasticLayer, ...], k: ArrayLike, order: int = ORDER) -> Complex:
    """omega^2 of the lowest bending branch, the moduli held fixed.

    Parameters
    ----------
    layers
        From the lowest to the uppermost.
    k
        Wavenumbers in 1/m, shape (n,).
    order
        Of U within a layer, W's is one less.

    Returns
    -------
    lambda = omega^2 in (rad/s)^2, shape (n,); its loss factor is Im/Re.
    """
    k = np.atleast_1d(np.asarray(k, dtype=float))
    h = sum(layer.thickness_m for layer in layers)
    kappa = k * h
    forms = _forms(tuple(layer.thickness_m / h for layer in layers), tuple(x.turns for x in layers), order)
    coefficients = np.concatenate([_stiffnesses(layer, kappa) for layer in layers])
    densities = np.array([layer.density_kg_m3 for layer in layers])
    N = forms.size
    K = np.asarray(coefficients.T @ forms.stiffness, dtype=complex).reshape(-1, N, N)
    powers = kappa ** np.array([[0], [2], [4]])
    M = np.tensordot(powers.T, np.tensordot(densities, forms.mass, 1), 1)
    value, _ = lowest(K, M)
    return value * kappa**4 / h**2


def lowest(K: Complex, M: Array) -> tuple[Complex, Complex]:
    """The eigenvalue of K x = lambda M x of least modulus, and its vector: K, M complex symmetric.

    Inverse iteration from the first degree of freedom, the common deflection: the other branches of a thin
    stack lie far above. Shapes (n, N, N) twice; returns (n,) and (n, N).
    """
    n, N = K.shape[:2]
    x = np.zeros((n, N), dtype=complex)
    x[:, 0] = 1.0
    value = np.zeros(n, dtype=complex)
    left = np.arange(n)
    Mx = M[:, :, 0].astype(complex)
    for _ in range(_STEPS):
        y = np.linalg.solve(K[left], Mx[..., None])[..., 0]
        My = np.einsum("nij,nj->ni", M[left], y)
        # K y = M x gives the quotient y'Ky / y'My without a product with K.
        new = np.sum(y * Mx, axis=1) / np.sum(y * My, axis=1)
        done = np.abs(new - value[left]) <= TOLERANCE * np.abs(new)
        scale = y[:, :1]
        value[left], x[left] = new, y / scale
        left, Mx = left[~done], (My / scale)[~done]
        if not left.size:
            return value, x
    # Two branches close together, as those of faces hardly coupled: all eigenvalues at once.
    inverse, vectors = np.linalg.eig(np.linalg.solve(K[left], M[left].astype(complex)))
    first = np.argmax(np.abs(inverse), axis=1)
    rows = np.arange(left.size)
    value[left] = 1 / inverse[rows, first]
    x[left] = vectors[rows, :, first]
    return value, x


def _stiffnesses(layer: ElasticLayer, kappa: Array) -> Complex:
    """C_11, C_33, C_13 and C_55 with its powers of kappa, in the order of `_layer_forms`. Shape (6, n)."""
    G = np.broadcast_to(np.asarray(layer.shear_pa, dtype=complex), kappa.shape)
    nu = layer.poisson
    C_33 = 2 * G * (1 - nu) / (1 - 2 * nu)
    C_11, C_13, C_55 = C_33, 2 * G * nu / (1 - 2 * nu), G
    if not layer.stretches:
        C_11, C_33, C_13 = 2 * G / (1 - nu), _RIGID * C_33, 0 * G
    if not layer.shears:
        C_55 = _RIGID * G
    return np.array([C_11, C_33, C_13, C_55 / kappa**2, C_55, C_55 * kappa**2])


@dataclass(frozen=True)
class _Forms:
    """Quadratic forms of strain and motion, to be weighted with moduli and densities."""

    size: int
    stiffness: Array
    """Shape (6 layers, size^2), layer by layer."""
    mass: Array
    """Factors of kappa^0, kappa^2, kappa^4 for unit density. Shape (layers, 3, size, size)."""


@lru_cache(maxsize=64)
def _forms(thicknesses: tuple[float, ...], turns: tuple[bool, ...], order: int) -> _Forms:
    pairs = [_layer_forms(thicknesses, i, turns[i], order) for i in range(len(thicknesses))]
    size = pairs[0][1].shape[-1]
    return _Forms(size, np.concatenate([K.reshape(6, -1) for K, _ in pairs]), np.array([M for _, M in pairs]))


def _layer_forms(thicknesses: tuple[float, ...], i: int, turns: bool, order: int) -> tuple[Array, Array]:
    """Layer i's six forms of strain energy and three of kinetic. Shapes (6, N, N), (3, N, N)."""
    t, bottom = thicknesses[i], sum(thicknesses[:i])
    s, weight = np.polynomial.legendre.leggauss(order + 2)
    weight = weight * t / 2
    dV, V = _legendre(thicknesses, i, order, s)
    dY, Y = _legendre(thicknesses, i, order - 1, s)
    none, one = np.zeros((len(s), 1)), np.ones((len(s), 1))
    zeta = bottom + t * (s[:, None] + 1) / 2
    # Over W_0, V(0), V' and Y' of all layers.
    U = np.hstack([zeta, one, V, 0 * Y])
    slide = np.hstack([none, none, dV, 0 * Y])
    W = np.hstack([one, none, 0 * V, 0 * Y])
    rise = np.hstack([none, none, 0 * V, Y])
    stretch = np.hstack([none, none, 0 * V, dY])

    def form(a: Array, b: Array) -> Array:
        product = (a.T * weight) @ b
        return np.asarray((product + product.T) / 2)

    mean = weight @ U / t
    K = [form(U, U), form(stretch, stretch), 2 * form(U, stretch)]
    K += [form(slide, slide), -2 * form(slide, rise), form(rise, rise)]
    M = [
        form(W, W),
        (form(U, U) if turns else t * np.outer(mean, mean)) + 2 * form(W, rise),
        form(rise, rise),
    ]
    return np.array(K), np.array(M)


def _legendre(thicknesses: tuple[float, ...], i: int, order: int, s: Array) -> tuple[Array, Array]:
    """A function's derivative and the function at the points `s` of layer i, each on (-1, 1).

    The derivative is a Legendre series of `order` terms in every layer, the function zero at the bottom.
    Shape (points, order layers) each.
    """
    legendre = np.polynomial.legendre
    derivative, function = np.zeros((2, len(s), len(thicknesses), order))
    derivative[:, i] = legendre.legvander(s, order - 1)
    # Only the first term of a layer below has a mean, to be carried upwards.
    function[:, :i, 0] = thicknesses[:i]
    for j, one in enumerate(np.eye(order)):
        function[:, i, j] = thicknesses[i] / 2 * legendre.legval(s, legendre.legint(one, lbnd=-1))
    return derivative.reshape(len(s), -1), function.reshape(len(s), -1)
