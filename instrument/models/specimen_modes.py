"""Complex modes of a plate, from the cache or computed."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.digits import two_digits
from fitting.dynamics.bare_modes import bare_modes
from fitting.dynamics.complex_modes import ModalValue, ModalValues, complex_modes
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from instrument.models.cache import cached
from instrument.progress import Progress, quiet

_WORTH_SAYING = 5e-4
"""Of a frequency: the plate's own mesh is good for less. A choice."""


def specimen_modes(specimen: PlateSpecimen, count: int, progress: Progress = quiet) -> list[ModalValue]:
    """The first `count` elastic modes with the specimen's own law. Raises `OutsideModel`."""
    law = specimen.core.law if specimen.core is not None else None

    def build() -> ModalValues:
        with progress("modes") as report:
            found = complex_modes(Plate(specimen), law, count, report)
        return ModalValues(np.array([m.eigenvalue for m in found]))

    return cached("modes", [specimen, count], ModalValues, build).each


@dataclass(frozen=True)
class EdgeFalls:
    """By how much free edges that carry no twist lower each frequency, relative. Shape (modes,)."""

    falls: Array


def edge_twist_remark(specimen: PlateSpecimen, count: int) -> str:
    """What `specimen_modes` of a bare plate leave out at its free edges; empty where that is nothing."""
    if specimen.core is not None or specimen.lacks_edge_twist:
        return ""
    of_each = cached(
        "edge-twist",
        [specimen, count],
        EdgeFalls,
        lambda: EdgeFalls(bare_modes(Plate(specimen), count)[1]),
    ).falls
    most = int(np.argmax(of_each))
    if of_each[most] < _WORTH_SAYING:
        return ""
    return (
        "these are of plate theory: a solid's free edges carry no twist, which takes up to "
        f"{two_digits(100 * of_each[most])} % off a frequency (mode {most + 1})"
    )
