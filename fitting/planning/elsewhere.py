"""A plate that is read at another spot, on the basis that was made for the first: good to 1e-3."""

from dataclasses import replace

from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.mesh import Mesh
from fitting.nuisances import Nuisances
from fitting.reduced import ReducedPlate
from fitting.specimen import Specimen

Place = tuple[float, float]


def read_elsewhere(
    plate: EnrichedReducedPlate, reduced: ReducedPlate, nuisances: Nuisances, spot_m: Place
) -> tuple[EnrichedReducedPlate, ReducedPlate, Nuisances]:
    """All three, read at a spot of the specimen as it is stated.

    What an effect moves of the reading it moves from where the plate is read: a row of stated numbers alone,
    from the first spot to the other, would leave that behind.
    """
    stated, like = nuisances.specimen, nuisances.reference
    assert isinstance(stated, Specimen)
    assert isinstance(like, Specimen)
    there = (spot_m[0] * like.length_m / stated.length_m, spot_m[1] * like.width_m / stated.width_m)
    mesh = Mesh(plate.length_m, plate.width_m, int(plate.size[2]), int(plate.size[3]))
    row = EnrichedReducedPlate.plain(reduced, mesh, there).row(*there)
    moved = replace(nuisances, specimen=replace(stated, pickup_m=spot_m), like=replace(like, pickup_m=there))
    return plate.at(None, there), replace(reduced, observe=row), moved
