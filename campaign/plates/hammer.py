"""What a hammer test of a bare plate gives. It is clamped anew: its softness is not that of the sweep."""

from dataclasses import dataclass

import numpy as np

from campaign.plates.reduced import ReducedSolid
from fitting.arrays import Array

FREQUENCY_SCATTER = 3e-4
MODES = 8
_RIGID_SHARE = 0.5
_MOST_SOFT = 0.004
"""Fall of mode 1 in a clamp that yields."""


@dataclass(frozen=True)
class HammerTest:
    """Natural frequencies in Hz and damping ratios. Shape (modes,) each."""

    frequency_hz: Array
    ratios: Array

    @property
    def pair(self) -> tuple[Array, Array]:
        """As `diagnose` and `identify` take it."""
        return self.frequency_hz, self.ratios


def hammer_test(
    rng: np.random.Generator,
    rigid: ReducedSolid,
    sprung: ReducedSolid,
    ratios: Array,
    ratio_scatter: float,
    yields: bool = True,
) -> HammerTest:
    """A test of the plate whose models in a rigid and in a softer clamp are given.

    `ratios` of shape (modes,).
    """
    f, soft = (np.sqrt(plate.modes(0.0, MODES)[0]) / (2 * np.pi) for plate in (rigid, sprung))
    drop = 0.0 if rng.random() < _RIGID_SHARE or not yields else float(rng.uniform(0, _MOST_SOFT))
    fall = np.log(soft / f)
    f = f * np.exp(-drop * fall / fall[0])
    scatter = rng.standard_normal((2, MODES))
    return HammerTest(
        f * np.exp(FREQUENCY_SCATTER * scatter[0]), ratios[:MODES] * np.exp(ratio_scatter * scatter[1])
    )
