"""What the rig would read without noise: the plate with its effects, moved and seen as it really is."""

from collections.abc import Sequence
from functools import reduce

import numpy as np

from campaign.law import TrueLaw
from campaign.plates.channel import ChannelError
from campaign.plates.geometry import TruePlate
from campaign.plates.grid import Fineness
from campaign.plates.hammer import HammerTest, hammer_test
from campaign.plates.hidden.base import Hidden
from campaign.plates.hidden.core import HiddenAmplitudeSoftening
from campaign.plates.kept import bare_plate, bare_solid, clean_plate
from campaign.plates.reduced import MODES, REFERENCE_MODULUS_PA, ReducedSolid, reduced
from campaign.plates.response import BaseMotion, Shaken, remaining_damping
from campaign.plates.softening import softened
from campaign.plates.solid import Build, Solid
from campaign.schedule import Schedule
from fitting.arrays import Array, Complex

_LOOK, _LOOKED_AT = (0.62, 1.3), 90
"""Of a clean resonance's frequency: where an effect may have moved it."""
_NEAR = 0.15
"""In the logarithm of frequency: how far a peak has moved that still counts for most."""
_BEYOND, _ABOVE = 1.2, 1.5
"""How far a basis goes beyond the stiffest core of a sweep, and beyond where remaining damping is stated."""


def built(
    true: TruePlate, hidden: Sequence[Hidden], moduli_pa: Sequence[float], fineness: Fineness | None = None
) -> ReducedSolid:
    """The plate with its effects; without any, the one that is kept."""
    if not any(h.changes_solid for h in hidden):
        return clean_plate(true, fineness)
    return with_effects(true, hidden, moduli_pa, fineness=fineness)


def with_effects(
    true: TruePlate,
    hidden: Sequence[Hidden],
    moduli_pa: Sequence[float],
    *,
    points_m: Sequence[tuple[float, float]] = (),
    free: bool = False,
    fineness: Fineness | None = None,
    modes: int = MODES,
) -> ReducedSolid:
    """The plate with its effects, able to answer a force at points; `free` without its clamp."""
    build = reduce(lambda b, h: h.build(b, true), hidden, Build(free=free))
    solid = Solid(reduce(lambda p, h: h.plate(p), hidden, true), build, fineness)
    groups = {h.groups for h in hidden}
    return reduced(
        solid,
        moduli_pa,
        groups=next((g for g in ("bricks", "columns") if g in groups), "whole"),
        points_m=[*points_m, *(at for h in hidden for at in h.points())],
        air_density_kg_m3=sum(h.air_kg_m3 for h in hidden),
        stirred=[
            *(solid.core_with(field) for h in hidden for field in h.stirred(solid.plate)),
            *([solid.rubbing] if build.root is not None and build.root.loss else []),
        ],
        modes=modes,
    )


def moduli_of(law: TrueLaw, frequency_hz: Array) -> tuple[float, ...]:
    """Where the basis of a plate with this law is made. Shape (n,)."""
    size = np.abs(law.modulus(2 * np.pi * np.array([frequency_hz.min(), frequency_hz.max()])))
    low, high = min(size[0], REFERENCE_MODULUS_PA), max(_BEYOND * size[1], _ABOVE * REFERENCE_MODULUS_PA)
    return tuple(float(g) for g in np.geomspace(low, high, 3))


def reading(
    plate: ReducedSolid,
    true: TruePlate,
    hidden: Sequence[Hidden],
    law: TrueLaw,
    schedule: Schedule,
    channel: ChannelError,
) -> Complex:
    """The same of a plate as `built`. Shape (points,)."""
    omega = 2 * np.pi * schedule.frequency_hz
    motion = reduce(lambda m, h: h.motion(m, omega), hidden, BaseMotion.pure(len(omega)))
    ratios = reduce(lambda r, h: h.ratios(r), hidden, np.array(true.ratios))
    hung = [a for h in hidden for a in h.attached(omega, motion, true.width_m)]
    attached = None
    if hung:
        rows = np.array([plate.reading(a.x_m, a.y_m) for a in hung])
        attached = rows, np.array([a.stiffness_n_m for a in hung]), np.array([a.force_n for a in hung])
    G = _modulus(plate, true, hidden, law, schedule)
    shaken = Shaken(plate, remaining_damping(plate, ratios), omega, motion, attached)
    soft = next((h for h in hidden if isinstance(h, HiddenAmplitudeSoftening)), None)
    q = softened(shaken, G, soft, schedule) if soft else shaken.displacements(G)
    spot = reduce(lambda s, h: h.spot(s, true), hidden, true.spot_m)
    v = 1j * omega * (q @ plate.reading(*spot))
    # The base's own motion at the spot beyond its heave: what a laser that moves with the clamp would see.
    v = v + (motion.at(*spot, true.width_m) - 1) / (1j * omega)
    v = reduce(lambda s, h: h.channel(s, omega, np.ones(len(omega)) / (1j * omega)), hidden, v)
    v = channel.factor(omega) * v
    return np.asarray(v / reduce(lambda b, h: h.reference(b, omega), hidden, np.ones(len(omega), complex)))


def peaks_hz(
    plate: ReducedSolid,
    true: TruePlate,
    hidden: Sequence[Hidden],
    law: TrueLaw,
    expected_hz: Sequence[float],
) -> list[float]:
    """Where the response has its peak near each of the frequencies at which the clean plate has one."""
    around = np.geomspace(*_LOOK, _LOOKED_AT)
    f = np.concatenate([at * around for at in expected_hz])
    at_rest = Schedule(f, *(np.ones(len(f), np.intp),) * 2, np.full(len(f), 1e-6), np.zeros(len(f)))
    size = np.abs(reading(plate, true, hidden, law, at_rest, ChannelError())).reshape(len(expected_hz), -1)
    # A far neighbour may be larger: the nearer counts more.
    likely = size * np.exp(-((np.log(around) / _NEAR) ** 2) / 2)
    inner = (likely[:, 1:-1] >= likely[:, :-2]) & (likely[:, 1:-1] >= likely[:, 2:])
    best = 1 + np.argmax(np.where(inner, likely[:, 1:-1], 0.0), axis=1)
    return [at * float(around[k]) for at, k in zip(expected_hz, best, strict=True)]


def _modulus(
    plate: ReducedSolid, true: TruePlate, hidden: Sequence[Hidden], law: TrueLaw, schedule: Schedule
) -> Complex:
    """Of each group of the core at each point, or of all alike."""
    omega = 2 * np.pi * schedule.frequency_hz
    for h in hidden:
        factor = h.frequency_factor(schedule.time_s, plate.group_x_m, true.length_m)
        if factor is not None:
            return law.modulus(omega[:, None] * factor)
    return law.modulus(omega)


def struck(
    true: TruePlate,
    hidden: Sequence[Hidden],
    rng: np.random.Generator,
    ratio_scatter: float,
    yields: bool,
) -> HammerTest:
    """A hammer test of the bare plate, which shares the substrate and its faults with the treated one."""
    plate, build = true.bare, Build()
    for h in hidden:
        plate, build = h.at_hammer(plate, build)
    if plate == true.bare and build == Build():
        rigid, sprung = bare_plate(true, False), bare_plate(true, True)
    else:
        rigid, sprung = bare_solid(plate, build, False), bare_solid(plate, build, True)
    return hammer_test(rng, rigid, sprung, np.array(true.ratios), ratio_scatter, yields)
