"""Complex modes of small dense matrices, the law and the viscous damping at each mode's own frequency.

    (K_0 + G*(omega_r) K_1 + i omega_r C_1) y = lambda M y,   omega_r = sqrt(Re lambda),   y^T M y = 1

A widened plate has a hundred columns and more: its modes are sought among its real ones, then corrected on
all columns.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.linalg as la

from fitting.arrays import Array, Complex
from fitting.complex_modes import ComplexMode
from fitting.effects.change import Change
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.laws import CoreLaw

_SPARE = 14
"""Real modes beyond those asked for, among which complex ones are sought."""
_STEPS, _SETTLED = 60, 1e-9
"""A bound for the law followed along; the relative change of a frequency at which that has settled."""
_CORRECTIONS, _CORRECTED = 4, 1e-8
"""A bound for Rayleigh's quotient, and its relative change at the end: stiff springs leave no more digits."""
_FOLLOWED, _ALIKE = 12, 0.8
"""A bound for Rayleigh's quotient from another modulus on; how much of its shape a mode keeps on the way."""
_BESIDE = 1e-8
"""Relative: a shift that is an eigenvalue to all digits leaves nothing to solve."""
_RIGID = 1e-6
"""Of the median eigenvalue: below it a mode is rigid."""


@dataclass(frozen=True)
class ModalMatrices:
    """Of one equation. Shape (k, k) each."""

    K_0: Complex
    K_1: Array
    M: Array
    C_1: Array

    @classmethod
    def of(cls, system: EnrichedReducedPlate, change: Change) -> "ModalMatrices":
        """A structure with something changed."""
        C_1 = system.viscous(change.damping) + change.C
        return cls(system.K_0 + change.K, system.K_1 + change.K_1, system.M + change.M, C_1)

    def on(self, V: Array) -> "ModalMatrices":
        """On the combinations V of the columns. Shape (k, few)."""
        return ModalMatrices(V.T @ self.K_0 @ V, V.T @ self.K_1 @ V, V.T @ self.M @ V, V.T @ self.C_1 @ V)

    def stiffness(self, G: complex, omega: float) -> Complex:
        """K_0 + G* K_1 + i omega C_1. Shape (k, k)."""
        return np.asarray(self.K_0 + G * self.K_1 + 1j * omega * self.C_1)


def modes_of(A: ModalMatrices, law: CoreLaw, count: int, near_hz: float) -> list[ComplexMode]:
    """The first `count` elastic modes, fewer where there are fewer; `near_hz` is a guess of the first."""

    def modulus(omega: float) -> complex:
        return complex(law.modulus(np.array([omega]))[0])

    if len(A.M) <= count + 2 * _SPARE:
        return _by_fixed_point(A, modulus, count, near_hz)
    G = abs(modulus(2 * np.pi * near_hz))
    _, V = la.eigh(A.K_0.real + G * A.K_1, A.M, subset_by_index=[0, count + _SPARE - 1])
    found = _by_fixed_point(A.on(V), modulus, count, near_hz)
    return [_corrected(A, modulus, ComplexMode(m.eigenvalue, V @ m.shape)) for m in found]


def _by_fixed_point(
    A: ModalMatrices, modulus: Callable[[float], complex], count: int, near_hz: float
) -> list[ComplexMode]:
    # M = L L^T: an ordinary problem is solved several times faster.
    back = la.inv(la.cholesky(A.M, lower=True)).T
    turned = A.on(back)

    def elastic(omega: float) -> tuple[Complex, Complex]:
        values, vectors = np.linalg.eig(turned.stiffness(modulus(omega), omega))
        order = np.argsort(values.real)
        order = order[values.real[order] > _RIGID * np.median(np.abs(values))]
        return np.asarray(values[order]), vectors[:, order]

    modes: list[ComplexMode] = []
    omega = 2 * np.pi * near_hz
    values, shapes = elastic(omega)
    followed = _followed(turned, modulus, values[:count], shapes[:, :count])
    if followed is not None:
        return [_normal(A, value, back @ y) for value, y in followed]
    for k in range(min(count, len(values))):
        for _ in range(_STEPS):
            values, shapes = elastic(omega)
            # A softer guess may have made one more motion rigid.
            at = min(k, len(values) - 1)
            found = float(np.sqrt(values[at].real))
            settled = abs(found - omega) < _SETTLED * found
            omega = found
            if settled:
                break
        modes.append(_normal(A, complex(values[at]), back @ shapes[:, at]))
    return modes


def _normal(A: ModalMatrices, value: complex, y: Complex) -> ComplexMode:
    return ComplexMode(value, y / np.sqrt(y @ (A.M @ y)))


def _followed(
    turned: ModalMatrices, modulus: Callable[[float], complex], values: Complex, shapes: Complex
) -> list[tuple[complex, Complex]] | None:
    """Modes at one modulus, each followed to its own by Rayleigh's quotient: a tenth of the time.

    None where one does not stay what it was, or they change places: then each is sought in its order.
    Shapes (modes,), (k, modes).
    """
    found: list[tuple[complex, Complex]] = []
    one = np.eye(len(shapes))
    for value, begun in zip(values.tolist(), shapes.T, strict=True):
        y, before = begun / np.sqrt(begun @ begun), 0j
        for _ in range(_FOLLOWED):
            omega = float(np.sqrt(max(value.real, 0.0)))
            K = turned.stiffness(modulus(omega), omega)
            value = complex(y @ (K @ y))
            if abs(value - before) < _SETTLED * abs(value):
                break
            before = value
            y = np.linalg.solve(K - value * (1 + _BESIDE) * one, y)
            y = y / np.sqrt(y @ y)
        else:
            return None
        alike = abs(np.vdot(y, begun)) / np.sqrt(np.vdot(y, y).real * np.vdot(begun, begun).real)
        if alike < _ALIKE or (found and value.real <= found[-1][0].real):
            return None
        found.append((value, y))
    return found


def _corrected(A: ModalMatrices, modulus: Callable[[float], complex], mode: ComplexMode) -> ComplexMode:
    """Rayleigh quotient iteration on all columns."""
    value, y = mode.eigenvalue, mode.shape
    for _ in range(_CORRECTIONS):
        omega = float(np.sqrt(value.real))
        K = A.stiffness(modulus(omega), omega)
        y = np.asarray(np.linalg.solve(K - value * (1 + _BESIDE) * A.M, A.M @ y), complex)
        y /= np.sqrt(y @ (A.M @ y))
        new = complex(y @ (K @ y))
        if new.real <= 0:
            # Numbers far off leave no stiffness in some column: a fit comes back from there.
            return mode
        settled = abs(new / value - 1) < _CORRECTED
        value = new
        if settled:
            break
    return ComplexMode(value, y)
