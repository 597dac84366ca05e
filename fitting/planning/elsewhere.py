"""A plate read at another spot, or struck, on the basis that was made for the first: good to 1e-3."""

from dataclasses import replace

import numpy as np

from fitting.arrays import Array, Place
from fitting.nuisances.nuisance import Nuisance
from fitting.nuisances.nuisances import Nuisances
from fitting.plate.mesh import Mesh
from fitting.plate.plate_numbers import tolerance
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen
from fitting.widened.enriched_plate import EnrichedReducedPlate


def read_elsewhere(
    plate: EnrichedReducedPlate, reduced: ReducedPlate, nuisances: Nuisances, spot_m: Place
) -> tuple[EnrichedReducedPlate, ReducedPlate, Nuisances]:
    """All three, read at a spot of the specimen as it is stated.

    What an effect moves of the reading it moves from where the plate is read: a row of stated numbers alone,
    from the first spot to the other, would leave that behind.
    """
    stated, like, there = _placed(nuisances, spot_m)
    row = _row(plate, reduced, there)
    moved = replace(nuisances, specimen=replace(stated, pickup_m=spot_m), like=replace(like, pickup_m=there))
    return plate.at(None, there), replace(reduced, observe=row), moved


def struck(
    plate: EnrichedReducedPlate,
    reduced: ReducedPlate,
    nuisances: Nuisances,
    point_m: Place,
    gain: float,
) -> tuple[EnrichedReducedPlate, ReducedPlate, Nuisances]:
    """All three, driven by a force at a point of the specimen as stated, its base at rest, read as before.

    What is read of a force at a point is what the point reads of a force where it is read, which the basis
    answers: as far as the plate's motions go, even ones for a plate that a base drove. `gain`: standard
    deviation of the new channel's, relative.
    """
    stated, like, there = _placed(nuisances, point_m)
    assert stated.pickup_m is not None
    row = _row(plate, reduced, there)
    aimed = tolerance(stated, "force")
    each = tuple(replace(n, sigma=max(n.sigma, gain)) if n.kind == "gain" else n for n in nuisances.each)
    points = tuple(Nuisance(f"force_{axis}", "force", aimed) for axis in "xy" if aimed > 0)
    moved = replace(
        nuisances,
        specimen=replace(stated, force_m=point_m),
        each=(*each, *points),
        like=replace(like, force_m=there),
    )
    at_rest = replace(
        plate.at(there, tuple(plate.pickup.tolist())),
        pitch=np.zeros_like(plate.pitch),
        load_part=np.zeros_like(plate.load_part),
    )
    return at_rest, replace(reduced, load=row, load_part=np.zeros_like(reduced.load_part)), moved


def _placed(nuisances: Nuisances, spot_m: Place) -> tuple[PlateSpecimen, PlateSpecimen, Place]:
    """What is stated, what the model is of, and a spot of the one on the other."""
    stated, like = nuisances.specimen, nuisances.reference
    assert isinstance(stated, PlateSpecimen)
    assert isinstance(like, PlateSpecimen)
    there = (spot_m[0] * like.length_m / stated.length_m, spot_m[1] * like.width_m / stated.width_m)
    return stated, like, there


def _row(plate: EnrichedReducedPlate, reduced: ReducedPlate, there: Place) -> Array:
    mesh = Mesh(plate.length_m, plate.width_m, int(plate.size[2]), int(plate.size[3]))
    return EnrichedReducedPlate.plain(reduced, mesh, there).row(*there)
