"""A solid plate measured again: at another level or spot, heavier, clamped anew, bare, or struck."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache, reduce
from typing import Any

import numpy as np

from campaign.plates.cases import PlateTruth, measured
from campaign.plates.channel import ChannelError
from campaign.plates.geometry import TruePlate
from campaign.plates.hidden.attached import HiddenAddedMass
from campaign.plates.hidden.base import Hidden
from campaign.plates.hidden.clamp import HiddenClampCompliance, HiddenClampLine
from campaign.plates.judged import models_of
from campaign.plates.reduced import ReducedSolid
from campaign.plates.response import remaining_damping
from campaign.plates.schedule import takes_s
from campaign.plates.simulate import built, moduli_of, struck
from campaign.plates.stated import CAREFUL, STRUCK
from campaign.plates.struck import LEFT_BEHIND, lines_about, mobility, struck_plate
from campaign.schedule import Schedule
from fitting.arrays import Array
from fitting.specimen import PlacedMass, PlateSpecimen
from fitting.stated.tolerances import STATED
from fitting.structures import AnySpecimen
from fitting.sweep import Sweep
from instrument.facts.follow_up import FollowUp
from instrument.finding.diagnosis import Diagnosed, diagnose
from instrument.models.files import File
from instrument.models.set_up import Hammer

Place = tuple[float, float]
_PAUSE_S = 60.0
_SIDE_M = 8e-3
"""Of a mass that is put on."""
_TORQUE = 1 / 5
"""Over the first one's, of a clamp that is closed again."""
_BY_TORQUE = (0.4, 1.0)
"""A root face gives as its torque to a power between these: bodies in series with faces in contact."""
_AS_BEFORE = 0.15
"""In the logarithm: what a clamp closed to one torque differs by."""
_LINE_M = 9e-5
"""How well a plate comes back to its mark; the stated length is as good."""
_WRONG_EDGE_AGAIN = 0.5
_FORCE_M = 1e-3
"""How far from its mark a hammer hits, each coordinate."""
_LINES, _MODES = 20, 6
"""Of the spectrum of a blow, about each of so many resonances."""
_BLOWS, _BLOWS_FLOOR = (0.005, 0.015), 0.003
"""Scatter of what some blows averaged read: of a reading, and of the largest."""
_IN_THE_LASER = 0.5
"""Of faults of a channel, those of the velocity's; others are the accelerometer's: a blow leaves them."""


@lru_cache
def _models(plate: str, spot_mm: tuple[float, float]) -> PlateSpecimen:
    return replace(models_of(plate), pickup_m=(1e-3 * spot_mm[0], 1e-3 * spot_mm[1]))


