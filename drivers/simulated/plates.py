"""The plant's plates as the world mounts them: outputs by the names of what hangs on them."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from drivers.arrays import Array
from drivers.simulated.climate import AMBIENT_C, Climate
from drivers.simulated.drive import DrivePiece
from drivers.simulated.plant.bare import Pulse, StruckPlate, bare_structure
from drivers.simulated.plant.effects import AddedMass, ByHand, Effects
from drivers.simulated.plant.mounted import Mounted
from drivers.simulated.plant.sandwich import sandwich
from drivers.simulated.plant.shaken import ShakenPlate
from drivers.simulated.plant.structure import Structure

_OUTPUTS = {"velocity": "spot_velocity", "response_acceleration": "acceleration"}
_CLAMPED_ANEW = 0.7
"""Standard deviation of a clamp's stiffness from one mounting to the next, in its logarithm."""
_LIFTS_S = 0.1
"""From being asked until the hammer strikes."""
_WIDTH_S = 1e-3
_PEAK_N = (60.0, 120.0)
_BOUNCE_S, _BOUNCE_SHARE = 0.04, 0.4


Mount = Callable[[Effects, ByHand], Mounted]
"""A treated plate with what it hides and what somebody has changed."""
Struck = Callable[[tuple[float, float], tuple[float, float], float], Structure]
"""A bare plate hit at one place and read at another by a sensor of some mass in kg."""


class OnShaker:
    """Whatever is driven by the base and read by the laser."""

    def __init__(self, plant: ShakenPlate, effects: Effects, climate: Climate | None = None) -> None:
        self.plant = plant
        self._effects, self._climate = effects, climate

    def drive(self, piece: DrivePiece) -> None:
        """The shaker's output from now on."""
        self.plant.drive(piece)

    def at(self, output: str, first_s: float, step_s: float, count: int) -> Array:
        """An output by its name; force and response are not there. Shape (count,)."""
        if output == "temperature":
            return self._temperature_c(np.asarray(first_s + step_s * np.arange(count), dtype=float))
        if output in ("force", "response_acceleration"):
            return np.zeros(count)
        return np.asarray(self.plant.at(first_s, step_s, count, (_OUTPUTS.get(output, output),))[0])

    def _temperature_c(self, t: Array) -> Array:
        climate, drift = self._climate, self._effects.temperature_drift
        there = np.array([climate.plate_c(s) for s in t.tolist()]) if climate else np.full(len(t), AMBIENT_C)
        if drift is None:
            return there
        return np.asarray(there + drift.kelvin * (1 - np.exp(-t / drift.time_constant_s)))


class DampedPlate(OnShaker):
    """The plate with its treatment, on the shaker."""

    def __init__(self, effects: Effects, climate: Climate | None = None, mount: Mount | None = None) -> None:
        """`mount` makes another plate than the published one."""
        self._mount = mount or (lambda effects, by_hand: sandwich(effects, by_hand=by_hand))
        self._by_hand = ByHand()
        super().__init__(self._made(effects, climate, self._by_hand), effects, climate)

    def _made(self, effects: Effects, climate: Climate | None, by_hand: ByHand) -> ShakenPlate:
        return ShakenPlate(effects, climate=climate, mounted=self._mount(effects, by_hand))

    def look_at(self, spot_m: tuple[float, float] | None) -> None:
        """Another spot than the specimen's; None for that. What still rings is at rest then.

        Raises `ValueError` for one off the plate.
        """
        self._change(replace(self._by_hand, spot_m=spot_m))

    def load(self, mass_kg: float, at_m: tuple[float, float]) -> None:
        """A known mass on it, and no other. Raises `ValueError` for one off the plate."""
        self._change(replace(self._by_hand, mass=AddedMass(mass_kg, *at_m)))

    def clamp(self) -> None:
        """Clamped anew: a clamp that gives does so by another stiffness, the same ones in every run."""
        self._change(replace(self._by_hand, mounting=self._by_hand.mounting + 1))

    def unload(self) -> None:
        """Nothing on it but what it hides."""
        self._change(replace(self._by_hand, mass=None))

    def _change(self, by_hand: ByHand) -> None:
        if by_hand != self._by_hand:
            effects = _clamped(self._effects, by_hand.mounting)
            self.plant = self._made(effects, self._climate, by_hand)
            self._by_hand = by_hand


def _clamped(effects: Effects, mounting: int) -> Effects:
    """With the clamp of a mounting, 0 for the first."""
    first = effects.clamp_compliance
    if first is None or not mounting:
        return effects
    times = float(np.exp(_CLAMPED_ANEW * np.random.default_rng(mounting).standard_normal()))
    other = replace(first, along_x_n_m3=times * first.along_x_n_m3, along_z_n_m3=times * first.along_z_n_m3)
    return replace(effects, clamp_compliance=other)


class SimulatedBarePlate:
    """The plate before its treatment, struck by a hammer that now and then bounces."""

    def __init__(
        self,
        effects: Effects,
        *,
        sensor_mass_kg: float,
        double_hit_every: int,
        seed: int,
        struck: Struck | None = None,
        softly: float = 1.0,
    ) -> None:
        """`struck` makes another plate than the published one; `softly`: its share of the blow."""
        self._softly = softly
        self._sensor_mass_kg = sensor_mass_kg
        self._struck = struck or (
            lambda hit_m, response_m, sensor_kg: bare_structure(effects, hit_m, response_m, sensor_kg)
        )
        self._double_hit_every = double_hit_every
        self._random = np.random.default_rng((seed, 1))
        self._hits = 0
        self.plant: StruckPlate | None = None

    def drive(self, piece: DrivePiece) -> None:
        """Not on the shaker."""

    def place(self, hit_m: tuple[float, float], response_m: tuple[float, float]) -> None:
        """Where the hammer strikes and the sensor sits."""
        structure = self._struck(hit_m, response_m, self._sensor_mass_kg)
        self.plant = StruckPlate(hit_m, response_m, structure=structure)

    def hit(self, now_s: float) -> None:
        """One blow soon, a little harder or softer than the last.

        Raises `ValueError` before it is known where to.
        """
        if self.plant is None:
            raise ValueError("nobody said where to hit")
        self._hits += 1
        peak = self._softly * float(self._random.uniform(*_PEAK_N))
        begin = now_s + _LIFTS_S
        self.plant.strike(Pulse(begin, _WIDTH_S, peak))
        if self._double_hit_every and self._hits % self._double_hit_every == 0:
            self.plant.strike(Pulse(begin + _BOUNCE_S, _WIDTH_S, _BOUNCE_SHARE * peak))

    def at(self, output: str, first_s: float, step_s: float, count: int) -> Array:
        """Force and the response sensor's acceleration; nothing else is there. Shape (count,)."""
        if output == "temperature":
            return np.full(count, AMBIENT_C)
        if self.plant is None or output not in ("force", "response_acceleration"):
            return np.zeros(count)
        return np.asarray(self.plant.at(first_s, step_s, count, (_OUTPUTS.get(output, output),))[0])
