"""A reduced plate with its stated numbers moved, by the parts of its matrices: nothing is made anew."""

from dataclasses import replace

import numpy as np

from fitting.arrays import Array
from fitting.nuisances.nuisances import Nuisances
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.widened.enriched_plate import EnrichedReducedPlate


def moved_plate(
    reduced: ReducedPlate, nuisances: Nuisances, plate: EnrichedReducedPlate, z: Array
) -> ReducedPlate:
    """A reduced plate with its stated numbers moved; `plate` has the same columns.

    `z` of shape (numbers,).
    """
    change = nuisances.change(plate, z)
    damping = change.damping[reduced.mode] if np.ndim(change.damping) else change.damping
    return replace(
        reduced,
        M=reduced.M + change.M,
        K_0=reduced.K_0 + change.K,
        K_1=reduced.K_1 + change.K_1,
        load=reduced.load + change.load,
        observe=reduced.observe + change.observe,
        d=reduced.d * damping,
    )
