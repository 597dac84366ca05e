"""Rooms as campaigns hide them: one whose air conditioning goes on and off, one that was left overnight."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from campaign.draws import either_sign, log_uniform
from campaign.plates.hidden.sizes import ACTIVATION_J_MOL
from campaign.schedule import Schedule
from fitting.arrays import Array

GAS_J_MOL_K = 8.314
ROOM_K = 296.0
_SHORTEST_S = 120.0
"""Of a cycle: an air conditioning does not go on and off within less."""
_CYCLES, _UP = (1.2, 6.0), (0.3, 0.7)
"""Cycles within a sweep; share of each in which it warms."""
_SWING_K = (0.4, 1.5)
"""Of the core, either way: half of a room's, or less."""
_SHORTEST_DAY_S, _PAUSES = 600.0, (1.5, 60.0)
"""Pauses over the sweep's own duration, or this where it is shorter: a break to some days."""
_ANOTHER_DAY_K = (0.7, 3.5)
"""What a room is warmer or colder by another day."""


def arrhenius(kelvin: Array, activation_j_mol: float) -> Array:
    """Factor on the frequency at which a law is read, so much warmer than the room. Shape of `kelvin`."""
    return np.asarray(np.exp(activation_j_mol / GAS_J_MOL_K * (1 / (ROOM_K + kelvin) - 1 / ROOM_K)))


@dataclass(frozen=True)
class RoomCycles:
    """The core's temperature over time: up and down in straight lines, one longer than the other.

    No sine, nor evenly up and down.
    """

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
    period = max(duration_s / log_uniform(rng, *_CYCLES), _SHORTEST_S)
    shape = float(rng.uniform(0, 1)), float(rng.uniform(*_UP))
    return (float(rng.uniform(*_SWING_K)), period, *shape, float(rng.uniform(*ACTIVATION_J_MOL)))


@dataclass(frozen=True)
class RoomStep:
    """A sweep that was gone on with another day, its room at another temperature."""

    kelvin: float
    after_pass: int
    pause_s: float
    """Longer than the passes before it took."""
    activation_j_mol: float

    name: ClassVar[str] = "room_step"
    near: ClassVar[tuple[str, ...]] = ("temperature_drift",)
    on_request: ClassVar[bool] = True

    def paused(self, schedule: Schedule) -> Schedule:
        """Points of a schedule, those of later passes after the pause."""
        later = schedule.sweep > self.after_pass
        return replace(schedule, time_s=schedule.time_s + np.where(later, self.pause_s, 0.0))

    def warmed(self, time_s: Array) -> Array:
        """Factor on the frequency at which the law is read. Shape of `time_s`."""
        return arrhenius(np.where(time_s > self.pause_s, self.kelvin, 0.0), self.activation_j_mol)


def draw_step(rng: np.random.Generator, duration_s: float, passes: int) -> tuple[float, int, float, float]:
    """Numbers of `RoomStep` that matter."""
    after = int(rng.integers(1, passes))
    pause = max(duration_s, _SHORTEST_DAY_S) * log_uniform(rng, *_PAUSES)
    return either_sign(rng, *_ANOTHER_DAY_K), after, pause, float(rng.uniform(*ACTIVATION_J_MOL))
