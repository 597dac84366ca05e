"""A case: a sweep of one of the plates as a lab would hand it in, and what was hidden in it."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from functools import reduce
from typing import Any

import numpy as np

from campaign.law import TrueLaw
from campaign.plates.channel import ChannelError
from campaign.plates.geometry import PLATES, TruePlate, plate_named
from campaign.plates.hammer import HammerTest
from campaign.plates.hidden import HIDDEN, draw_hidden, names_of
from campaign.plates.hidden.base import Hidden, Setting
from campaign.plates.kept import clean_plate
from campaign.plates.materials import draw_law, fits
from campaign.plates.noise import PlateNoise, draw_noise
from campaign.plates.one_piece import draw_whole, in_one_piece, judged_of, of_one_range
from campaign.plates.reduced import MODES, ReducedSolid
from campaign.plates.schedule import (
    LARGEST_LOSS,
    MOST_LAWS,
    Resonance,
    draw_schedule,
    known_to_hz,
    measured_resonances,
    resonances,
    widest_band_hz,
)
from campaign.plates.simulate import built, moduli_of, peaks_hz, reading, struck
from campaign.plates.stated import CAREFUL, draw_stated, specimen_from, toml
from campaign.schedule import Schedule, draw_levels
from fitting.arrays import Array, Complex
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep

NONE, PAIR = "none", "pair"
KINDS = (NONE, *HIDDEN, PAIR)
_HAMMER_SHARE = 0.5
"""Of cases: with and without a hammer test are compared."""


@dataclass(frozen=True)
class PlateTruth:
    """The truth that a plate's case hides from the diagnosis."""

    plate: TruePlate
    """As it really is, but for the effects."""
    effects: tuple[Hidden, ...]
    law: TrueLaw
    noise: PlateNoise
    channel: ChannelError
    resonances_hz: tuple[float, ...]
    """Middle of the three segments, or three resonances of one piece: where the law is judged."""
    lowest_share: float
    """Least share that the core has in the stiffness, d ln f^2 / d ln G', of the three resonances."""

    @property
    def specimen_name(self) -> str:
        """Name of the plate."""
        return self.plate.name

    @property
    def modulus_pa(self) -> Complex:
        """Of the core at the resonances. Shape (resonances,)."""
        return self.law.modulus(2 * np.pi * np.array(self.resonances_hz))

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the hidden effects."""
        return tuple(h.name for h in self.effects)

    @property
    def facts(self) -> dict[str, Any]:
        """The truth as JSON has it."""
        G = self.modulus_pa
        return {
            "plate": self.plate.name,
            "effects": {h.name: h.facts for h in self.effects},
            "law": {"kind": self.law.kind, "values": list(self.law.values)},
            "noise": {
                "fraction_of_peak": self.noise.white.fraction_of_peak,
                "repeat_scatter": self.noise.white.repeat_scatter,
                "wander": self.noise.wander,
                "wander_points": self.noise.wander_points,
                "gain_drift": self.noise.gain_drift,
            },
            "channel": asdict(self.channel),
            "resonances_hz": list(self.resonances_hz),
            "storage_modulus_pa": G.real.tolist(),
            "loss_factor": (G.imag / G.real).tolist(),
            "lowest_share": self.lowest_share,
        }


@dataclass(frozen=True)
class Silent:
    """Readings of the same steps without noise, the shaker at its commanded level. Shape (points,) each."""

    with_effects_m_s: Complex
    without_m_s: Complex


@dataclass(frozen=True)
class PlateCase:
    """What an identification or a diagnosis is given, and the truth that it is not."""

    kind: str
    seed: int
    exact: bool
    sweep: Sweep
    specimen: PlateSpecimen
    specimen_toml: str
    hammer_test: HammerTest | None
    truth: PlateTruth
    silent: Silent | None = None
    """None where the case was read from files."""

    @property
    def hammer(self) -> tuple[Array, Array] | None:
        """Natural frequencies in Hz and ratios of the bare plate. Shape (modes,) each."""
        return self.hammer_test.pair if self.hammer_test else None


def draw_case(
    kind: str,
    seed: int,
    exact: bool = False,
    *,
    plate: str | None = None,
    law: str | None = None,
    one_piece: bool = False,
) -> PlateCase:
    """A random case of one of `KINDS`, always the same for the same arguments.

    `exact`: the specimen says the truth, and says so. `plate` and `law` ask for one plate or kind of law.
    `one_piece`: one segment through five or six resonances, in place of three about one each.
    Law, segments, noise and effects of a seed are the same for exact and stated cases. Raises `ValueError`
    for another kind.
    """
    if kind not in KINDS:
        raise ValueError(f"kind {kind!r}, expected one of {', '.join(KINDS)}")

    def rng(purpose: str) -> np.random.Generator:
        return np.random.default_rng([seed, *kind.encode(), 0, *purpose.encode()])

    chance = rng("plate")
    names = names_of(kind, rng("names"))
    # A spot on the axis sees nothing of what is odd in y.
    able = [p for p in PLATES if "base_roll" not in names or abs(p.spot_m[1] - p.width_m / 2) > 1e-3]
    true = plate_named(plate) if plate else able[int(chance.integers(len(able)))]
    levels = draw_levels(chance, names)
    found, chosen, schedule = _law_and_schedule(rng("law"), true, law, levels, one_piece=one_piece)
    middle = tuple(r.frequency_hz for r in chosen) if one_piece else schedule.middles_hz
    at = Setting(true, middle, float(schedule.time_s.max()))
    hidden = draw_hidden(names, rng("effects"), at)
    plate_built = built(true, hidden, moduli_of(found, schedule.frequency_hz))
    if any(h.changes_solid for h in hidden) and not one_piece:
        # A lab measures around the peaks that it sees.
        seen = peaks_hz(plate_built, true, hidden, found, [r.frequency_hz for r in chosen])
        moved = [replace(r, frequency_hz=f) for r, f in zip(chosen, seen, strict=True)]
        schedule = draw_schedule(rng("schedule"), moved, levels)
        middle = schedule.middles_hz
    schedule = reduce(lambda s, h: h.paused(s), hidden, schedule)
    noise = draw_noise(rng("noise figures"))
    if one_piece:
        noise = of_one_range(rng("floor"), noise)
    stated, channel = (true, ChannelError()) if exact else _believed(rng("stated"), rng("phase"), true)
    text = toml(stated, None if exact else CAREFUL, middle[1])
    test = _hammer_test(rng("hammer"), true, hidden, exact=exact)
    shares = [_share(clean_plate(true), found, r.frequency_hz) for r in chosen]
    truth = PlateTruth(true, hidden, found, noise, channel, middle, min(shares))
    sweep = measured(truth, plate_built, schedule, rng("noise"))
    silent = _silent(truth, plate_built, schedule)
    return PlateCase(kind, seed, exact, sweep, specimen_from(text), text, test, truth, silent)


def _law_and_schedule(
    rng: np.random.Generator, true: TruePlate, kind: str | None, levels: tuple[float, ...], *, one_piece: bool
) -> tuple[TrueLaw, list[Resonance], Schedule]:
    """A law that keeps within the campaign's limits where it is swept, and the resonances judged."""
    clean = clean_plate(true)
    band = widest_band_hz(clean, true)
    for _ in range(MOST_LAWS):
        law = draw_law(rng, band, kind)
        try:
            chosen, judged, schedule = _swept(rng, true, law, levels, one_piece=one_piece)
        except ArithmeticError:
            continue
        if fits(law, schedule.frequency_hz) and max(r.loss_factor for r in chosen) < LARGEST_LOSS:
            return law, judged, schedule
    raise ArithmeticError(f"no law found that serves a sweep on plate {true.name}")