@dataclass(frozen=True)
class RemeasuredPlate:
    """A plate on a rig, and what has been measured so far."""

    truth: PlateTruth
    schedule: Schedule
    files: tuple[File, ...]
    hammer: Hammer | None
    seconds: float
    """Of the first sweep."""

    @property
    def plate(self) -> ReducedSolid:
        """The reduced solid as it was built."""
        return self._built(self.truth)

    def diagnosed(self) -> Diagnosed:
        """Everything together."""
        return diagnose(self.files, self.hammer)

    def after(self, follow_up: FollowUp, rng: np.random.Generator) -> "RemeasuredPlate":
        """With one more measurement. Raises `ValueError` for one that it cannot make."""
        if follow_up.kind == "bare_hammer":
            test = struck(self.truth.plate, self.truth.effects, rng, CAREFUL.damping, yields=True)
            return replace(self, hammer=test.pair)
        if follow_up.kind in ("level", "frequencies", "reversed"):
            return self._more(follow_up, rng)
        if follow_up.kind == "spot":
            return self._at_spot(follow_up, rng)
        if follow_up.kind == "clamping":
            return self._clamped_anew(follow_up, rng)
        if follow_up.kind == "added_mass":
            return self._heavier(follow_up, rng)
        if follow_up.kind == "damped_struck" and follow_up.struck_mm is not None:
            return self._struck(follow_up, rng)
        raise ValueError(f"{follow_up.kind} cannot be measured here")

    @property
    def _stated(self) -> PlateSpecimen:
        stated = self.files[0].specimen
        assert isinstance(stated, PlateSpecimen)
        return stated

    def _built(self, truth: PlateTruth) -> ReducedSolid:
        return built(truth.plate, truth.effects, moduli_of(truth.law, self.schedule.frequency_hz))

    def _steps(self, follow_up: FollowUp) -> Schedule:
        f = np.array(follow_up.frequencies_hz)
        segment = np.array(follow_up.segments, dtype=np.intp)
        last = self.schedule
        when = last.time_s.max() + _PAUSE_S + np.cumsum(takes_s(f))
        level = np.full(len(f), follow_up.level_g)
        return Schedule(f, segment, last.sweep.max() + segment, level, when)

    def _more(self, follow_up: FollowUp, rng: np.random.Generator) -> "RemeasuredPlate":
        new = self._steps(follow_up)
        pairs = zip(_columns(self.schedule), _columns(new), strict=True)
        whole = Schedule(*(np.concatenate(pair) for pair in pairs))
        at = np.arange(len(whole.time_s)) >= len(self.schedule.time_s)
        sweep = measured(self.truth, self.plate, whole, rng).take(at)
        (first, *others) = self.files
        first = replace(first, sweep=_joined(first.sweep, sweep))
        return replace(self, schedule=whole, files=(first, *others))

    def _at_spot(self, follow_up: FollowUp, rng: np.random.Generator) -> "RemeasuredPlate":
        spot = _spot_of(follow_up)
        assert spot is not None
        # Half of those that measured from a wrong edge do it again.
        again = rng.random() < _WRONG_EDGE_AGAIN
        there = _aimed(self.truth, spot, rng, keep=again)
        steps = self._steps(follow_up)
        sweep = measured(there, self._built(there), steps, rng)
        near = _near(self.truth.plate, self._stated, spot)
        files = [replace(f, number=f.number or 1) for f in self.files]
        # Of the first file: what was mounted anew or made heavier is another one.
        more = File(sweep, replace(self._stated, pickup_m=spot), "", 1, None, near)
        return replace(self, files=_by_spot((*files, more)))

    def _heavier(self, follow_up: FollowUp, rng: np.random.Generator) -> "RemeasuredPlate":
        assert follow_up.mass_at_mm is not None
        assert follow_up.mass_kg is not None
        x, y = (1e-3 * at for at in follow_up.mass_at_mm)
        weighed = follow_up.mass_kg * float(np.exp(STATED["mass"].typical * rng.standard_normal()))
        # By a rule from the free end.
        longer = self.truth.plate.length_m - self._stated.length_m
        off = STATED["place"].typical * rng.standard_normal(2)
        at = x + longer + float(off[0]), y + float(off[1])
        patch = HiddenAddedMass(weighed, *at, _SIDE_M)
        there = replace(self.truth, effects=(*self.truth.effects, patch))
        sweep = measured(there, self._built(there), self._steps(follow_up), rng)
        masses = (PlacedMass(follow_up.mass_kg, x, y),)
        return self._and_file(sweep, replace(self._stated, masses=masses))

    def _clamped_anew(self, follow_up: FollowUp, rng: np.random.Generator) -> "RemeasuredPlate":
        """With a fifth of the torque: what gives then gives more, the line hardly moves."""
        stated = replace(self._stated, pickup_m=_spot_of(follow_up) or self._stated.pickup_m)
        assert stated.pickup_m is not None
        there = _aimed(self.truth, stated.pickup_m, rng, keep=False)
        held = float(np.exp(_AS_BEFORE * rng.standard_normal()))
        softer = held * _TORQUE ** float(rng.uniform(*_BY_TORQUE))
        line = HiddenClampLine(_LINE_M * float(rng.standard_normal()))
        there = replace(there, effects=(*(_softer(h, softer) for h in there.effects), line))
        steps = self._steps(follow_up)
        sweep = measured(there, self._built(there), steps, rng)
        like = _near(self.truth.plate, stated, stated.pickup_m) if follow_up.spot_mm is not None else None
        return self._and_file(sweep, stated, like)

    def _struck(self, follow_up: FollowUp, rng: np.random.Generator) -> "RemeasuredPlate":
        """By a hammer whose force is known to a percent, hung free or in the clamp of the first sweep."""
        assert follow_up.struck_mm is not None
        free, (x, y) = follow_up.held == "free", follow_up.struck_mm
        force = 1e-3 * x, 1e-3 * y
        stated = _stated_struck(self._stated, force, _spot_of(follow_up), free=free)
        assert stated.pickup_m is not None
        there = self.truth
        if free:
            there = _aimed(there, stated.pickup_m, rng, keep=rng.random() < _WRONG_EDGE_AGAIN)
        off = _FORCE_M * rng.standard_normal(2)
        hit = force[0] + float(off[0]), force[1] + float(off[1])
        if rng.random() > _IN_THE_LASER:
            there = replace(there, effects=tuple(h for h in there.effects if h.place != "velocity channel"))
        f = self.schedule.frequency_hz
        plate = struck_plate(there.plate, there.effects, moduli_of(there.law, f), hit, free=free)
        segment = self.schedule.segment
        C_1: Array | float = 0.0 if free else remaining_damping(plate, np.array(there.plate.ratios))
        if free:
            f, segment = lines_about(plate, there.law, float(f.min()), float(f.max()), _MODES, _LINES)
        spot = reduce(
            lambda s, h: h.spot(s, there.plate), _staying(there.effects, free=free), there.plate.spot_m
        )
        v = mobility(plate, there.law, f, hit, spot, C_1)
        omega = 2 * np.pi * f
        v = reduce(lambda s, h: h.channel(s, omega, 0 * s), there.effects, v)
        v = v * ChannelError.within(STRUCK, rng.standard_normal(3)).factor(omega)
        scatter = np.hypot(rng.uniform(*_BLOWS) * np.abs(v), _BLOWS_FLOOR * np.abs(v).max())
        v = v + scatter * (rng.standard_normal((len(f), 2)) @ np.array([1, 1j]))
        sweep = Sweep(f, v, np.ones(len(f)), segment, np.ones(len(f), np.intp))
        like = _struck_models(
            there.plate.name,
            _on_the_true(there.plate, self._stated, force),
            _on_the_true(there.plate, self._stated, stated.pickup_m),
            free=free,
        )
        return self._and_file(sweep, stated, like, struck=True)

    def _and_file(
        self,
        sweep: Sweep,
        specimen: PlateSpecimen,
        like: PlateSpecimen | None = None,
        *,
        struck: bool = False,
    ) -> "RemeasuredPlate":
        files = [replace(f, number=f.number or 1) for f in self.files]
        number = max(f.number for f in files) + 1
        more = File(sweep, specimen, "", number, None, like if struck else like or files[0].like)
        # It is struck in the first clamp, whatever was clamped since.
        every = (files[0], more, *files[1:]) if struck else (*files, more)
        return replace(self, files=_by_spot(every))


