"""What blows read of a solid plate with what is hidden on it, in it or in the channels."""

from collections.abc import Sequence
from functools import reduce
from typing import Any

import numpy as np

from campaign.law import TrueLaw
from campaign.plates import kept
from campaign.plates.blows import Blows
from campaign.plates.geometry import TruePlate
from campaign.plates.hidden.base import Hidden
from campaign.plates.hidden.struck import PLACES, HiddenOfBlows, Place
from campaign.plates.reduced import MODULI_PA, ReducedSolid
from campaign.plates.response import BaseMotion, remaining_damping
from campaign.plates.simulate import with_effects
from drivers.simulated.plant.one_thread import one_thread
from fitting.arrays import Array, Complex


def places_on(true: TruePlate) -> tuple[Place, ...]:
    """`PLACES` in m."""
    return tuple((x * true.length_m, y * true.width_m) for x, y in PLACES)


def solid_of(true: TruePlate, hidden: Sequence[Hidden], *, free: bool) -> ReducedSolid:
    """The plate with its effects, able to answer forces at `PLACES`; without any, the one that is kept."""
    if not any(h.changes_solid for h in hidden):
        return kept.struck_plate(true, places_on(true), free=free)
    return with_effects(
        true,
        hidden,
        MODULI_PA,
        points_m=places_on(true),
        free=free,
        fineness=kept.WHERE_FREE if free else kept.WHERE_CLAMPED,
        modes=kept.STRUCK_MODES,
    )


def plate_of(true: TruePlate, hidden: Sequence[Hidden]) -> TruePlate:
    """Sizes and metals as effects have them."""
    return reduce(lambda p, h: h.plate(p), hidden, true)


@one_thread
def mobilities(
    solid: ReducedSolid,
    law: TrueLaw,
    frequency_hz: Array,
    hits_m: Sequence[Place],
    spots_m: Sequence[Place],
    hidden: Sequence[Hidden] = (),
    ratios: Array | Sequence[float] = (),
) -> Complex:
    """Velocity at each spot for 1 N at each hit, in m/s; the plate's own remaining damping in `ratios`.

    Shape (spots, hits, lines).
    """
    push, read = (np.array([solid.reading(*at) for at in points]) for points in (hits_m, spots_m))
    still = BaseMotion.pure(len(frequency_hz))
    omega = 2 * np.pi * frequency_hz
    hung = [a for h in hidden for a in h.attached(omega, still, float(solid.ends_y_m[-1]))]
    rows = [solid.reading(a.x_m, a.y_m) for a in hung]
    C_1 = remaining_damping(solid, np.array(ratios)) if len(ratios) else 0.0
    K_0 = solid.K_0 + 1j * solid.rubbing
    windows = [h.weighted() for h in hidden if isinstance(h, HiddenOfBlows)]
    per_s, integrations = sum(w for w, _ in windows), sum(n for _, n in windows)
    found = np.empty((len(spots_m), len(hits_m), len(frequency_hz)), complex)
    for k, w in enumerate(omega):
        s = 1j * w + per_s
        G = law.beside(w, per_s) if per_s else law.modulus(w)
        Z = K_0 + G * solid.whole_core + s**2 * solid.M + s * C_1
        for a, row in zip(hung, rows, strict=True):
            Z = Z + a.stiffness_n_m[k] * np.outer(row, row)
        read_of = s * (s / (1j * w)) ** integrations
        found[:, :, k] = read_of * (read @ np.linalg.solve(Z, push.T.astype(complex)))
    return found


def aimed(plate: TruePlate, at: Place, off: Any, hidden: Sequence[Hidden], spot: int | None = None) -> Place:
    """Where a blow lands, or a spot is (`spot`, from 0), of a point on the plate and what it is beside."""
    for h in hidden:
        at = h.spot(at, plate)
        if isinstance(h, HiddenOfBlows):
            at = h.of_force(at) if spot is None else h.of_spot(spot, at)
    return on_plate(plate, at, off)


def on_plate(plate: TruePlate, at: Place, off: Any) -> Place:
    """A point so far beside another one, on the plate still."""
    x, y = np.clip(np.add(at, off), 0.0, (plate.length_m, plate.width_m))
    return float(x), float(y)


def through_channels(mobility: Complex, omega: Array, hidden: Sequence[Hidden], spot: int) -> Complex:
    """What channels make of what is read at a spot, counted from 0. Shape (..., lines)."""
    for h in hidden:
        mobility = h.channel(mobility, omega, np.zeros(len(omega), complex))
        if isinstance(h, HiddenOfBlows):
            mobility = h.of_reading(spot, mobility)
    return mobility


def struck_so(blows: Blows, hidden: Sequence[Hidden]) -> Blows:
    """Blows with what effects make of them."""
    return reduce(lambda b, h: h.of_blows(b) if isinstance(h, HiddenOfBlows) else b, hidden, blows)
