"""A case of a struck plate: an FRF over a whole band, free or in its clamp, read at one to three points."""

from dataclasses import dataclass
from functools import reduce
from typing import Any

import numpy as np

from campaign.draws import log_uniform
from campaign.law import TrueLaw
from campaign.plates.blows import Blows, draw_blows
from campaign.plates.channel import ChannelError
from campaign.plates.geometry import PLATES, TruePlate, plate_named
from campaign.plates.hidden.base import Hidden
from campaign.plates.hidden.struck import (
    NONE,
    OF_CLAMPED,
    OF_FREE,
    PLACES,
    STRUCK_KINDS,
    Place,
    draw_hidden_in_struck,
)
from campaign.plates.materials import draw_law, fits
from campaign.plates.reduced import ReducedSolid
from campaign.plates.schedule import MOST_LAWS
from campaign.plates.stated import (
    CAREFUL,
    STRUCK,
    damping_lines,
    digits,
    draw_stated,
    plate_lines,
    specimen_from,
)
from campaign.plates.struck import resonance
from campaign.plates.struck_readings import (
    aimed,
    mobilities,
    on_plate,
    plate_of,
    solid_of,
    struck_so,
    through_channels,
)
from fitting.arrays import Array, Complex
from fitting.discrepancy.theory_error import theory_error
from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep

_FREE = 0.75
"""Of cases; the others stand in their clamp."""
_FEWEST, _MOST = 5, 14
"""Resonances of a band."""
_HIGHEST_HZ = 1250.0
_THEORY = 0.7
"""Of its limits, that a band ends within: beyond them the fit refuses."""
_LINES = (300, 1600)
"""Of the spectrum; each number as likely in its logarithm."""
_BEGINS, _ENDS = (0.5, 0.8), (1.03, 1.08)
"""Of the first resonance, and of the last one."""
_STATED_NOISE = 0.5
"""Of cases; the others leave it to the scatter of neighbouring lines."""
_FORCE_M = 1e-3
_STILL = 0.2
"""Of the length, from a clamp: where a plate hardly moves."""
_BELOW = 0.6
"""Of the first resonance of the softest core: where a law's band begins."""
_JUDGED = 5
"""Resonances, from the first to the last of the band."""
_STIFF_PA, _SOFT_PA = 2e6, 0.3e6


