"""A solid plate that can be measured again: at another level or spot, heavier, clamped anew, or bare."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from fitting.specimen import PlacedMass, Specimen
from fitting.sweep import Sweep
from fitting.tolerances import STATED
from instrument.campaign.plates.cases import PlateTruth, measured
from instrument.campaign.plates.geometry import TruePlate
from instrument.campaign.plates.hidden import HIDDEN
from instrument.campaign.plates.hidden.base import Hidden
from instrument.campaign.plates.hidden.clamp import HiddenClampCompliance, HiddenClampLine
from instrument.campaign.plates.judged import models_of
from instrument.campaign.plates.reduced import ReducedSolid
from instrument.campaign.plates.simulate import built, moduli_of, struck
from instrument.campaign.plates.stated import CAREFUL
from instrument.campaign.schedule import Schedule
from instrument.facts.follow_up import FollowUp
from instrument.models.diagnosis import Diagnosed, diagnose
from instrument.models.files import File
from instrument.models.set_up import Hammer
from instrument.models.together import diagnose_together

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


@lru_cache
def _models(plate: str, spot_mm: tuple[float, float]) -> Specimen:
    return replace(models_of(plate), pickup_m=(1e-3 * spot_mm[0], 1e-3 * spot_mm[1]))


@dataclass(frozen=True)
class SimulatedRig:
    """A plate on a rig, and what has been measured so far."""

    truth: PlateTruth
    schedule: Schedule
    files: tuple[File, ...]
    hammer: Hammer | None
    seconds: float
    """Of the first sweep."""

    @property
    def plate(self) -> ReducedSolid:
        """As built."""
        return self._built(self.truth)

    def diagnosed(self) -> Diagnosed:
        """Everything together."""
        if len(self.files) > 1:
            return diagnose_together(self.files, hammer=self.hammer).found
        (one,) = self.files
        return diagnose(one.sweep, self._stated, self.hammer, like=one.like)

    def after(self, follow_up: FollowUp, rng: np.random.Generator) -> "SimulatedRig":
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
        raise ValueError(f"{follow_up.kind} cannot be measured here")

    @property
    def _stated(self) -> Specimen:
        stated = self.files[0].specimen
        assert isinstance(stated, Specimen)
        return stated

    def _built(self, truth: PlateTruth) -> ReducedSolid:
        return built(truth.plate, truth.effects, moduli_of(truth.law, self.schedule.frequency_hz))

    def _steps(self, follow_up: FollowUp) -> Schedule:
        f = np.array(follow_up.frequencies_hz)
        segment = np.array(follow_up.segments, dtype=np.intp)
        last = self.schedule
        when = last.time_s.max() + _PAUSE_S + np.cumsum(1.2 + 30 / f)
        level = np.full(len(f), follow_up.level_g)
        return Schedule(f, segment, last.sweep.max() + segment, level, when)

    def _more(self, follow_up: FollowUp, rng: np.random.Generator) -> "SimulatedRig":
        new = self._steps(follow_up)
        pairs = zip(_columns(self.schedule), _columns(new), strict=True)
        whole = Schedule(*(np.concatenate(pair) for pair in pairs))
        at = np.arange(len(whole.time_s)) >= len(self.schedule.time_s)
        sweep = measured(self.truth, self.plate, whole, rng).take(at)
        (first, *others) = self.files
        first = replace(first, sweep=_joined(first.sweep, sweep))
        return replace(self, schedule=whole, files=(first, *others))

    def _at_spot(self, follow_up: FollowUp, rng: np.random.Generator) -> "SimulatedRig":
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

    def _heavier(self, follow_up: FollowUp, rng: np.random.Generator) -> "SimulatedRig":
        assert follow_up.mass_at_mm is not None
        assert follow_up.mass_kg is not None
        x, y = (1e-3 * at for at in follow_up.mass_at_mm)
        weighed = follow_up.mass_kg * float(np.exp(STATED["mass"].typical * rng.standard_normal()))
        # By a rule from the free end.
        longer = self.truth.plate.length_m - self._stated.length_m
        off = STATED["place"].typical * rng.standard_normal(2)
        at = x + longer + float(off[0]), y + float(off[1])
        patch = HIDDEN["added_mass"](weighed, *at, _SIDE_M)  # type: ignore[call-arg]
        there = replace(self.truth, effects=(*self.truth.effects, patch))
        sweep = measured(there, self._built(there), self._steps(follow_up), rng)
        masses = (PlacedMass(follow_up.mass_kg, x, y),)
        return self._and_file(sweep, replace(self._stated, masses=masses))

    def _clamped_anew(self, follow_up: FollowUp, rng: np.random.Generator) -> "SimulatedRig":
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

    def _and_file(self, sweep: Sweep, specimen: Specimen, like: Specimen | None = None) -> "SimulatedRig":
        files = [replace(f, number=f.number or 1) for f in self.files]
        number = max(f.number for f in files) + 1
        more = File(sweep, specimen, "", number, None, like or files[0].like)
        return replace(self, files=_by_spot((*files, more)))


def _by_spot(files: tuple[File, ...]) -> tuple[File, ...]:
    """Spots numbered where there are several, as a run numbers them."""
    spots = list(dict.fromkeys(f.specimen.pickup_m for f in files if isinstance(f.specimen, Specimen)))
    if len(spots) < 2:
        return files
    numbers = (spots.index(f.specimen.pickup_m) for f in files if isinstance(f.specimen, Specimen))
    return tuple(replace(f, pickup=k) for f, k in zip(files, numbers, strict=True))


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


def _near(true: TruePlate, specimen: Specimen, spot: tuple[float, float]) -> Specimen:
    """Models of that spot that serve every statement of the plate: the same share of its length and width."""
    shares = spot[0] / specimen.length_m, spot[1] / specimen.width_m
    x_mm, y_mm = round(1e3 * shares[0] * true.length_m, 1), round(1e3 * shares[1] * true.width_m, 1)
    return _models(true.name, (x_mm, y_mm))


def _columns(s: Schedule) -> tuple[np.ndarray[tuple[int], np.dtype[np.generic]], ...]:
    return s.frequency_hz, s.segment, s.sweep, s.level_g, s.time_s


def _joined(a: Sweep, b: Sweep) -> Sweep:
    names = ("frequency_hz", "velocity_m_s", "commanded_m_s2", "segment", "sweep", "base_m_s2", "time_s")
    return Sweep(**{n: np.concatenate([getattr(a, n), getattr(b, n)]) for n in names})
