"""A session's points as files under one law: one a clamping, known mass on the plate and spot."""

from collections.abc import Sequence

import numpy as np

from fitting.specimen import Specimen
from fitting.structures import AnySpecimen
from fitting.sweep import Sweep
from instrument.models.files import File, spots_of
from instrument.session.points import by_mounting, with_spots
from instrument.stream.derived import PointMeasured


def files_of(sweep: Sweep, points: Sequence[PointMeasured], specimen: AnySpecimen) -> list[File]:
    """`sweep` is of these points. One file where the plate was as the specimen says throughout."""
    if not isinstance(specimen, Specimen):
        return [File(sweep, specimen)]
    plate = with_spots(specimen, points)
    return [
        file
        for number, (places, with_mass) in enumerate(by_mounting(points, plate), start=1)
        for file in spots_of(sweep.take(np.array(places)), with_mass, "", number)
    ]