@dataclass(frozen=True)
class StruckTruth:
    """What was hidden: the law, and perhaps an effect."""

    plate: TruePlate
    free: bool
    law: TrueLaw
    blows: Blows
    force_m: Place
    spots_m: tuple[Place, ...]
    resonances_hz: tuple[float, ...]
    """Five of a band from the first to the last: where the law is judged."""
    effects: tuple[Hidden, ...] = ()

    @property
    def specimen_name(self) -> str:
        """Name of the plate, and how it is held."""
        return f"{self.plate.name} {'free' if self.free else 'clamped'}"

    @property
    def modulus_pa(self) -> Complex:
        """Of the core at the resonances. Shape (resonances,)."""
        return self.law.modulus(2 * np.pi * np.array(self.resonances_hz))

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the hidden effects."""
        return tuple(h.name for h in self.effects)


@dataclass(frozen=True)
class StruckCase:
    """What an identification or a diagnosis is given, and the truth that it is not."""

    seed: int
    sweep: Sweep
    specimen: PlateSpecimen
    specimen_toml: str
    truth: StruckTruth
    kind: str = NONE
    exact: bool = False
    hammer: tuple[Array, Array] | None = None


def draw_struck(
    seed: int, kind: str = NONE, *, plate: str | None = None, free: bool | None = None
) -> StruckCase:
    """A random case of one of `STRUCK_KINDS`, always the same for the same arguments.

    Plate, points, law and lines of a seed are the same for all kinds, but for those that ask for a clamp or
    for none. Raises `ArithmeticError` where no law is found, `ValueError` for another kind.
    """
    if kind not in STRUCK_KINDS:
        raise ValueError(f"kind {kind!r}, expected one of {', '.join(STRUCK_KINDS)}")

    def rng(purpose: str) -> np.random.Generator:
        return np.random.default_rng([seed, 7, *purpose.encode()])

    chance = rng("plate")
    true = plate_named(plate) if plate else PLATES[int(chance.integers(len(PLATES)))]
    hangs = bool(chance.random() < _FREE) if free is None else free
    hangs = kind in OF_FREE or (hangs and kind not in OF_CLAMPED)
    at = chance.permutation(len(PLACES))[: 2 + int(chance.integers(3))]
    # In a clamp what is next to it hardly moves.
    places = [PLACES[k] for k in at if hangs or PLACES[k][0] > _STILL]
    if len(places) < 2:
        places = [PLACES[4], PLACES[7]]
    force, *spots = ((x * true.length_m, y * true.width_m) for x, y in places)
    law, found = _law_and_resonances(rng("law"), true, solid_of(true, (), free=hangs), free=hangs)
    f = _lines(rng("lines"), found)
    blows = draw_blows(rng("blows"), float(f[-1]))
    judged = tuple(found[k] for k in np.round(np.linspace(0, len(found) - 1, _JUDGED)).astype(int))
    hidden = draw_hidden_in_struck(kind, np.random.default_rng([seed, 7, *kind.encode()]), true, judged)
    truth = StruckTruth(true, hangs, law, blows, force, tuple(spots), judged, hidden)
    sweep = _measured(truth, solid_of(true, hidden, free=hangs), f, rng("noise"))
    text = _stated(rng("stated"), truth)
    return StruckCase(seed, sweep, specimen_from(text), text, truth, kind)


def _law_and_resonances(
    rng: np.random.Generator, true: TruePlate, solid: ReducedSolid, *, free: bool
) -> tuple[TrueLaw, list[float]]:
    first = 6 if free else 0
    low, high = (
        np.sqrt(solid.modes(g, first + n + 1)[0][-1]) / (2 * np.pi)
        for g, n in ((_SOFT_PA, 0), (_STIFF_PA, _MOST // 2))
    )
    for _ in range(MOST_LAWS):
        law = draw_law(rng, (_BELOW * float(low), min(float(high), _HIGHEST_HZ)))
        most = int(rng.integers(_FEWEST, _MOST + 1))
        found: list[float] = []
        for r in range(first, first + most):
            f = resonance(solid, law, r, found[-1] if found else float(low))[0]
            if f > _HIGHEST_HZ or not _held_by_theory(true, law, _ENDS[1] * f):
                break
            found.append(f)
        if len(found) >= _FEWEST and fits(law, np.geomspace(_BEGINS[0] * found[0], _ENDS[1] * found[-1], 25)):
            return law, found
    raise ArithmeticError(f"no law found that serves a spectrum of plate {true.name}")


def _held_by_theory(true: TruePlate, law: TrueLaw, frequency_hz: float) -> bool:
    at = _specimen_of(true)
    G = law.modulus(2 * np.pi * frequency_hz)
    return bool(theory_error(at, [frequency_hz], G).excess[0] < _THEORY)


def _specimen_of(true: TruePlate) -> PlateSpecimen:
    return specimen_from(_toml(true, (0.0, 0.0), (true.spot_m,), free=False, middle_hz=100.0))


def _lines(rng: np.random.Generator, found: list[float]) -> Array:
    """Even lines, as a spectrum has them. Shape (lines,)."""
    low, high = found[0] * rng.uniform(*_BEGINS), found[-1] * rng.uniform(*_ENDS)
    step = (high - low) / log_uniform(rng, *_LINES)
    return np.asarray(step * np.arange(np.ceil(low / step), np.floor(high / step) + 1))


def _measured(truth: StruckTruth, solid: ReducedSolid, f: Array, rng: np.random.Generator) -> Sweep:
    hidden, plate = truth.effects, plate_of(truth.plate, truth.effects)
    hits = [aimed(plate, truth.force_m, off, hidden) for off in truth.blows.offsets_m]
    spots = [
        aimed(plate, at, CAREFUL.pickup_m * rng.standard_normal(2), hidden, k)
        for k, at in enumerate(truth.spots_m)
    ]
    ratios = reduce(lambda r, h: h.ratios(r), hidden, np.array([] if truth.free else truth.plate.ratios))
    each = mobilities(solid, truth.law, f, hits, spots, hidden, ratios)
    channels = ChannelError.within(STRUCK, rng.standard_normal(3)).factor(2 * np.pi * f)
    blows = struck_so(truth.blows, hidden)
    seen = [through_channels(own, 2 * np.pi * f, hidden, k) for k, own in enumerate(each)]
    found = [blows.read(rng, f, own * channels) for own in seen]
    ones, count = np.ones(len(f) * len(spots)), len(spots)
    return Sweep(
        frequency_hz=np.tile(f, count),
        velocity_m_s=np.concatenate([one.H for one in found]),
        commanded_m_s2=ones,
        segment=ones.astype(np.intp),
        sweep=ones.astype(np.intp),
        std_m_s=np.concatenate([one.std for one in found]) if rng.random() < _STATED_NOISE else None,
        pickup=np.repeat(np.arange(count, dtype=np.intp), len(f)) if count > 1 else None,
    )


def _stated(rng: np.random.Generator, truth: StruckTruth) -> str:
    """The specimen file. Spots and the force are where they were meant to be."""
    believed = draw_stated(rng, truth.plate)
    places = [on_plate(believed, at, 0.0) for at in (truth.force_m, *truth.spots_m)]
    middle = float(np.median(truth.resonances_hz))
    return _toml(believed, places[0], places[1:], free=truth.free, middle_hz=middle)


def _toml(plate: TruePlate, force_m: Place, spots_m: Any, *, free: bool, middle_hz: float) -> str:
    lines = plate_lines(plate, "free" if free else "cantilever", middle_hz)
    lines += [] if free else damping_lines(plate)
    for x, y in spots_m:
        lines += ["[[pickup]]", f"x_mm = {digits(1e3 * x)}", f"y_mm = {digits(1e3 * y)}", ""]
    lines += ["[excitation]", 'kind = "force"']
    lines += [f"x_mm = {digits(1e3 * force_m[0])}", f"y_mm = {digits(1e3 * force_m[1])}", "", "[tolerances]"]
    lines += [line for line in STRUCK.lines() if not (free and line.startswith("damping"))]
    return "\n".join([*lines, f"force_mm = {1e3 * _FORCE_M:g}"]) + "\n"
