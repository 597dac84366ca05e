"""The paper's response: real modes at each frequency, their damping taken as uncoupled.

Eq. (6) to (14) with the loop over frequencies of Fig. 3; Eq. (9) with its missing -omega^2. At every
frequency the real modes belong to K_0' + G'(omega) K_1, so all of them live in a span of modes at
a few moduli: the eigenproblem is solved there, once a frequency as the paper does.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array, Complex
from fitting.dynamics.real_modes import real_modes
from fitting.plate.plate import Plate
from fitting.progress import Report, unheard

MODES = 8
"""The paper superposes the first eight, odd ones counted though a base does not excite them."""
_MODULI = 6
"""Real ones over the domain, whose modes span those between; `_SPARE` further modes of each help."""
_SPARE = 3
"""Modes beyond those superposed, so that the last ones are spanned too."""
_INDEPENDENT = 1e-8
"""Share of the strain energy below which a direction adds nothing."""


@dataclass(frozen=True)
class _Span:
    """The plate on mass-orthonormal vectors of one parity."""

    K_0: Array
    K_0_loss: Array
    K_1: Array
    load: Array
    observe: Array

    def modes(self, G_real: Array) -> tuple[Array, Array]:
        """omega_r^2 and phi_r at each modulus. Shapes (points, k), (points, k, k)."""
        values, vectors = np.linalg.eigh(self.K_0 + G_real[:, None, None] * self.K_1)
        return values, vectors


@dataclass(frozen=True)
class RealModePlate:
    """The specimen as the paper's response sees it, for a unit base acceleration, read at the pickup."""

    even: _Span
    odd: _Span
    ratios: Array
    """zeta_r in frequency order. Shape (MODES,)."""

    def displacement(self, omega: Array, G: Complex) -> Complex:
        """Relative displacement at the pickup for a base acceleration of 1 m/s^2, in m. Shape of `omega`."""
        squared, phi = self.even.modes(G.real)
        odd_squared = np.linalg.eigvalsh(self.odd.K_0 + G.real[:, None, None] * self.odd.K_1)
        # zeta_r is paired in the order of all modes: an even mode's rank counts the odd ones below it.
        below = (odd_squared[:, None, :] < squared[:, :, None]).sum(axis=2)
        rank = np.arange(squared.shape[1]) + below
        used = rank < MODES
        zeta = np.where(used, self.ratios[np.minimum(rank, MODES - 1)], 0.0)
        omega_r = np.sqrt(squared)
        loss = self.even.K_0_loss + G.imag[:, None, None] * self.even.K_1
        eta = np.einsum("pkr,pkr->pr", phi, loss @ phi) / squared
        f_N = np.einsum("pkr,k->pr", phi, self.even.load)
        w = omega[:, None]
        x_N = f_N / (squared * (1 + 1j * eta) + 2j * w * zeta * omega_r - w**2)
        seen = np.einsum("pkr,k->pr", phi, self.even.observe)
        return np.asarray((np.where(used, x_N, 0) * seen).sum(axis=1))


def real_mode_plate(plate: Plate, modulus: tuple[float, float], progress: Report = unheard) -> RealModePlate:
    """Span the real modes of all core moduli in `modulus` (Pa)."""
    moduli = np.geomspace(*modulus, _MODULI) if plate.specimen.core is not None else [0.0]
    spanned = []
    for g in moduli:
        spanned.append(real_modes(plate, float(g), MODES + _SPARE).shapes)
        progress(len(spanned) / len(moduli))
    shapes = np.hstack(spanned)
    ratios = np.zeros(MODES)
    given = np.array(plate.specimen.modal_ratios[:MODES])
    ratios[: len(given)] = given
    middle = float(np.sqrt(modulus[0] * modulus[1]))
    even, odd = (_span(plate, P, shapes, middle) for P in (plate.even, plate.odd))
    return RealModePlate(even, odd, ratios)


def _span(plate: Plate, P: sp.csc_array, shapes: Array, G: float) -> _Span:
    V = P @ (P.T @ shapes)
    # Independence is judged by stiffness: what weighs little may still bend a mode.
    K = (plate.K_0.real + G * plate.K_1).tocsc()
    energy = np.einsum("ij,ij->j", V, K @ V)
    V = V[:, energy > _INDEPENDENT * energy.max()]
    V = V / np.sqrt(np.einsum("ij,ij->j", V, K @ V))
    values, vectors = np.linalg.eigh(V.T @ (K @ V))
    V = V @ (vectors[:, values > _INDEPENDENT] / np.sqrt(values[values > _INDEPENDENT]))
    V = np.linalg.solve(np.linalg.cholesky(V.T @ (plate.M @ V)), V.T).T
    return _Span(
        K_0=V.T @ (plate.K_0.real @ V),
        K_0_loss=V.T @ (plate.K_0.imag @ V),
        K_1=V.T @ (plate.K_1 @ V),
        load=V.T @ plate.base_load,
        observe=V.T @ plate.pickup,
    )
