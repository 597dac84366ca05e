"""The same mesh of another plate: what its matrices differ by. No effect by itself."""

from collections.abc import Iterable

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.change import Change
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.effects.full_plate import FullPlate, Snapshot
from fitting.element import CORNERS
from fitting.parts import CORE, STIFFNESS, coefficients, stretched
from fitting.plate import Mesh, element_matrices
from fitting.specimen import Specimen


def differences(full: FullPlate, other: Specimen) -> tuple[Array, Array, Array]:
    """What an element's K_0, K_1 and M of another plate differ by. Shape (28, 28) each.

    Its trial functions are the stated plate's, stretched with it: w(x / length, y / width) stays.
    """

    def make() -> tuple[Array, Array, Array]:
        s, mesh = full.specimen, full.loose.mesh
        t = np.tile(stretched(other, s), len(CORNERS))
        here = full.once("stated elements", lambda: element_matrices(s, mesh))
        there = element_matrices(other, Mesh(other.length_m, other.width_m, mesh.n_x, mesh.n_y))
        K_0, K_1, M = (
            t[:, None] * getattr(there, part) * t - getattr(here, part) for part in ("K_0", "K_1", "M")
        )
        return K_0, K_1, M

    return full.once(f"difference to {other}", make)


def forces(full: FullPlate, at: Snapshot, others: Iterable[Specimen]) -> Complex:
    """Whose responses are, to first order, how their motions differ. Shape (n, 2 plates)."""
    found = []
    for other in others:
        K_0, K_1, M = differences(full, other)
        found.append(full.elements.forces(K_0 + at.G * K_1 - at.omega**2 * M, at.both))
    return np.hstack(found)


def changed_to(plate: EnrichedReducedPlate, other: Specimen) -> Change:
    """What another plate on the same mesh changes; `other` is `plate.specimen` with something else."""
    c, stated = coefficients(other, plate.specimen), plate.coefficients
    n_0, n_1 = len(STIFFNESS), len(STIFFNESS) + len(CORE)
    return Change(
        K=mixed(c.K_0 - stated.K_0, plate.parts[:n_0]),
        K_1=mixed(c.K_1 - stated.K_1, plate.parts[n_0:n_1]),
        M=mixed(c.M - stated.M, plate.parts[n_1:]),
        load=-(c.load - stated.load) * plate.load_part,
    )


def mixed(coefficients: Array | Complex, parts: Array) -> Array | Complex | float:
    """The sum of parts with such coefficients; 0 where all are zero.

    Of shapes (parts,) and (parts, ...): the latter's without its first axis.
    """
    kept = np.flatnonzero(coefficients)
    if not kept.size:
        return 0.0
    c = coefficients[kept]
    return np.asarray(np.tensordot(c if np.any(c.imag) else c.real, parts[kept], axes=1))
