"""Whether the layer-wise theory holds for a law over a band: refused or remarked on where it does not."""

from collections.abc import Sequence

import numpy as np

from fitting.arrays import Array
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.specimen import Specimen
from fitting.structures import AnySpecimen, Beam
from fitting.theory_error import TheoryError, check_theory

_PLACES = 10
"""Frequencies of a band that are looked at: the error is smooth in frequency."""


def check_each_theory(specimens: Sequence[AnySpecimen], law: CoreLaw, bands_hz: Sequence[Array]) -> None:
    """Raise `OutsideModel` where the theory of layers does not hold for one: of plates and sandwich beams.

    `bands_hz` are the frequencies of each, of any shape.
    """
    for specimen, frequency_hz in zip(specimens, bands_hz, strict=True):
        layers = specimen.as_plate if isinstance(specimen, Beam) else specimen
        if isinstance(layers, Specimen):
            theory_over(layers, law, frequency_hz)


def theory_over(specimen: Specimen, law: CoreLaw, frequency_hz: Array) -> TheoryError:
    """The theory's error over the band of some frequencies, of any shape.

    Raises `OutsideModel` beyond its limits.
    """
    low, high = float(np.min(frequency_hz)), float(np.max(frequency_hz))
    return check_theory(specimen, law, np.geomspace(low, high, _PLACES if high > low else 1))


def theory_remark(specimen: Specimen, law: CoreLaw | None, frequency_hz: Array) -> str:
    """What would be refused, in a line; empty where the theory holds or the plate has no core.

    Over the band of `frequency_hz`, of any shape.
    """
    if specimen.core is None or law is None:
        return ""
    try:
        theory_over(specimen, law, frequency_hz)
    except OutsideModel as error:
        return str(error)
    return ""
