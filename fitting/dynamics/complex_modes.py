"""Complex modes of the plate with its frequency-dependent core.

lambda_r is an eigenvalue of K_0 + G*(omega_r) K_1 with the law taken at the real
omega_r = sqrt(Re lambda_r), found by fixed point; eta_r = Im lambda_r / Re lambda_r.
Convention of Johnson and Kienholz, and of Cupial and Niziol.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.linalg as la

from fitting.arrays import Array, Complex
from fitting.dynamics.real_modes import real_modes, refuse_negative
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.numerics.linear import factorise
from fitting.plate.plate import Plate
from fitting.progress import Report, unheard

_SPARE = 4
"""Real modes kept beyond those asked for, so that the last ones are spanned too."""
_MODULI = 3
"""Real ones whose modes span the start: in the band's middle, softer and stiffer."""
_STEPS = 100
"""Of either iteration, a bound: what has not settled by then is given as it is."""
_START_RAD_S = 2 * np.pi * 100.0
_FOLLOWED = 1e-6
"""Relative change of a frequency on a few columns: the full plate then has its say."""
_TOLERANCE = 1e-9
"""Relative change of lambda at which a mode has settled: far below what the mesh is off by."""


@dataclass(frozen=True)
class ModalValue:
    """Of one mode: lambda in (rad/s)^2."""

    eigenvalue: complex

    @property
    def frequency_hz(self) -> float:
        """omega_r / 2 pi."""
        return float(np.sqrt(self.eigenvalue.real) / (2 * np.pi))

    @property
    def loss_factor(self) -> float:
        """Im lambda / Re lambda."""
        return float(self.eigenvalue.imag / self.eigenvalue.real)


@dataclass(frozen=True)
class ComplexMode(ModalValue):
    """One mode with its full shape."""

    shape: Complex


@dataclass(frozen=True)
class ModalValues:
    """lambda of successive modes in (rad/s)^2. Shape (modes,)."""

    eigenvalues: Complex

    @property
    def each(self) -> list[ModalValue]:
        """One by one."""
        return [ModalValue(complex(v)) for v in self.eigenvalues]


def complex_modes(
    plate: Plate,
    law: CoreLaw | None,
    count: int,
    progress: Report = unheard,
) -> list[ComplexMode]:
    """The first `count` elastic modes; `law` None for a bare plate.

    Real modes at a few moduli span the start; each mode is then corrected on the full plate. Raises
    `OutsideModel` for no mode, or more than half of the mesh's degrees of freedom, and for a mesh too fine to
    have a stiffness.
    """
    if not 0 < count <= plate.size // 2:
        raise OutsideModel(f"{count} modes asked for, expected 1 to {plate.size // 2}")
    modulus = _modulus_of(law)
    # A factorisation is what takes the time, of each modulus and of each mode.
    whole = _MODULI + count
    V = _span(plate, modulus, count, lambda done: progress(done / whole))
    # M = L L^T: an ordinary eigenproblem takes a fraction of the time.
    back = la.inv(la.cholesky(V.T @ (plate.M @ V), lower=True)).T
    V = V @ back
    K_0, K_1 = (V.T @ (A @ V) for A in (plate.K_0, plate.K_1))
    modes: list[ComplexMode] = []
    omega = _START_RAD_S
    refuse_negative(plate, float(la.eigvals(K_0 + modulus(omega) * K_1).real.min()))
    for r in range(count):
        omega, u, omega_of_next = _fixed_point(K_0, K_1, modulus, r, omega)
        modes.append(_correct(plate, modulus, omega, V @ u))
        omega = omega_of_next
        progress((_MODULI + r + 1) / whole)
    return modes


def _modulus_of(law: CoreLaw | None) -> Callable[[float], complex]:
    if law is None:
        return lambda omega: 0j
    return lambda omega: complex(law.modulus(np.array([omega]))[0])


def _span(
    plate: Plate, modulus: Callable[[float], complex], count: int, done: Callable[[int], None]
) -> Array:
    """Real modes at the moduli the law takes over the band of the modes, orthonormal. Shape (n, k)."""
    wanted = min(count + _SPARE, plate.size - 8)
    G = abs(modulus(2 * np.pi * 100.0))
    modes = real_modes(plate, G, wanted)
    done(1)
    if G == 0:
        return modes.shapes
    ends = [abs(modulus(omega)) for omega in (modes.omega[0], modes.omega[-1])]
    tan = max(abs(modulus(o).imag / modulus(o).real) for o in (modes.omega[0], modes.omega[-1]))
    # A lossy core's complex shapes lie between the shapes of stiffer and softer real cores.
    spread = 1 + min(tan, 1.0)
    moduli = [min(ends) / spread, max(ends) * spread]
    shapes = [modes.shapes]
    for g in moduli:
        shapes.append(real_modes(plate, g, wanted).shapes)
        done(len(shapes))
    U, s, _ = la.svd(np.hstack(shapes), full_matrices=False)
    return np.asarray(U[:, s > 1e-10 * s[0]])


def _fixed_point(
    K_0: Complex, K_1: Array, modulus: Callable[[float], complex], r: int, omega: float
) -> tuple[float, Complex, float]:
    """omega_r and the reduced shape of the r-th mode in frequency order, and about where the next one is."""
    for _ in range(_STEPS):
        values, vectors = la.eig(K_0 + modulus(omega) * K_1)
        order = np.argsort(values.real)
        found = float(np.sqrt(values[order[r]].real))
        u = vectors[:, order[r]]
        settled = abs(found / omega - 1) < _FOLLOWED
        omega = found
        if settled:
            break
    return omega, u, float(np.sqrt(values[order[min(r + 1, len(order) - 1)]].real))


def _correct(plate: Plate, modulus: Callable[[float], complex], omega: float, u: Complex) -> ComplexMode:
    """Inverse iteration on the full plate, the law followed along: one factorisation a mode."""
    G = modulus(omega)
    K = plate.K_0 + G * plate.K_1
    value = complex((u @ (K @ u)) / (u @ (plate.M @ u)))
    solve = factorise((K - value * (1 + 1e-7) * plate.M).astype(complex))
    for _ in range(_STEPS):
        u = solve(plate.M @ u)
        u = u / np.sqrt(u @ (plate.M @ u))
        k_0, k_1 = complex(u @ (plate.K_0 @ u)), complex(u @ (plate.K_1 @ u))
        new = k_0 + modulus(omega) * k_1
        omega = float(np.sqrt(new.real))
        if abs(new / value - 1) < _TOLERANCE:
            break
        value = new
    return ComplexMode(new, u)
