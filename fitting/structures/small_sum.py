"""A small structure's response as a sum of simple fractions in the core's modulus, frequency by frequency.

    o^T (K_0 + G* K_1 - omega^2 M + i omega C_1)^-1 load = sum of c_r / (1 + (G* - G_ref) mu_r)

In real numbers where nothing but the core loses energy.
"""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import scipy.linalg as la
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from fitting.arrays import Array, Complex, Mask
from fitting.reduced.rational import RationalSweep
from fitting.widened.enriched_plate import EnrichedReducedPlate

_ROUNDED = 1e-13
"""Of the largest: smaller eigenvalues are rounding."""
_NEAR = 1e4
"""Of g/|g - G|, G the nearest modulus of a resonance without losses."""
_SHARED, _BANDS = 100, 4
"""Points from which on two threads share them, a millisecond's work, and the bands that they share."""
_LOSSY = 0.8
"""Argument of the modulus that a rational sum is made about, rad: far from every resonance."""


def rational_of(
    system: EnrichedReducedPlate,
    omega: Array,
    size_pa: float,
    condensed: Callable[[EnrichedReducedPlate, Array], EnrichedReducedPlate] | None = None,
) -> RationalSweep:
    """The same system at some frequencies (rad/s) as a sum in G*, about a modulus of a size. Shape (n,).

    `condensed` gives what answers in a band, from the system and the band's frequencies: over many points few
    bands are each answered by fewer motions than all of them need together.
    """
    omega = np.asarray(omega, dtype=float)
    G_ref = complex(size_pa * np.exp(1j * _LOSSY))

    def terms(band: NDArray[np.intp]) -> tuple[Complex, Complex]:
        own = condensed(system, omega[band]) if condensed else system
        return _terms(own, omega[band], G_ref)

    if len(omega) < _SHARED:
        return RationalSweep(omega, G_ref, *terms(np.arange(len(omega))))
    bands = np.array_split(np.argsort(omega, kind="stable"), _BANDS)
    # The upper ones take longest: they come first.
    bands.reverse()
    with threadpool_limits(1, "blas"), ThreadPoolExecutor(2) as pool:
        found = list(pool.map(terms, bands))
    c, mu = (np.zeros((len(omega), max(mu.shape[1] for _, mu in found)), complex) for _ in range(2))
    for band, (some_c, some_mu) in zip(bands, found, strict=True):
        c[band, : some_c.shape[1]], mu[band, : some_mu.shape[1]] = some_c, some_mu
    return RationalSweep(omega, G_ref, c, mu)


def _terms(system: EnrichedReducedPlate, omega: Array, G_ref: complex) -> tuple[Complex, Complex]:
    """Terms c and mu of the sum at each frequency. Shape (n, any) each."""
    try:
        B = _only_core_loses(system, omega, G_ref)
        if B is None:
            return _complex_terms(system, omega, G_ref)
        c, mu, near = _real_terms(system, B, omega, G_ref)
    except np.linalg.LinAlgError:
        # A resonance to the last digit.
        return _complex_terms(system, omega, G_ref)
    if near.any():
        # Beside a resonance of real numbers these are of no use.
        c[near], mu[near] = 0.0, 0.0
        c[near, 1:], mu[near, 1:] = _complex_terms(system, omega[near], G_ref)
    return c, mu


def _complex_terms(system: EnrichedReducedPlate, omega: Array, G_ref: complex) -> tuple[Complex, Complex]:
    """Whatever loses energy. Shape (n, k) each."""
    w = omega[:, None, None]
    C_1 = (system.U * system.d) @ system.U.T
    A = system.K_0 + G_ref * system.K_1 - w**2 * system.M + 1j * w * C_1
    sides = np.concatenate([system.K_1, system.load[:, None]], axis=1).astype(complex)
    solved = np.linalg.solve(A, np.broadcast_to(sides, (len(omega), *sides.shape)))
    mu, Y = np.linalg.eig(solved[:, :, :-1])
    weights = np.linalg.solve(Y, solved[:, :, -1:])[:, :, 0]
    return (system.observe @ Y) * weights, mu


def _only_core_loses(system: EnrichedReducedPlate, omega: Array, G_ref: complex) -> Array | None:
    """B with K_1 = B B^T, where K_0 is real and nothing damps; else None. Shape (k, k)."""
    if np.any(np.imag(system.K_0)) or np.any(system.d):
        return None
    # In units of all that moves: sizes of unknowns differ by orders, and what is small counts as much.
    whole = np.real(system.K_0) + abs(G_ref) * system.K_1 + omega.max() ** 2 * system.M
    L = np.linalg.cholesky(whole)
    values, Q = np.linalg.eigh(
        la.solve_triangular(L, la.solve_triangular(L, system.K_1, lower=True).T, lower=True)
    )
    if values[0] < -_ROUNDED * values[-1]:
        return None
    return np.asarray(L @ Q * np.sqrt(np.maximum(values, 0.0)))


def _real_terms(
    system: EnrichedReducedPlate, B: Array, omega: Array, G_ref: complex
) -> tuple[Complex, Complex, Mask]:
    """The same in real numbers, and where they are near a resonance. Shapes (n, k + 1) twice, (n,).

    About g = |G_ref| A = K_0 + g K_1 - w^2 M is real and symmetric.

    With H = B^T A^-1 B = Z diag(h) Z^T the response o^T (A + (G - g) B B^T)^-1 f is, by Woodbury's identity,
    o^T A^-1 f - sum p q (G - g) / (1 + (G - g) h), p = Z^T B^T A^-1 o, q = Z^T B^T A^-1 f.
    """
    g = abs(G_ref)
    A = np.real(system.K_0) + g * system.K_1 - omega[:, None, None] ** 2 * system.M
    sides = np.concatenate([B, system.load[:, None]], axis=1)
    solved = np.linalg.solve(A, np.broadcast_to(sides, (len(omega), *sides.shape)))
    h, Z = np.linalg.eigh(B.T @ solved[:, :, :-1])
    p, q = ((v[:, None, :] @ Z)[:, 0] for v in (system.observe @ solved[:, :, :-1], solved[:, :, -1] @ B))
    # What hardly depends on G is left to the term without it.
    moves = np.abs(h) > _ROUNDED * np.abs(h).max(axis=1, keepdims=True)
    c = np.where(moves, p * q / np.where(moves, h, 1.0), 0.0)
    rest = solved[:, :, -1] @ system.observe - c.sum(axis=1)
    # About the modulus wanted: 1 + (G - g) h = s (1 + (G - G_ref) h / s).
    s = 1 + (G_ref - g) * h
    c, mu = np.column_stack([rest, c / s]), np.column_stack([np.zeros(len(omega)), h / s])
    return c.astype(complex), mu.astype(complex), g * np.abs(h).max(axis=1) > _NEAR
