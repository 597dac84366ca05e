"""A free solid plate struck at points and read at others: mobilities, phasors of e^{i w t}."""

from collections.abc import Sequence

import numpy as np

from drivers.simulated.plant.one_thread import one_thread
from fitting.arrays import Array, Complex
from instrument.campaign.plates.geometry import TruePlate
from instrument.campaign.plates.grid import Fineness
from instrument.campaign.plates.materials import PlateMaterialLaw
from instrument.campaign.plates.reduced import reduced
from instrument.campaign.plates.simulate import moduli_of
from instrument.campaign.plates.solid import Build, Patch, Solid

Points = Sequence[tuple[float, float]]


@one_thread
def mobilities(
    true: TruePlate,
    law: PlateMaterialLaw,
    frequency_hz: Array,
    forces_m: Points,
    spots_m: Points,
    patches: tuple[Patch, ...] = (),
    fineness: Fineness | None = None,
) -> Complex:
    """Velocity of the upper face at each spot for 1 N at each point of a free plate, in m/s.

    Its remaining damping is left out. Shape (forces, spots, points).
    """
    solid = Solid(true, Build(free=True, patches=patches), fineness)
    plate = reduced(solid, moduli_of(law, frequency_hz), points_m=[*forces_m, *spots_m])
    push, read = (np.array([plate.reading(*at) for at in points]) for points in (forces_m, spots_m))
    found = np.empty((len(forces_m), len(spots_m), len(frequency_hz)), complex)
    for k, w in enumerate(2 * np.pi * frequency_hz):
        Z = plate.K_0 + law.modulus(w) * plate.whole_core - w**2 * plate.M
        found[:, :, k] = 1j * w * (read @ np.linalg.solve(Z, push.T.astype(complex))).T
    return found
