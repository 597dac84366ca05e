"""Where the specimen file puts the bare plate's modes, before anything is measured."""

import numpy as np

from fitting.arrays import Array
from fitting.dynamics.bare_modes import CarriedSensor, bare_modes
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen

_COUNT = 12


def expected_modes_hz(specimen: PlateSpecimen, sensor: CarriedSensor | None, below_hz: float) -> Array:
    """Natural frequencies of the bare plate as stated, the sensor on it; the first twelve at most.

    In vacuum, in an ideal clamp: a real one lowers them by up to a percent. Shape (modes,).
    """
    plate = Plate(specimen.bare)
    modes, edge = bare_modes(plate, _COUNT, sensor)
    f = modes.omega * (1 - edge) / (2 * np.pi)
    return np.asarray(f[f < below_hz])
