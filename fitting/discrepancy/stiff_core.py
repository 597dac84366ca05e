"""What a stiff core asks of a plate's model: faces that shear, and smaller elements beside its edges.

What thick faces ask of it: elements that are not too small.
"""

from dataclasses import replace

import numpy as np

from fitting.discrepancy.mesh_error import fine_enough
from fitting.plate.edge_twist import wide_enough
from fitting.plate.face_shear import with_face_shear
from fitting.specimen import PlateSpecimen

_AT_HZ = 1e3
"""Where the stated law says how stiff a core is. A judgement: most resonances that are measured lie below."""


def for_its_core(plate: PlateSpecimen) -> PlateSpecimen:
    """The plate with all that, where the law it states makes its core so stiff; elements stated stay."""
    finer = None
    if plate.core is not None:
        modulus_pa = abs(complex(plate.core.law.modulus(np.array(2 * np.pi * _AT_HZ))))
        plate = with_face_shear(plate, modulus_pa)
        finer = fine_enough(plate, modulus_pa)
    if plate.elements is not None:
        return plate
    elements = wide_enough(plate, finer or plate.mesh)
    return plate if elements == plate.mesh else replace(plate, elements=elements)