def _by_spot(files: tuple[File, ...]) -> tuple[File, ...]:
    """Spots numbered where there are several, as a run numbers them."""
    read = [_shaken_at(f.specimen) for f in files]
    spots = [at for at in dict.fromkeys(read) if at is not None]
    if len(spots) < 2:
        return files
    numbers = (None if at is None else spots.index(at) for at in read)
    return tuple(replace(f, pickup=k) for f, k in zip(files, numbers, strict=True))


def _shaken_at(specimen: AnySpecimen) -> Place | None:
    return specimen.pickup_m if isinstance(specimen, PlateSpecimen) and specimen.drive == "base" else None


def _staying(hidden: Sequence[Hidden], *, free: bool) -> list[Hidden]:
    return [h for h in hidden if not (free and h.place in LEFT_BEHIND)]


def _stated_struck(
    stated: PlateSpecimen, force_m: Place, spot_m: Place | None, *, free: bool
) -> PlateSpecimen:
    tolerances = {**stated.tolerances, "gain": STRUCK.gain}
    struck = replace(stated, force_m=force_m, pickup_m=spot_m or stated.pickup_m, tolerances=tolerances)
    return replace(struck, boundary="free", modal_ratios=()) if free else struck


@lru_cache
def _struck_models(plate: str, force_mm: Place, spot_mm: Place, *, free: bool) -> PlateSpecimen:
    force, spot = ((1e-3 * x, 1e-3 * y) for x, y in (force_mm, spot_mm))
    like = replace(models_of(plate), force_m=force, pickup_m=spot)
    return replace(like, boundary="free") if free else like


def _spot_of(follow_up: FollowUp) -> tuple[float, float] | None:
    at = follow_up.spot_mm
    return None if at is None else (1e-3 * at[0], 1e-3 * at[1])


def _softer(h: Hidden, times: float) -> Hidden:
    if not isinstance(h, HiddenClampCompliance):
        return h
    return replace(h, along_x_n_m3=times * h.along_x_n_m3, along_z_n_m3=times * h.along_z_n_m3)


def _aimed(
    truth: PlateTruth, spot_m: tuple[float, float], rng: np.random.Generator, *, keep: bool
) -> PlateTruth:
    """The laser aimed at a spot, from a wrong edge as before or not."""
    x, y = (s + CAREFUL.pickup_m * e for s, e in zip(spot_m, rng.standard_normal(2), strict=True))
    effects = tuple(h for h in truth.effects if keep or h.name != "spot_offset")
    return replace(truth, plate=replace(truth.plate, spot_m=(x, y)), effects=effects)


def _near(true: TruePlate, specimen: PlateSpecimen, spot: tuple[float, float]) -> PlateSpecimen:
    """Models of that spot that serve every statement of the plate: the same share of its length and width."""
    return _models(true.name, _on_the_true(true, specimen, spot))


def _on_the_true(true: TruePlate, specimen: PlateSpecimen, spot: Place) -> Place:
    """In mm, to a tenth."""
    shares = spot[0] / specimen.length_m, spot[1] / specimen.width_m
    return round(1e3 * shares[0] * true.length_m, 1), round(1e3 * shares[1] * true.width_m, 1)


def _columns(s: Schedule) -> tuple[np.ndarray[tuple[int], np.dtype[np.generic]], ...]:
    return s.frequency_hz, s.segment, s.sweep, s.level_g, s.time_s


def _joined(a: Sweep, b: Sweep) -> Sweep:
    names = ("frequency_hz", "velocity_m_s", "commanded_m_s2", "segment", "sweep", "base_m_s2", "time_s")
    both: dict[str, Any] = {n: np.concatenate([getattr(a, n), getattr(b, n)]) for n in names}
    return Sweep(**both)
