"""A solid plate that can be measured again: at another level, at another spot, clamped anew, or bare."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import lru_cache

import numpy as np

from fitting.gravity import PUBLISHED_G_M_S2
from fitting.specimen import PlacedMass, Specimen
from fitting.sweep import Sweep
from fitting.tolerances import STATED
from instrument.campaign.plates.cases import PlateTruth, draw_case, measured
from instrument.campaign.plates.hidden import HIDDEN
from instrument.campaign.plates.judged import models_of
from instrument.campaign.plates.simulate import ChannelError, built, moduli_of, struck
from instrument.campaign.plates.stated import CAREFUL, CampaignTolerances, draw_stated, specimen_from, toml
from instrument.campaign.schedule import Schedule
from instrument.models.diagnosis import Diagnosed, diagnose
from instrument.models.files import File
from instrument.models.set_up import Hammer
from instrument.models.together import diagnose_together

PLATES = ("P2", "P3")
"""Two of the campaign's ten by default: models of further spots are made once a plate."""
_PAUSE_S = 60.0
_SIDE_M = 8e-3
"""Of a mass that is put on."""
SHARE = 0.3
"""Of a careful laboratory's tolerances: of what these allow one sweep names little, and no group is left."""
MEASURED_WELL = CampaignTolerances(
    **{
        f.name: (1.0 if f.name in ("pickup_m", "damping") else SHARE) * getattr(CAREFUL, f.name)
        for f in fields(CAREFUL)
    }
)


def weak(kind, rng, plate):
    """An effect of a size that one sweep may not tell from others."""
    sign = float(rng.choice([-1, 1]))
    made = {
        "substrate_stiffness": lambda: {"scale": 1 + sign * float(rng.uniform(0.03, 0.06))},
        "gain_error": lambda: {"factor": 1 + sign * float(rng.uniform(0.007, 0.014))},
        "air_added_mass": lambda: {"density_kg_m3": float(rng.uniform(1.1, 1.25))},
        "amplitude_softening": lambda: {"k": float(np.exp(rng.uniform(*np.log([0.012, 0.04])))), "most": 0.5},
        "spot_offset": lambda: _offset(rng),
        "clamp_compliance": lambda: _clamp(rng, plate),
    }
    return HIDDEN[kind](**made[kind]())


def _offset(rng):
    size, angle = rng.uniform(1.6e-3, 3e-3), rng.uniform(0, 2 * np.pi)
    return {"dx_m": float(size * np.cos(angle)), "dy_m": float(size * np.sin(angle))}


def _clamp(rng, plate):
    softness = float(np.exp(rng.uniform(*np.log([2e-3, 8e-3]))))
    along_x = plate.substrate.young_pa / (softness * plate.length_m)
    bolts = int(rng.integers(3, 6))
    reach = float(rng.uniform(0.12, 0.25)) * plate.width_m / bolts
    return {
        "along_x_n_m3": along_x,
        "along_z_n_m3": along_x * float(rng.uniform(0.5, 2)),
        "bolts": bolts,
        "reach_m": reach,
        "between": float(rng.uniform(0.15, 0.5)),
    }


