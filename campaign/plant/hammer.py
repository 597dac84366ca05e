"""What a hammer test of the plant's bare plate gives."""

import numpy as np

from drivers.simulated.plant.bare import StruckPlate
from drivers.simulated.plant.effects import Effects
from fitting.arrays import Array

FREQUENCY_SCATTER = 3e-4
RATIO_SCATTER = 5e-3
_MODES = 8
_HIT_M, _SENSOR_M = (0.285, 0.025), (0.270, 0.170)


def hammer_test(effects: Effects, rng: np.random.Generator) -> tuple[Array, Array]:
    """Natural frequencies in Hz and damping ratios, with scatter. Shape (modes,) each.

    The bare plate shares the metal and the air with the treated one. Its clamping is another mounting,
    and its ratios are its own: `viscous_damping` says that they do not carry over.
    """
    shared = Effects(substrate_stiffness=effects.substrate_stiffness, air_added_mass=effects.air_added_mass)
    frequency_hz, ratio = StruckPlate(_HIT_M, _SENSOR_M, effects=shared).modes(_MODES)
    scatter = rng.standard_normal((2, _MODES))
    return frequency_hz * (1 + FREQUENCY_SCATTER * scatter[0]), ratio * (1 + RATIO_SCATTER * scatter[1])
