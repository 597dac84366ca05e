"""Complex modes of a plate, from the cache or computed."""

import numpy as np

from fitting.complex_modes import ModalValue, ModalValues, complex_modes
from fitting.plate import Plate
from fitting.specimen import Specimen
from instrument.models.cache import cached
from instrument.progress import Progress, quiet


def specimen_modes(specimen: Specimen, count: int, progress: Progress = quiet) -> list[ModalValue]:
    """The first `count` elastic modes with the specimen's own law. Raises `OutsideModel`."""
    law = specimen.core.law if specimen.core is not None else None

    def build() -> ModalValues:
        with progress("modes") as report:
            found = complex_modes(Plate(specimen), law, count, report)
        return ModalValues(np.array([m.eigenvalue for m in found]))

    return cached("modes", [specimen, count], ModalValues, build).each
