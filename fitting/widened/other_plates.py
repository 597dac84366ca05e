"""The same mesh of another plate: what its matrices differ by."""

from collections.abc import Iterable

import numpy as np

from fitting.arrays import Array, Complex
from fitting.plate.element import CORNERS, DOFS
from fitting.plate.element_matrices import element_matrices
from fitting.plate.mesh import Mesh
from fitting.plate.part_names import names_of
from fitting.plate.parts import coefficients, loaded, stretched
from fitting.specimen import PlateSpecimen
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot


def differences(full: FullPlate, other: PlateSpecimen) -> tuple[Array, Array, Array]:
    """What an element's K_0, K_1 and M of another plate differ by.

    Shape (4 dofs, 4 dofs) each, or (cells, 4 dofs, 4 dofs). Its trial functions are the stated plate's,
    stretched with it: w(x / length, y / width) stays.
    """

    def make() -> tuple[Array, Array, Array]:
        s, mesh = full.specimen, full.loose.mesh
        t = np.ones(mesh.dofs)
        t[:DOFS] = stretched(other, s)
        t = np.tile(t, len(CORNERS))
        there = Mesh(other.length_m, other.width_m, mesh.n_x, mesh.n_y, mesh.dofs)
        longer, wider = other.length_m / s.length_m, other.width_m / s.width_m
        pairs = [
            (element_matrices(s, mesh, cell), element_matrices(other, there, cell.stretched(longer, wider)))
            for cell in full.loose.cells
        ]
        K_0, K_1, M = (
            np.array([t[:, None] * getattr(b, part) * t - getattr(a, part) for a, b in pairs])
            for part in ("K_0", "K_1", "M")
        )
        return (K_0, K_1, M) if len(pairs) > 1 else (K_0[0], K_1[0], M[0])

    return full.once(f"difference to {other}", make)


def forces(full: FullPlate, at: Snapshot, others: Iterable[PlateSpecimen]) -> Complex:
    """Whose responses are, to first order, how their motions differ. Shape (n, 2 plates)."""
    found = []
    for other in others:
        K_0, K_1, M = differences(full, other)
        found.append(full.elements.forces(K_0 + at.G * K_1 - at.omega**2 * M, at.both))
    return np.hstack(found)


def changed_to(plate: EnrichedReducedPlate, other: PlateSpecimen) -> Change:
    """What another plate on the same mesh changes; `other` is `plate.specimen` with something else."""
    c, stated = coefficients(other, plate.specimen), plate.coefficients
    at = names_of(plate.specimen).counts
    return Change(
        K=mixed(c.K_0 - stated.K_0, plate.parts[at.K_0]),
        K_1=mixed(c.K_1 - stated.K_1, plate.parts[at.K_1]),
        M=mixed(c.M - stated.M, plate.parts[at.M]),
        load=-loaded(c.load - stated.load, plate.load_part),
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
