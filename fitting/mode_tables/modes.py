"""Complex modes of small dense matrices, the law and the viscous damping at each mode's own frequency.

    (K_0 + G*(omega_r) K_1 + i omega_r C_1) y = lambda M y,   omega_r = sqrt(Re lambda),   y^T M y = 1

A widened plate has a hundred columns and more: its modes are sought among its real ones, then corrected on
all columns.
"""

from dataclasses import dataclass

import numpy as np
import scipy.linalg as la

from fitting.arrays import Array, Complex, Mask
from fitting.dynamics.complex_modes import ComplexMode
from fitting.laws import CoreLaw
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate

_SPARE = 14
"""Real modes beyond those asked for, among which complex ones are sought."""
_STEPS, _SETTLED = 60, 1e-9
"""A bound for the law followed along; the relative change of a frequency at which that has settled."""
_CORRECTIONS, _FOLLOWED = 4, 12
"""Bounds for Rayleigh's quotient, from few columns to all and from another modulus on."""
_CHANGED = 1e-5
"""Relative: where the quotient last changed by less, the next change is of its square."""
_ALIKE = 0.8
"""How much of its shape a mode keeps on the way."""
_NEARBY = 1e-6
"""Relative step of a frequency, for the law's slope."""
_BESIDE = 1e-8
"""Relative: a shift that is an eigenvalue to all digits leaves nothing to solve."""
_RIGID = 1e-6
"""Of the median eigenvalue: below it a mode is rigid."""


@dataclass(frozen=True)
class ModalMatrices:
    """The matrices of one specimen's equation of motion. Shape (k, k) each."""

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

    def stiffness(self, G: complex | Complex, omega: float | Array) -> Complex:
        """K_0 + G* K_1 + i omega C_1. Shape (k, k), or of several (any, k, k) of (any, 1, 1)."""
        return np.asarray(self.K_0 + G * self.K_1 + 1j * omega * self.C_1)


def modes_of(A: ModalMatrices, law: CoreLaw, count: int, near_hz: float) -> list[ComplexMode]:
    """The first `count` elastic modes, fewer where there are fewer; `near_hz` is a guess of the first."""
    # What leads nowhere is not a number, and then told apart.
    with np.errstate(all="ignore"):
        return _modes_of(A, law, count, near_hz)


def _modes_of(A: ModalMatrices, law: CoreLaw, count: int, near_hz: float) -> list[ComplexMode]:
    if len(A.M) <= count + 2 * _SPARE:
        return _sought(A, law, count, near_hz)
    G = abs(_modulus(law, 2 * np.pi * near_hz))
    _, V = la.eigh(A.K_0.real + G * A.K_1, A.M, subset_by_index=[0, count + _SPARE - 1])
    found = _sought(A.on(V), law, count, near_hz)
    return _corrected(A, law, [ComplexMode(m.eigenvalue, V @ m.shape) for m in found])


def _modulus(law: CoreLaw, omega: float) -> complex:
    return complex(law.modulus(np.array([omega]))[0])


def _sought(A: ModalMatrices, law: CoreLaw, count: int, near_hz: float) -> list[ComplexMode]:
    # M = L L^T: an ordinary problem is solved several times faster.
    back = la.inv(la.cholesky(A.M, lower=True)).T
    turned = A.on(back)

    def elastic(omega: float) -> tuple[Complex, Complex]:
        values, vectors = np.linalg.eig(turned.stiffness(_modulus(law, omega), omega))
        order = np.argsort(values.real)
        order = order[values.real[order] > _RIGID * np.median(np.abs(values))]
        return np.asarray(values[order]), vectors[:, order]

    omega = 2 * np.pi * near_hz
    values, shapes = elastic(omega)
    followed = _followed(turned, law, values[:count], shapes[:, :count].T)
    if followed is not None:
        return [_normal(A, value, back @ y) for value, y in zip(*followed, strict=True)]
    modes: list[ComplexMode] = []
    for k in range(min(count, len(values))):
        for _ in range(_STEPS):
            values, shapes = elastic(omega)
            if not len(values):
                return modes
            # A softer guess may have made one more motion rigid.
            at = min(k, len(values) - 1)
            found = float(np.sqrt(values[at].real))
            settled = abs(found - omega) < _SETTLED * found
            omega = found
            if settled:
                break
        modes.append(_normal(A, values[at], back @ shapes[:, at]))
    return modes


