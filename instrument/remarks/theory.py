"""Whether the layer-wise theory holds for a law over a band: refused or remarked on where it does not."""

from collections.abc import Sequence

import numpy as np

from fitting.arrays import Array
from fitting.digits import written_out
from fitting.discrepancy.theory_error import TheoryError, check_beam_theory, check_theory, refusal
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.plate.face_shear import COUNTED_ABOVE, share_of_faces
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen, Beam

_PLACES = 10
"""Frequencies of a band that are looked at: the error is smooth in frequency."""

_WORTH_SAYING = 2.0
"""Times `COUNTED_ABOVE`: faces that take less of the slip put G' off by half a percent. A choice."""


def check_each_theory(
    specimens: Sequence[AnySpecimen], law: CoreLaw, bands_hz: Sequence[Array]
) -> tuple[str, ...]:
    """Raise `OutsideModel` where the theory of layers does not hold for one: of plates and sandwich beams.

    A beam is measured over decades and each resonance weighed by what the theory gets wrong there: it is
    refused where it holds at none, and what is said is where it does not. `bands_hz` are the frequencies of
    each, of any shape.
    """
    said = []
    for specimen, frequency_hz in zip(specimens, bands_hz, strict=True):
        if isinstance(specimen, PlateSpecimen):
            theory_over(specimen, law, frequency_hz)
            said.append(stiffer_than_stated(specimen, law, frequency_hz))
        elif isinstance(specimen, Beam) and specimen.as_plate is not None:
            said.append(_of_beam(specimen.as_plate, law, frequency_hz))
    return tuple(text for text in dict.fromkeys(said) if text)


def _of_beam(layers: PlateSpecimen, law: CoreLaw, frequency_hz: Array) -> str:
    f = np.geomspace(np.min(frequency_hz), np.max(frequency_hz), 4 * _PLACES)
    error = check_beam_theory(layers, law, f)
    if error.acceptable:
        return ""
    last = f[np.argmax(error.excess > 1) - 1]
    return f"{refusal(error, 'beam')}; resonances above {last:.3g} Hz count by so much less"


def theory_over(specimen: PlateSpecimen, law: CoreLaw, frequency_hz: Array) -> TheoryError:
    """The theory's error over the band of some frequencies, of any shape.

    Raises `OutsideModel` beyond its limits.
    """
    low, high = float(np.min(frequency_hz)), float(np.max(frequency_hz))
    return check_theory(specimen, law, np.geomspace(low, high, _PLACES if high > low else 1))


def stiffer_than_stated(specimen: PlateSpecimen, law: CoreLaw, frequency_hz: Array) -> str:
    """A line where faces shear about the core found, and were not counted to about the one stated; or empty.

    Over the band of `frequency_hz`, of any shape.
    """
    if specimen.core is None or specimen.faces_shear or specimen.patches:
        return ""
    f = np.geomspace(np.min(frequency_hz), np.max(frequency_hz), _PLACES)
    modulus_pa = float(np.abs(law.modulus(2 * np.pi * f)).max())
    taken = share_of_faces(specimen, modulus_pa)
    if taken < _WORTH_SAYING * COUNTED_ABOVE:
        return ""
    core, faces = written_out(modulus_pa / 1e6, 2), written_out(100 * taken, 1)
    return (
        f"core of {core} MPa: its faces take {faces} % of the slip by their own "
        "shear, which is not counted beside a core as soft as stated: write the law found into "
        "[core.law] and run it again"
    )


def theory_remark(specimen: PlateSpecimen, law: CoreLaw | None, frequency_hz: Array) -> str:
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
