"""Structures other than the plate: small matrices of the same equation (decision 25)."""

from fitting.specimen import PlateSpecimen
from fitting.structures.beam import Beam
from fitting.structures.shear_pair import ShearPair

AnySpecimen = PlateSpecimen | ShearPair | Beam
"""What a specimen file may describe."""

__all__ = ["AnySpecimen", "Beam", "ShearPair"]
