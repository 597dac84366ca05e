"""Complex modes and responses of a small structure, from its full matrices."""

from collections.abc import Sequence

import numpy as np
import scipy.linalg as la

from fitting.arrays import Array, Complex
from fitting.dynamics.complex_modes import ComplexMode
from fitting.identification.model import velocity
from fitting.laws import CoreLaw
from fitting.structures.beam import Beam
from fitting.structures.small import SmallSpecimen, check_driven, displacement, system_of
from fitting.widened.enriched_plate import EnrichedReducedPlate

_STEPS, _SETTLED = 60, 1e-9
"""A bound for the law followed along; the relative change of a frequency at which that has settled."""
_FIRST_HZ = 100.0
"""The first mode's frequency to begin with. A choice."""
_BENDS = 0.01
"""Of the largest deflection among modes: one that moves across less than this goes along the beam."""
_RIGID, _AMONG = 1e-6, 10
"""Of the tenth eigenvalue: below it a mode is rigid. The last ones say only how fine the columns are."""


def small_modes(specimen: SmallSpecimen, law: CoreLaw | None, count: int) -> list[ComplexMode]:
    """Modes in frequency order, rigid ones left out: the law taken at each mode's own real frequency.

    lambda of K_0 + G*(omega_r) K_1 with omega_r = sqrt(Re lambda_r), by fixed point.
    """
    return elastic_modes(system_of(specimen, specimen.parts()), law, count)


def along(beam: Beam, modes: Sequence[ComplexMode]) -> list[bool]:
    """Which modes of a beam stretch it and do not bend it: no laser that looks across it sees them."""
    deflection = system_of(beam, beam.parts()).deflection[:, 0]
    # Shapes are of one kinetic energy: what bends moves much alike.
    largest = np.array([np.abs(deflection @ m.shape).max() for m in modes])
    return [bool(one < _BENDS * largest.max()) for one in largest]


def elastic_modes(system: EnrichedReducedPlate, law: CoreLaw | None, count: int) -> list[ComplexMode]:
    """Modes of a system as it is, in frequency order and without rigid ones, as `small_modes` has them."""
    # M = L L^T: an ordinary problem is solved several times faster.
    back = la.inv(la.cholesky(system.M, lower=True)).T
    K_0, K_1 = (back.T @ A @ back for A in (system.K_0, system.K_1))

    def elastic(omega: float) -> tuple[Complex, Complex]:
        G = complex(law.modulus(np.array([omega]))[0]) if law is not None else 0.0
        found, turned = np.linalg.eig(K_0 + G * K_1)
        shapes = back @ turned
        order = np.argsort(found.real)
        tenth = np.abs(found[order[min(_AMONG, len(order)) - 1]])
        order = order[found.real[order] > _RIGID * tenth]
        return np.asarray(found[order]), np.asarray(shapes[:, order])

    modes = []
    guess = 2 * np.pi * _FIRST_HZ
    for k in range(min(count, len(elastic(guess)[0]))):
        omega = guess
        for _ in range(_STEPS):
            values, shapes = elastic(omega)
            value, shape = values[k], shapes[:, k]
            new = float(np.sqrt(value.real))
            if abs(new - omega) < _SETTLED * new:
                break
            omega = new
        guess = omega
        modes.append(ComplexMode(complex(value), shape))
    return modes


def small_velocity(specimen: SmallSpecimen, frequency_hz: Array) -> Complex:
    """Phasors in m/s under its base acceleration. Shape (points,)."""
    omega = 2 * np.pi * np.asarray(frequency_hz, dtype=float)
    law = specimen.core.law if specimen.core is not None else None
    G = law.modulus(omega) if law is not None else np.zeros(len(omega), complex)
    parts = specimen.parts()
    check_driven(parts, specimen)
    x = displacement(system_of(specimen, parts), omega, G)
    return velocity(omega, x, specimen.reads) * specimen.drive_amplitude