def _swept(
    rng: np.random.Generator,
    true: TruePlate,
    law: TrueLaw,
    levels: tuple[float, ...],
    *,
    one_piece: bool,
) -> tuple[list[Resonance], list[Resonance], Schedule]:
    """Resonances of the sweep, those of them that are judged, and its points.

    Raises `ArithmeticError` where a law leaves too few to sweep about.
    """
    clean = clean_plate(true)
    if one_piece:
        chosen = in_one_piece(rng, resonances(clean, true.spot_m, law), known_to_hz(clean, law))
        return chosen, judged_of(chosen), draw_whole(rng, chosen, levels)
    chosen = measured_resonances(clean, true.spot_m, law)
    return chosen, chosen, draw_schedule(rng, chosen, levels)


def _believed(
    chance: np.random.Generator, phase: np.random.Generator, true: TruePlate
) -> tuple[TruePlate, ChannelError]:
    """The plate as a careful laboratory states it, and how far its channel is off."""
    stated = draw_stated(chance, true)
    off = *chance.standard_normal(2), phase.standard_normal()
    return stated, ChannelError.within(CAREFUL, off)


def _hammer_test(
    chance: np.random.Generator, true: TruePlate, hidden: Sequence[Hidden], *, exact: bool
) -> HammerTest | None:
    """Of the bare plate, where the case has one."""
    if chance.random() >= _HAMMER_SHARE:
        return None
    return struck(true, hidden, chance, 0.0 if exact else CAREFUL.damping, yields=not exact)


def _silent(truth: PlateTruth, plate: ReducedSolid, schedule: Schedule) -> Silent:
    """What noise is added to, with and without effects."""
    commanded = schedule.level_g * PUBLISHED_G_M_S2
    return Silent(
        commanded * _ratios(truth, plate, schedule),
        commanded * _ratios(replace(truth, effects=()), clean_plate(truth.plate), schedule),
    )


def _share(clean: ReducedSolid, law: TrueLaw, frequency_hz: float) -> float:
    """Of the core in the stiffness of the mode nearest to a frequency."""
    omega = 2 * np.pi * frequency_hz
    G = float(law.modulus(omega).real)
    lam, phi = clean.modes(G, MODES)
    r = int(np.argmin(np.abs(np.sqrt(lam) - omega)))
    return float(G * (phi[:, r] @ clean.whole_core @ phi[:, r]) / lam[r])


def _ratios(truth: PlateTruth, plate: ReducedSolid, schedule: Schedule) -> Complex:
    """Velocity over base acceleration without noise. Shape (points,)."""
    return reading(plate, truth.plate, truth.effects, truth.law, schedule, truth.channel)


def measured(truth: PlateTruth, plate: ReducedSolid, schedule: Schedule, rng: np.random.Generator) -> Sweep:
    """The sweep as the rig would record it."""
    ratio = _ratios(truth, plate, schedule)
    commanded = schedule.level_g * PUBLISHED_G_M_S2
    white = truth.noise.white
    base = commanded * white.drive(rng, len(commanded))
    velocity = ratio * base * truth.noise.factor(rng, schedule)
    velocity = velocity + white.added(rng, ratio * commanded, schedule.sweep)
    return schedule.read(velocity, commanded, base)
