"""A case: a sweep of one of the beams as a lab would hand it in, and what was hidden in it."""

from dataclasses import asdict, dataclass, replace
from functools import reduce
from typing import Any

import numpy as np

from campaign.beams.geometry import BEAMS, TrueBeam, beam_named
from campaign.beams.hidden import HIDDEN, HiddenInBeam, Setting
from campaign.beams.simulate import BuiltBeam, built, level_unit, reading, resonances
from campaign.beams.stated import AXIAL_PA, beam_from, draw_stated, toml
from campaign.law import TrueLaw
from campaign.noise import draw_figures
from campaign.plates.channel import ChannelError
from campaign.plates.materials import draw_law, fits
from campaign.plates.noise import PlateNoise, draw_noise
from campaign.plates.schedule import (
    BESIDE,
    LARGEST_LOSS,
    MOST_LAWS,
    PROBES,
    Resonance,
    draw_schedule,
    seen_apart,
)
from campaign.plates.stated import CAREFUL
from campaign.schedule import THREE_LEVELS_G, Schedule
from fitting.arrays import Complex
from fitting.structures import Beam
from fitting.sweep import Sweep

NONE = "none"
KINDS = (NONE, *HIDDEN)
_THREE_LEVELS_SHARE = 2 / 3
"""Of shaken beams that soften; the others have one level, which tells nothing where a force drives."""
_POINTS, _POINTS_OF_THREE = (40, 76), (20, 36)
"""In a segment; where there are three levels."""
_RESONANCES = (2, 4)
_OF_PEAK = (0.003, 0.005)
"""White noise over the peak: of a plate's campaign, on a quieter day."""
_HIGHEST_HZ = 2500.0
_LEAST_LOSS, _LEAST_OF_FREE_LAYER = 0.02, 0.005
"""The same where the core takes hardly a part any more: its stretching then counts beside its shear."""


