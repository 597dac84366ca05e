"""A case of a struck plate: an FRF over a whole band, free or in its clamp, read at one to three points."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from drivers.simulated.plant.one_thread import one_thread
from fitting.arrays import Array, Complex
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from fitting.theory_error import theory_error
from instrument.campaign.plates.blows import Blows, draw_blows
from instrument.campaign.plates.geometry import PLATES, TruePlate, plate_named
from instrument.campaign.plates.hidden.base import Hidden
from instrument.campaign.plates.kept import struck_plate
from instrument.campaign.plates.materials import PlateMaterialLaw, draw_law, fits
from instrument.campaign.plates.reduced import ReducedSolid
from instrument.campaign.plates.response import remaining_damping
from instrument.campaign.plates.stated import (
    CAREFUL,
    digits,
    draw_stated,
    law_lines,
    layer_lines,
    specimen_from,
)
from instrument.campaign.plates.struck import resonance
from instrument.impact.mobility import GAIN

Place = tuple[float, float]

PLACES: tuple[Place, ...] = (
    (0.03, 0.05),
    (0.95, 0.08),
    (0.97, 0.93),
    (0.31, 0.96),
    (0.62, 0.03),
    (0.46, 0.36),
    (0.22, 0.58),
    (0.76, 0.71),
)
"""Of length and width: where a plate may be struck or read."""
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
_MOST_LAWS = 200
_JUDGED = 5
_STIFF_PA, _SOFT_PA = 2e6, 0.3e6


@dataclass(frozen=True)
class StruckTruth:
    """What was hidden: the law alone."""

    plate: TruePlate
    free: bool
    law: PlateMaterialLaw
    blows: Blows
    force_m: Place
    spots_m: tuple[Place, ...]
    resonances_hz: tuple[float, ...]
    """Five of a band from the first to the last: where the law is judged."""
    effects: tuple[Hidden, ...] = ()

    @property
    def specimen_name(self) -> str:
        """Of the plate."""
        return f"{self.plate.name} {'free' if self.free else 'clamped'}"

    @property
    def modulus_pa(self) -> Complex:
        """Of the core at the resonances. Shape (resonances,)."""
        return self.law.modulus(2 * np.pi * np.array(self.resonances_hz))

    @property
    def names(self) -> tuple[str, ...]:
        """Of the effects."""
        return tuple(h.name for h in self.effects)


@dataclass(frozen=True)
class StruckCase:
    """What an identification or a diagnosis is given, and the truth that it is not."""

    seed: int
    sweep: Sweep
    specimen: Specimen
    specimen_toml: str
    truth: StruckTruth
    kind: str = "none"
    exact: bool = False
    hammer: tuple[Array, Array] | None = None


def draw_struck(seed: int, *, plate: str | None = None, free: bool | None = None) -> StruckCase:
    """A random case, always the same for the same arguments. Raises `ArithmeticError` where none is found."""

    def rng(purpose: str) -> np.random.Generator:
        return np.random.default_rng([seed, 7, *purpose.encode()])

    chance = rng("plate")
    true = plate_named(plate) if plate else PLATES[int(chance.integers(len(PLATES)))]
    hangs = bool(chance.random() < _FREE) if free is None else free
    at = chance.permutation(len(PLACES))[: 2 + int(chance.integers(3))]
    # In a clamp what is next to it hardly moves.
    places = [PLACES[k] for k in at if hangs or PLACES[k][0] > 0.2]
    if len(places) < 2:
        places = [PLACES[4], PLACES[7]]
    force, *spots = ((x * true.length_m, y * true.width_m) for x, y in places)
    solid = struck_plate(true, tuple((x * true.length_m, y * true.width_m) for x, y in PLACES), free=hangs)
    law, found = _law_and_resonances(rng("law"), true, solid, free=hangs)
    f = _lines(rng("lines"), found)
    blows = draw_blows(rng("blows"), float(f[-1]))
    judged = [found[k] for k in np.round(np.linspace(0, len(found) - 1, _JUDGED)).astype(int)]
    truth = StruckTruth(true, hangs, law, blows, force, tuple(spots), tuple(judged))
    sweep = _measured(truth, solid, f, rng("noise"))
    text = _stated(rng("stated"), truth)
    return StruckCase(seed, sweep, specimen_from(text), text, truth)


def _law_and_resonances(
    rng: np.random.Generator, true: TruePlate, solid: ReducedSolid, *, free: bool
) -> tuple[PlateMaterialLaw, list[float]]:
    first = 6 if free else 0
    low, high = (
        np.sqrt(solid.modes(g, first + n + 1)[0][-1]) / (2 * np.pi)
        for g, n in ((_SOFT_PA, 0), (_STIFF_PA, _MOST // 2))
    )
    for _ in range(_MOST_LAWS):
        law = draw_law(rng, (0.6 * float(low), min(float(high), _HIGHEST_HZ)))
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


def _held_by_theory(true: TruePlate, law: PlateMaterialLaw, frequency_hz: float) -> bool:
    at = _specimen_of(true)
    G = law.modulus(2 * np.pi * frequency_hz)
    return bool(theory_error(at, [frequency_hz], G).excess[0] < _THEORY)


def _specimen_of(true: TruePlate) -> Specimen:
    return specimen_from(_toml(true, (0.0, 0.0), (true.spot_m,), free=False, middle_hz=100.0))


def _lines(rng: np.random.Generator, found: list[float]) -> Array:
    """Even lines, as a spectrum has them. Shape (lines,)."""
    low, high = found[0] * rng.uniform(*_BEGINS), found[-1] * rng.uniform(*_ENDS)
    step = (high - low) / np.exp(rng.uniform(*np.log(_LINES)))
    return np.asarray(step * np.arange(np.ceil(low / step), np.floor(high / step) + 1))


@one_thread
def _measured(truth: StruckTruth, solid: ReducedSolid, f: Array, rng: np.random.Generator) -> Sweep:
    hits = [_on(truth.plate, truth.force_m, off) for off in truth.blows.offsets_m]
    push = np.array([solid.reading(*at) for at in hits])
    spots = [_on(truth.plate, at, CAREFUL.pickup_m * rng.standard_normal(2)) for at in truth.spots_m]
    read = np.array([solid.reading(*at) for at in spots])
    ratios = np.array([] if truth.free else truth.plate.ratios)
    C_1 = remaining_damping(solid, ratios) if len(ratios) else 0.0
    each = np.empty((len(spots), len(hits), len(f)), complex)
    for k, w in enumerate(2 * np.pi * f):
        Z = solid.K_0 + truth.law.modulus(w) * solid.whole_core - w**2 * solid.M + 1j * w * C_1
        each[:, :, k] = 1j * w * (read @ np.linalg.solve(Z, push.T.astype(complex)))
    channels = np.exp(GAIN * rng.standard_normal() - 2j * np.pi * f * CAREFUL.delay_s * rng.standard_normal())
    found = [truth.blows.read(rng, f, own * channels) for own in each]
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


def _on(plate: TruePlate, at: Place, off: Any) -> Place:
    x, y = np.clip(np.add(at, off), 0.0, (plate.length_m, plate.width_m))
    return float(x), float(y)


def _stated(rng: np.random.Generator, truth: StruckTruth) -> str:
    """The specimen file. Spots and the force are where they were meant to be."""
    believed = draw_stated(rng, truth.plate)
    places = [_on(believed, at, 0.0) for at in (truth.force_m, *truth.spots_m)]
    middle = float(np.median(truth.resonances_hz))
    return _toml(believed, places[0], places[1:], free=truth.free, middle_hz=middle)


def _toml(plate: TruePlate, force_m: Place, spots_m: Any, *, free: bool, middle_hz: float) -> str:
    core, faces = plate.core, (("substrate", plate.substrate), ("constraining", plate.constraining))
    assert core is not None
    lines = ["[plate]", f"length_mm = {digits(1e3 * plate.length_m)}"]
    lines += [f"width_mm = {digits(1e3 * plate.width_m)}"]
    lines += [f'boundary = "{"free" if free else "cantilever"}"', ""]
    for name, face in faces:
        assert face is not None
        lines += layer_lines(name, face)
    lines += [*layer_lines("core", core), *law_lines(middle_hz)]
    if not free:
        ratios = ", ".join(digits(100 * r) for r in plate.ratios)
        lines += ["[damping]", f"modal_percent = [{ratios}]", ""]
    for x, y in spots_m:
        lines += ["[[pickup]]", f"x_mm = {digits(1e3 * x)}", f"y_mm = {digits(1e3 * y)}", ""]
    lines += ["[excitation]", 'kind = "force"']
    lines += [f"x_mm = {digits(1e3 * force_m[0])}", f"y_mm = {digits(1e3 * force_m[1])}", "", "[tolerances]"]
    said = replace(CAREFUL, gain=GAIN).lines()
    lines += [line for line in said if not (free and line.startswith("damping"))]
    return "\n".join([*lines, f"force_mm = {1e3 * _FORCE_M:g}"]) + "\n"