@lru_cache
def _models(plate: str, spot_mm: tuple[float, float] | None) -> Specimen:
    like = models_of(plate)
    return like if spot_mm is None else replace(like, pickup_m=(1e-3 * spot_mm[0], 1e-3 * spot_mm[1]))


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
    def plate(self):
        """As built."""
        return built(
            self.truth.plate, self.truth.effects, moduli_of(self.truth.law, self.schedule.frequency_hz)
        )

    def diagnosed(self) -> Diagnosed:
        """Everything together."""
        if len(self.files) == 1:
            (one,) = self.files
            return diagnose(one.sweep, one.specimen, self.hammer, like=one.like)
        return diagnose_together(self.files, hammer=self.hammer).found

    def after(self, follow_up, rng) -> "SimulatedRig":
        """With one more measurement."""
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

    def _steps(self, follow_up) -> Schedule:
        f = np.array(follow_up.frequencies_hz)
        segment = np.array(follow_up.segments, dtype=np.intp)
        last = self.schedule
        passes = last.sweep.max() + segment
        when = last.time_s.max() + _PAUSE_S + np.cumsum(1.2 + 30 / f)
        return Schedule(f, segment, passes, np.full(len(f), follow_up.level_g), when)

    def _more(self, follow_up, rng) -> "SimulatedRig":
        new = self._steps(follow_up)
        whole = Schedule(
            *(np.concatenate(pair) for pair in zip(_columns(self.schedule), _columns(new), strict=True))
        )
        sweep = measured(self.truth, self.plate, whole, rng).take(
            np.arange(len(whole.time_s)) >= len(self.schedule.time_s)
        )
        (first, *others) = self.files
        first = replace(first, sweep=_joined(first.sweep, sweep))
        return replace(self, schedule=whole, files=(first, *others))

    def _at_spot(self, follow_up, rng) -> "SimulatedRig":
        spot = tuple(1e-3 * s for s in follow_up.spot_mm)
        aimed = tuple(s + CAREFUL.pickup_m * e for s, e in zip(spot, rng.standard_normal(2), strict=True))
        # Half of those that measured from a wrong edge do it again.
        again = rng.random() < 0.5
        effects = tuple(h for h in self.truth.effects if again or h.name != "spot_offset")
        there = replace(self.truth, plate=replace(self.truth.plate, spot_m=aimed), effects=effects)
        sweep = measured(there, self.plate, self._steps(follow_up), rng)
        first = self.files[0]
        near = _near(self.truth.plate, first.specimen, spot)
        files = [replace(f, number=1, pickup=k) for k, f in enumerate(self.files)]
        more = File(sweep, replace(first.specimen, pickup_m=spot), "", 1, len(files), near)
        return replace(self, files=(*files, more))

    def _heavier(self, follow_up, rng) -> "SimulatedRig":
        x, y = (1e-3 * at for at in follow_up.mass_at_mm)
        weighed = follow_up.mass_kg * float(np.exp(STATED["mass"].typical * rng.standard_normal()))
        there = replace(
            self.truth, effects=(*self.truth.effects, HIDDEN["added_mass"](weighed, x, y, _SIDE_M))
        )
        plate = built(there.plate, there.effects, moduli_of(there.law, self.schedule.frequency_hz))
        sweep = measured(there, plate, self._steps(follow_up), rng)
        masses = (PlacedMass(follow_up.mass_kg, x, y),)
        return self._and_file(sweep, replace(self.files[0].specimen, masses=masses))

    def _and_file(self, sweep, specimen) -> "SimulatedRig":
        number = max((f.number or 1) for f in self.files) + 1
        files = [replace(f, number=f.number or 1) for f in self.files]
        more = replace(self.files[0], sweep=sweep, specimen=specimen, number=number, pickup=None)
        return replace(self, files=(*files, more))

    def _clamped_anew(self, follow_up, rng) -> "SimulatedRig":
        def other(h):
            if h.name != "clamp_compliance":
                return h
            times = float(np.exp(0.7 * rng.standard_normal()))
            return replace(h, along_x_n_m3=times * h.along_x_n_m3, along_z_n_m3=times * h.along_z_n_m3)

        stated = self.files[0].specimen.pickup_m
        true = self.truth.plate
        aimed = tuple(s + CAREFUL.pickup_m * e for s, e in zip(stated, rng.standard_normal(2), strict=True))
        there = replace(
            self.truth,
            plate=replace(true, spot_m=aimed),
            effects=tuple(other(h) for h in self.truth.effects if h.name != "spot_offset"),
        )
        plate = built(there.plate, there.effects, moduli_of(there.law, self.schedule.frequency_hz))
        sweep = measured(there, plate, self._steps(follow_up), rng)
        return self._and_file(sweep, self.files[0].specimen)


def _near(true, specimen, spot) -> Specimen:
    """Models of that spot that serve every statement of the plate: the same share of its length and width."""
    shares = spot[0] / specimen.length_m, spot[1] / specimen.width_m
    place = (round(1e3 * shares[0] * true.length_m, 1), round(1e3 * shares[1] * true.width_m, 1))
    return _models(true.name, place)


def _columns(s: Schedule):
    return s.frequency_hz, s.segment, s.sweep, s.level_g, s.time_s


def _joined(a: Sweep, b: Sweep) -> Sweep:
    names = ("frequency_hz", "velocity_m_s", "commanded_m_s2", "segment", "sweep", "base_m_s2", "time_s")
    return Sweep(**{n: np.concatenate([getattr(a, n), getattr(b, n)]) for n in names})


def draw(kind: str, seed: int, plates: Sequence[str] = PLATES) -> SimulatedRig | None:
    """A case with one sweep at 1 g; None where the draw has several levels."""
    plate = plates[seed % len(plates)]
    clean = draw_case("none", seed, plate=plate)
    s = clean.sweep
    if len(np.unique(s.commanded_m_s2)) > 1:
        return None
    rng = np.random.default_rng([seed, *kind.encode()])
    true = clean.truth.plate
    gain, delay = rng.standard_normal(2)
    channel = ChannelError(float(np.exp(MEASURED_WELL.gain * gain)), MEASURED_WELL.delay_s * float(delay))
    truth = replace(clean.truth, effects=(weak(kind, rng, true),), channel=channel)
    text = toml(draw_stated(rng, true, MEASURED_WELL), MEASURED_WELL, clean.truth.resonances_hz[1])
    schedule = Schedule(s.frequency_hz, s.segment, s.sweep, s.commanded_m_s2 / PUBLISHED_G_M_S2, s.time_s)
    file = File(s, specimen_from(text), like=_models(plate, None))
    rig = SimulatedRig(truth, schedule, (file,), None, float(s.time_s.max() - s.time_s.min()))
    sweep = measured(truth, rig.plate, schedule, rng)
    return replace(rig, files=(replace(file, sweep=sweep),))
