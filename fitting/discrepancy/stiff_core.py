"""What a stiff core asks of a plate's model: faces that shear, and smaller elements beside its edges."""

from dataclasses import replace

import numpy as np

from fitting.discrepancy.mesh_error import fine_enough
from fitting.plate.face_shear import with_face_shear
from fitting.specimen import PlateSpecimen

_AT_HZ = 1e3
"""Where the stated law says how stiff a core is. A judgement: most resonances that are measured lie below."""


def for_its_core(plate: PlateSpecimen) -> PlateSpecimen:
    """The plate with both, where the law it states makes its core so stiff; elements stated stay."""
    if plate.core is None:
        return plate
    modulus_pa = abs(complex(plate.core.law.modulus(np.array(2 * np.pi * _AT_HZ))))
    plate = with_face_shear(plate, modulus_pa)
    return replace(plate, elements=plate.elements or fine_enough(plate, modulus_pa))
