"""The plant's plates as the world mounts them: outputs by the names of what hangs on them."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from drivers.arrays import Array
from drivers.simulated.climate import AMBIENT_C, Climate
from drivers.simulated.drive import DrivePiece
from drivers.simulated.plant.bare import Pulse, StruckPlate, bare_structure
from drivers.simulated.plant.effects import AddedMass, ByHand, Effects
from drivers.simulated.plant.hung_plate import struck_where_it_stands
from drivers.simulated.plant.law import MaxwellLaw
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
_OFF_M = 1e-3
"""How far from its mark a blow lands, each coordinate."""


Mount = Callable[[Effects, ByHand], Mounted]
"""A treated plate with what it hides and what somebody has changed."""
Struck = Callable[[tuple[float, float], tuple[float, float], float], Structure]
"""A bare plate hit at one place and read at another by a sensor of some mass in kg."""
Hang = Callable[[Effects, MaxwellLaw, tuple[float, float], tuple[float, float]], Structure]
"""A treated plate without its clamp, its core under a law, hit at one place and read at another."""


class HammerInHand:
    """One blow after the other, a little harder or softer than the last; now and then it bounces."""

    def __init__(self, double_hit_every: int, seed: int, softly: float = 1.0) -> None:
        """`softly`: the share of a full blow."""
        self._double_hit_every, self._softly = double_hit_every, softly
        self._random = np.random.default_rng((seed, 1))
        self._aim = np.random.default_rng((seed, 2))
        self._hits = 0

    def lands_at(self, meant_m: tuple[float, float]) -> tuple[float, float]:
        """Where the next blow does, a little off its mark."""
        x, y = np.array(meant_m) + _OFF_M * self._aim.standard_normal(2)
        return float(x), float(y)

    def strike(self, plant: StruckPlate, now_s: float) -> None:
        """Soon."""
        self._hits += 1
        peak = self._softly * float(self._random.uniform(*_PEAK_N))
        begin = now_s + _LIFTS_S
        plant.strike(Pulse(begin, _WIDTH_S, peak))
        if self._double_hit_every and self._hits % self._double_hit_every == 0:
            plant.strike(Pulse(begin + _BOUNCE_S, _WIDTH_S, _BOUNCE_SHARE * peak))


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
    """The plate with its treatment, on the shaker; or struck, in its clamp or hung free."""

    def __init__(
        self,
        effects: Effects,
        climate: Climate | None = None,
        mount: Mount | None = None,
        hang: Hang | None = None,
        hand: HammerInHand | None = None,
    ) -> None:
        """`mount` makes another plate than the published one; without `hang` it cannot be hung free."""
        self._mount = mount or (lambda effects, by_hand: sandwich(effects, by_hand=by_hand))
        self._by_hand = ByHand()
        self._hang, self._hand = hang, hand or HammerInHand(0, 0)
        self._struck: StruckPlate | None = None
        self._free = False
        super().__init__(self._made(effects, climate, self._by_hand), effects, climate)

    def strike(self, hit_m: tuple[float, float], read_m: tuple[float, float] | None, *, free: bool) -> None:
        """Have it ready for blows at one place, the laser on another (None: where it is).

        Until it is mounted, clamped or aimed at anew. Raises `ValueError` for a place off the plate, and
        where it cannot be hung.
        """
        if free and (self._hang is None or read_m is None):
            raise ValueError("this plate cannot be hung free here")
        there = partial(self._hung, read_m=read_m) if free and read_m else self._standing
        # All that takes long, and all that is wrong, comes now and not with the first blow.
        self._struck = StruckPlate(hit_m, read_m or hit_m, structure=there(hit_m))
        self._meant_m, self._there, self._free = hit_m, there, free

    def drive(self, piece: DrivePiece) -> None:
        """The shaker's output from now on; what it drives in its clamp is struck no more."""
        if not self._free and (piece.amplitude_v or piece.slope_v_s):
            self._struck = None
        super().drive(piece)

    def _hung(self, hit_m: tuple[float, float], read_m: tuple[float, float]) -> Structure:
        assert self._hang is not None
        return self._hang(self._effects, self.plant.law, hit_m, read_m)

    def _standing(self, hit_m: tuple[float, float]) -> Structure:
        # A spot where the hammer strikes reads what its force pushes.
        effects = replace(_clamped(self._effects, self._by_hand.mounting), spot_offset=None)
        there = self._mount(effects, replace(self._by_hand, spot_m=hit_m)).structure
        return struck_where_it_stands(self.plant.plate.structure, self.plant.law, there.readings[0])

    def hit(self, now_s: float) -> None:
        """One blow, once it has come to rest. Raises `ValueError` before it is known where to."""
        if self._struck is None:
            raise ValueError("nobody said where to hit the damped plate")
        at = self._hand.lands_at(self._meant_m)
        self._struck = StruckPlate(at, at, structure=self._there(at))
        self._hand.strike(self._struck, now_s)

    def at(self, output: str, first_s: float, step_s: float, count: int) -> Array:
        """An output as on the shaker; while the plate is struck the base rests. Shape (count,)."""
        if self._struck is None or output == "temperature":
            return super().at(output, first_s, step_s, count)
        if output not in ("velocity", "force"):
            return np.zeros(count)
        return np.asarray(self._struck.at(first_s, step_s, count, (output,))[0])

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
        self._struck, self._free = None, False
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
        self._sensor_mass_kg = sensor_mass_kg
        self._struck = struck or (
            lambda hit_m, response_m, sensor_kg: bare_structure(effects, hit_m, response_m, sensor_kg)
        )
        self._hand = HammerInHand(double_hit_every, seed, softly)
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
        self._hand.strike(self.plant, now_s)

    def at(self, output: str, first_s: float, step_s: float, count: int) -> Array:
        """Force and the response sensor's acceleration; nothing else is there. Shape (count,)."""
        if output == "temperature":
            return np.full(count, AMBIENT_C)
        if self.plant is None or output not in ("force", "response_acceleration"):
            return np.zeros(count)
        return np.asarray(self.plant.at(first_s, step_s, count, (_OUTPUTS.get(output, output),))[0])
