"""The matrices of one element of a specimen: substrate, and what of the treatment is on it."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex
from fitting.plate import element
from fitting.plate.element import U_B, U_C, V_B, V_C
from fitting.plate.face_shear import slip_of
from fitting.plate.mesh import Cell, Mesh
from fitting.specimen import PlateSpecimen


@dataclass(frozen=True)
class ElementMatrices:
    """Matrices of one element, shape (4 dofs, 4 dofs); elements that are treated alike are alike."""

    M: Array
    K_substrate: Array
    K_constraining: Array
    K_1: Array
    K_slip: Complex | float = 0.0
    """Of what slips beside the core; complex where it loses energy."""
    K_pulled: Array | float = 0.0
    """Of clamps on opposite edges that pull it along."""

    @property
    def K_0(self) -> Array:
        """Both faces and what pulls them, loss factors left out."""
        return self.K_substrate + self.K_constraining + np.asarray(self.K_slip).real + self.K_pulled


def element_matrices(specimen: PlateSpecimen, mesh: Mesh, cell: Cell | None = None) -> ElementMatrices:
    """The element of a specimen, of one of its cells; the treatment's parts are zero for a bare plate."""
    s, shape = specimen, mesh.shape
    M = element.face_mass(shape, s.substrate, U_B, V_B)
    K_b = element.face_stiffness(shape, s.substrate, U_B, V_B)
    stresses = [(a, stress) for a, stress in zip("xy", s.axial_pa, strict=True) if stress]
    K_pulled = sum(p * s.pulled_thickness_m * element.pulled_stiffness(shape, a) for a, p in stresses)
    over = cell.over if cell is not None else None
    if s.core is None or (over is not None and not over):
        nothing = np.zeros_like(K_b)
        return ElementMatrices(M, K_b, nothing, nothing, nothing.astype(complex), K_pulled)
    assert s.constraining is not None
    sides = 2 if s.both_sides else 1
    M = M + sides * element.face_mass(shape, s.constraining, U_C, V_C, over)
    M = M + sides * element.core_mass(shape, s.core, s.substrate, s.constraining, over)
    K_c = sides * element.face_stiffness(shape, s.constraining, U_C, V_C, over)
    K_v = sides * element.core_stiffness(shape, s.core, s.substrate, s.constraining, over)
    K_slip = np.zeros(K_b.shape, complex)
    if (slip := slip_of(s)) is not None:
        alone = element.slip_stiffness(shape, over)
        M, K_slip = M + slip.mass_kg_m2 * alone, K_slip + slip.stiffness_pa_m * alone
        faces = (s.substrate, 1, slip.turn_b), (s.constraining, sides, slip.turn_c)
        for face, times, turn in faces if s.faces_shear else ():
            lossy = times * (1 + 1j * face.loss_factor)
            K_slip += lossy * element.turned_sections(shape, face, turn, over)
    return ElementMatrices(M, K_b, K_c, K_v, K_slip, K_pulled)
