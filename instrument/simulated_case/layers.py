"""Layers and laws of a specimen file as the plant takes them."""

import numpy as np

from drivers.simulated.plant.law import MaxwellLaw, maxwell_series
from drivers.simulated.plant.layered_solid import Sheet
from fitting.laws import CoreLaw
from fitting.stated.layers import Core, Face


def face_sheet(face: Face) -> Sheet:
    """An elastic layer."""
    return Sheet(face.thickness_m, face.young_pa, face.poisson, face.density_kg_m3, face.loss_factor)


def core_sheet(core: Core) -> Sheet:
    """The core for unit shear modulus."""
    return Sheet(core.thickness_m, 2 * (1 + core.poisson), core.poisson, core.density_kg_m3)


def series_of(law: CoreLaw) -> MaxwellLaw:
    """What moves in time: a series nearest to the law."""
    return maxwell_series(lambda omega: law.modulus(np.atleast_1d(np.asarray(omega, dtype=float))))