def _normal(A: ModalMatrices, value: complex, y: Complex) -> ComplexMode:
    return ComplexMode(complex(value), y / np.sqrt(y @ (A.M @ y)))


def _followed(
    turned: ModalMatrices, law: CoreLaw, values: Complex, begun: Complex
) -> tuple[Complex, Complex] | None:
    """Modes at one modulus, each followed to its own by Rayleigh's quotient: a tenth of the time.

    None where one does not stay what it was, or they change places: then each is sought in its order.
    Shapes (modes,), (modes, k).
    """
    if not len(values):
        return None
    begun = begun / np.sqrt(np.sum(begun**2, axis=1))[:, None]
    at = _own_values(turned, law, np.sqrt(np.maximum(values.real, 0)), begun)
    found, y, settled = _by_rayleigh(turned, law, at, begun, _FOLLOWED)
    if not settled.all() or np.any(np.diff(found.real) <= 0):
        return None
    size = np.linalg.norm(y, axis=1) * np.linalg.norm(begun, axis=1)
    alike = np.abs(np.sum(y.conj() * begun, axis=1)) / size
    return None if np.any(alike < _ALIKE) else (found, y)


def _corrected(A: ModalMatrices, law: CoreLaw, modes: list[ComplexMode]) -> list[ComplexMode]:
    """On all columns."""
    if not modes:
        return modes
    values, shapes = np.array([m.eigenvalue for m in modes]), np.array([m.shape for m in modes])
    values, shapes, _ = _by_rayleigh(A, law, values, shapes, _CORRECTIONS)
    # Numbers far off leave no stiffness in some column: a fit comes back from there.
    return [
        m if np.isnan(value) else ComplexMode(complex(value), y)
        for m, value, y in zip(modes, values, shapes, strict=True)
    ]


def _by_rayleigh(
    A: ModalMatrices, law: CoreLaw, values: Complex, shapes: Complex, most: int
) -> tuple[Complex, Complex, Mask]:
    """Rayleigh quotient iteration of several modes side by side, and whether each has settled.

    NaN of a mode that has come to no stiffness. Shapes (modes,), (modes, k) and (modes,).
    """
    settled = np.zeros(len(values), bool)
    for _ in range(most):
        omega = np.sqrt(values.real)
        K = A.stiffness(law.modulus(omega)[:, None, None], omega[:, None, None])
        shift = (values * (1 + _BESIDE))[:, None, None]
        shapes = np.asarray(np.linalg.solve(K - shift * A.M, (shapes @ A.M)[..., None])[..., 0], complex)
        shapes = shapes / np.sqrt(np.sum(shapes * (shapes @ A.M), axis=1))[:, None]
        new = _own_values(A, law, omega, shapes)
        settled = np.abs(new - values) < _CHANGED * np.abs(values)
        values = new
        if np.all(settled | np.isnan(values)):
            break
    return values, shapes, settled


def _own_values(A: ModalMatrices, law: CoreLaw, omega: Array, shapes: Complex) -> Complex:
    """Rayleigh's quotient at its own frequency, of shapes that stay: a root of one number, by Newton's steps.

    NaN where there is none. Shapes (modes,) and (modes, k).
    """
    a, b, c = (np.sum(shapes * (shapes @ K), axis=1) for K in (A.K_0, A.K_1, 1j * A.C_1))
    values = np.full(len(omega), np.nan + 0j)
    for _ in range(_STEPS):
        G, nearby = law.modulus(omega * np.array([[1.0], [1 + _NEARBY]]))
        slope = (nearby - G) / (_NEARBY * omega) * b + c
        step = ((a + G * b + omega * c).real - omega**2) / (2 * omega - slope.real)
        values = a + G * b + omega * c + slope * step
        omega = np.where(values.real > 0, omega + step, np.nan)
        if not np.any(np.abs(step) > _SETTLED * omega):
            break
    return np.where((omega > 0) & (values.real > 0), values, np.nan)
