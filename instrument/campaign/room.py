"""A room whose air conditioning goes on and off, as campaigns hide it: no sine, nor evenly up and down."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from fitting.arrays import Array
from instrument.campaign.draws import log_uniform

GAS_J_MOL_K = 8.314
ROOM_K = 296.0
_SHORTEST_S = 120.0


def arrhenius(kelvin: Array, activation_j_mol: float) -> Array:
    """Factor on the frequency at which a law is read, so much warmer than the room. Shape of `kelvin`."""
    return np.asarray(np.exp(activation_j_mol / GAS_J_MOL_K * (1 / (ROOM_K + kelvin) - 1 / ROOM_K)))


@dataclass(frozen=True)
class RoomCycles:
    """The core's temperature over time: up and down in straight lines, one longer than the other."""

    swing_k: float
    """Half of the way from the coldest to the warmest."""
    period_s: float
    begun: float
    """Share of a period that is over when the sweep begins."""
    up: float
    """Share of a period in which it warms."""
    activation_j_mol: float

    name: ClassVar[str] = "room_cycles"
    near: ClassVar[tuple[str, ...]] = ("temperature_drift",)
    in_catalogue: ClassVar[bool] = False
    on_request: ClassVar[bool] = True

    def kelvin(self, time_s: Array) -> Array:
        """About its mean. Shape of `time_s`."""
        share = (time_s / self.period_s + self.begun) % 1.0
        return np.asarray(self.swing_k * (2 * np.interp(share, [0, self.up, 1], [0, 1, 0]) - 1))


def draw_cycles(rng: np.random.Generator, duration_s: float) -> tuple[float, float, float, float, float]:
    """Numbers of `RoomCycles` that matter: of core temperatures, which follow a room's by half or less."""
    period = max(duration_s / log_uniform(rng, 1.2, 6.0), _SHORTEST_S)
    shape = float(rng.uniform(0, 1)), float(rng.uniform(0.3, 0.7))
    return (float(rng.uniform(0.4, 1.5)), period, *shape, float(rng.uniform(70e3, 130e3)))
