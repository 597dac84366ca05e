"""What plate theory lets a free edge carry, and a solid does not: twist.

Saint-Venant's torsion of a strip has J = b h^3 / 3 (1 - 0.63 h / b): near a free edge the shear flow turns
over, as if a strip of `EDGE_WIDTH` h carried no twisting moment (decision 13).

What is taken off is of a line, and true of waves that are long beside it. Motions that turn within one narrow
element hold less than that: of a mesh too fine the stiffness would have negative values.
"""

from dataclasses import dataclass

import numpy as np

from fitting.plate.element import face_plane_stress
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Face

EDGE_WIDTH = 0.63 / 2
"""Of the thickness: so wide a strip carries no twist at a free edge (decision 13)."""
_NARROWEST, _NARROWEST_SHEARED = 1.5, 1.0
"""Of the thickest face: sides of a default mesh's elements. Stiffness is negative below 1.25, where faces
shear below 0.72; in elements that are not square, or of plies, below 1.5 and 0.9 as a rule."""
_LEAST_ELEMENTS = 4
"""Along a side: fewer bend as no plate does. A choice."""


@dataclass(frozen=True)
class EdgeTwist:
    """What a face's free edge gives way by: until no moment twists it, and none bends it across."""

    stiffness: float
    """2 `EDGE_WIDTH` h D_66, in N m^2: of an isotropic face E h^3/(6 (1 + nu)) a width of `EDGE_WIDTH` h."""
    coupling: float
    """D_s6/(2 D_66): what bending along the edge does to the moment; zero about a face's own axes."""

    @classmethod
    def of(cls, face: Face, *, along_x: bool) -> "EdgeTwist":
        """At an edge along x, or along y.

        D is of the moments M_s and M_ns where M_n is zero: the inverse of the compliances' part for s and ns.
        """
        width = EDGE_WIDTH * face.thickness_m
        if face.rolled is None:
            return cls(2 * width * face.young_pa * face.thickness_m**3 / (12 * (1 + face.poisson)), 0.0)
        s = [0 if along_x else 1, 2]
        D = np.linalg.inv(np.linalg.inv(face_plane_stress(face))[np.ix_(s, s)])
        # Energy 1/2 D_66 (2 w_ns + D_s6/D_66 w_ss)^2 an area.
        return cls(float(4 * width * D[1, 1] * face.thickness_m**3 / 12), float(D[0, 1] / D[1, 1] / 2))


def wide_enough(specimen: PlateSpecimen, mesh: tuple[int, int]) -> tuple[int, int]:
    """Of so many elements along x and y those that are not too narrow for what free edges lack in twist."""
    if not specimen.lacks_edge_twist:
        return mesh
    faces = [face for face in (specimen.substrate, specimen.constraining) if face is not None]
    times = _NARROWEST_SHEARED if specimen.faces_shear else _NARROWEST
    narrowest_m = times * max(face.thickness_m for face in faces)
    n_x, n_y = (
        min(n, max(_LEAST_ELEMENTS, int(side / narrowest_m)))
        for n, side in zip(mesh, (specimen.length_m, specimen.width_m), strict=True)
    )
    return n_x, n_y