@dataclass(frozen=True)
class BeamTruth:
    """The truth that a beam's case hides from the diagnosis."""

    beam: TrueBeam
    """As it really is, but for the effects."""
    effects: tuple[HiddenInBeam, ...]
    law: TrueLaw
    noise: PlateNoise
    channel: ChannelError
    resonances_hz: tuple[float, ...]
    """Middle of each segment: where the law is judged."""

    @property
    def specimen_name(self) -> str:
        """Name of the beam."""
        return self.beam.name

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the hidden effects."""
        return tuple(h.name for h in self.effects)

    @property
    def modulus_pa(self) -> Complex:
        """Of the core at the resonances. Shape (resonances,)."""
        return self.beam.stiffer * self.law.modulus(2 * np.pi * np.array(self.resonances_hz))

    @property
    def facts(self) -> dict[str, Any]:
        """The truth as JSON has it."""
        G = self.modulus_pa
        return {
            "beam": self.beam.name,
            "effects": {h.name: h.facts for h in self.effects},
            "law": {"kind": self.law.kind, "values": list(self.law.values), "times": self.beam.stiffer},
            "channel": asdict(self.channel),
            "resonances_hz": list(self.resonances_hz),
            "storage_modulus_pa": G.real.tolist(),
            "loss_factor": (G.imag / G.real).tolist(),
        }


@dataclass(frozen=True)
class BeamCase:
    """What an identification or a diagnosis is given, and the truth that it is not."""

    kind: str
    seed: int
    exact: bool
    sweep: Sweep
    specimen_toml: str
    truth: BeamTruth
    clean_m_s: Complex
    """Readings without noise at the level asked for. Shape (points,)."""
    without_m_s: Complex
    """The same of the beam without effects."""

    @property
    def specimen(self) -> Beam:
        """What `viscorig` makes of the file."""
        return beam_from(self.specimen_toml)

    @property
    def hammer(self) -> None:
        """No bare beam is struck."""
        return


def draw_case(kind: str, seed: int, exact: bool = False, *, beam: str | None = None) -> BeamCase:
    """A random case of one of `KINDS`, always the same for the same arguments.

    `exact`: the specimen says the truth, and says so. `beam` asks for one of them. Files of even seeds say
    `held_width`. Raises `ValueError` for another kind.
    """
    if kind not in KINDS:
        raise ValueError(f"kind {kind!r}, expected one of {', '.join(KINDS)}")

    def rng(purpose: str) -> np.random.Generator:
        return np.random.default_rng([seed, *kind.encode(), 1, *purpose.encode()])

    chance, effect = rng("beam"), HIDDEN.get(kind)
    able = [b for b in BEAMS if effect is None or effect.able(b)]
    true = beam_named(beam) if beam else able[int(chance.integers(len(able)))]
    if true.ends == "clamped-clamped" and not exact:
        true = replace(true, axial_pa=AXIAL_PA * rng("axial").standard_normal())
    softens = kind == "amplitude_softening" and (true.force_m or chance.random() < _THREE_LEVELS_SHARE)
    levels, points = (THREE_LEVELS_G, _POINTS_OF_THREE) if softens else ((1.0,), _POINTS)
    law, chosen = _law_and_resonances(rng("law"), true)
    schedule = draw_schedule(rng("schedule"), chosen, levels, points)
    hidden: tuple[HiddenInBeam, ...] = ()
    if effect is not None:
        at = Setting(true, tuple(r.frequency_hz for r in chosen), float(schedule.time_s.max()))
        hidden = (effect.draw(rng("effects"), at),)
    as_built = built(true, hidden)
    if hidden:
        # A lab measures around the peaks that it sees.
        schedule = draw_schedule(rng("schedule"), _moved(as_built, law, chosen), levels, points)
    schedule = reduce(lambda s, h: h.paused(s), hidden, schedule)
    chance = rng("stated")
    off = *chance.standard_normal(2), rng("phase").standard_normal()
    channel = ChannelError() if exact else ChannelError.within(CAREFUL, off)
    stated, tolerances = (true, None) if exact else (draw_stated(chance, true), CAREFUL)
    middle = schedule.middles_hz
    # Every other lab knows what a clamp does to the width.
    text = toml(stated, tolerances, middle[len(middle) // 2], held_width=seed % 2 == 0)
    truth = BeamTruth(true, hidden, law, _noise(rng("noise figures")), channel, middle)
    level = level_unit(true) * schedule.level_g
    clean, without = (level * reading(b, law, schedule, channel) for b in (as_built, built(true)))
    sweep = _measured(truth, clean, schedule, rng("noise"))
    return BeamCase(kind, seed, exact, sweep, text, truth, clean, without)


def _law_and_resonances(rng: np.random.Generator, true: TrueBeam) -> tuple[TrueLaw, list[Resonance]]:
    """A law that keeps within the campaign's limits over the segments that it leads to."""
    clean = built(true)
    least = _LEAST_LOSS if true.constraining is not None else _LEAST_OF_FREE_LAYER
    soft, stiff = (seen_apart(resonances(clean, law, _HIGHEST_HZ)) for law in PROBES)
    band = BESIDE[0] * soft[0].frequency_hz, BESIDE[1] * stiff[: _RESONANCES[1]][-1].frequency_hz
    for _ in range(MOST_LAWS):
        law, most = draw_law(rng, band), int(rng.integers(_RESONANCES[0], _RESONANCES[1] + 1))
        every = seen_apart(resonances(clean, law, _HIGHEST_HZ))
        chosen = [r for r in every if r.loss_factor > least][:most]
        inside = fits(law, np.array([r.frequency_hz for r in chosen]))
        if len(chosen) >= _RESONANCES[0] and inside and max(r.loss_factor for r in chosen) < LARGEST_LOSS:
            return law, chosen
    raise ArithmeticError(f"no law found that leaves two resonances on beam {true.name}")


def _moved(beam: BuiltBeam, law: TrueLaw, chosen: list[Resonance]) -> list[Resonance]:
    """The resonances where the effect has moved them."""
    every = resonances(beam, law)
    found = [min(every, key=lambda n: abs(np.log(n.frequency_hz / r.frequency_hz))) for r in chosen]
    return [replace(r, frequency_hz=n.frequency_hz) for r, n in zip(chosen, found, strict=True)]


def _noise(rng: np.random.Generator) -> PlateNoise:
    """White noise of a quiet day, and what drifts as on a plate."""
    figures = draw_figures(rng, _OF_PEAK)
    return replace(draw_noise(rng), white=figures)


def _measured(truth: BeamTruth, clean: Complex, schedule: Schedule, rng: np.random.Generator) -> Sweep:
    """The sweep as the rig would record it."""
    commanded, white = level_unit(truth.beam) * schedule.level_g, truth.noise.white
    drive = white.drive(rng, len(clean))
    velocity = clean * drive * truth.noise.factor(rng, schedule) + white.added(rng, clean, schedule.sweep)
    return schedule.read(velocity, commanded, commanded * drive)
