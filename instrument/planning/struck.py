"""What a hammer test of the bare plate would be compared with, before it is made."""

from dataclasses import replace

import numpy as np

from fitting.diagnosis.inference.evidence import BareModes
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.dynamics.bare_modes import bare_modes
from fitting.identification.bare_plate import match_modes
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from instrument.models.set_up import bare_of

_COARSE = (18, 12)
"""Elements along x and y."""
_MODES = 6
"""That a hammer finds of a clamped plate without trouble."""


def bare_modes_expected(member: DiagnosisProblem) -> BareModes | None:
    """Of the plate as stated; None where it has no bare plate to be clamped and struck."""
    specimen = member.nuisances.specimen
    if not isinstance(specimen, PlateSpecimen) or specimen.boundary != "cantilever":
        return None
    # A coarse mesh does: shares of energy are asked for, not frequencies.
    specimen = replace(specimen, elements=_COARSE)
    modes, edge = bare_modes(Plate(specimen.bare), _MODES)
    hz = modes.omega * (1 - edge) / (2 * np.pi)
    return bare_of(match_modes(specimen, hz, np.full(len(hz), np.nan)), specimen)
