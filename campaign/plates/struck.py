"""Solid plates struck at points and read at others, free or clamped: mobilities, phasors of e^{i w t}."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from campaign.law import TrueLaw
from campaign.plates.geometry import TruePlate
from campaign.plates.grid import Fineness
from campaign.plates.hidden.base import Hidden
from campaign.plates.reduced import ReducedSolid
from campaign.plates.simulate import with_effects
from drivers.simulated.plant.one_thread import one_thread
from fitting.arrays import Array, Complex

Points = Sequence[tuple[float, float]]
LEFT_BEHIND = ("clamp", "base", "cable")
"""Where effects sit that a plate which hangs free has left."""
_MODES, _ROUNDS = 16, 4
"""That are looked at, six rigid ones of a free plate among them; and steps to a mode's own frequency."""
_REACH, _LEAST = 1.5, 0.03
"""How far lines go to either side of a resonance: of its half width, and of its frequency at least."""


def struck_plate(
    true: TruePlate,
    hidden: Sequence[Hidden],
    moduli_pa: Sequence[float],
    force_m: tuple[float, float],
    *,
    free: bool,
    fineness: Fineness | None = None,
) -> ReducedSolid:
    """A plate with its effects, able to answer a force at a point; `free` without clamp and what is of it.

    Raises `ValueError` for what hangs on it.
    """
    kept = [h for h in hidden if not (free and h.place in LEFT_BEHIND)]
    if any(h.points() for h in kept):
        raise ValueError("what hangs on the plate is not struck here")
    return with_effects(true, kept, moduli_pa, points_m=[force_m], free=free, fineness=fineness)


@one_thread
def mobility(
    plate: ReducedSolid,
    law: TrueLaw,
    frequency_hz: Array,
    force_m: tuple[float, float],
    spot_m: tuple[float, float],
    C_1: Array | float = 0.0,
) -> Complex:
    """Velocity of the upper face at a spot for 1 N at a point, the base at rest, in m/s. Shape (points,)."""
    push, read = plate.reading(*force_m), plate.reading(*spot_m)
    found = np.empty(len(frequency_hz), complex)
    for k, w in enumerate(2 * np.pi * frequency_hz):
        Z = plate.K_0 + 1j * plate.rubbing + law.modulus(w) * plate.whole_core - w**2 * plate.M + 1j * w * C_1
        found[k] = 1j * w * (read @ np.linalg.solve(Z, push.astype(complex)))
    return found


def lines_about(
    plate: ReducedSolid, law: TrueLaw, low_hz: float, high_hz: float, most: int, count: int
) -> tuple[Array, NDArray[np.intp]]:
    """Lines about the lowest resonances of a band, which a spectrum shows, and whose each is.

    Shape (resonances times `count`,) each. Raises `ValueError` where there is none.
    """
    found: list[Array] = []
    for r in range(_MODES):
        f, loss = resonance(plate, law, r, np.sqrt(low_hz * high_hz))
        if low_hz < f < high_hz and len(found) < most:
            reach = max(_REACH * loss / 2, _LEAST)
            found.append(f * np.linspace(1 - reach, 1 + reach, count))
    if not found:
        raise ValueError(f"no resonance from {low_hz:g} to {high_hz:g} Hz: nothing rings there")
    return np.concatenate(found), np.repeat(np.arange(len(found)), count)


def resonance(plate: ReducedSolid, law: TrueLaw, r: int, near_hz: float) -> tuple[float, float]:
    """Frequency and loss factor of the r-th mode, the modulus taken at its own frequency."""
    f, loss = near_hz, 0.0
    for _ in range(_ROUNDS):
        G = law.modulus(np.array([2 * np.pi * f]))[0]
        lam, phi = plate.modes(float(G.real), r + 1)
        # A rigid one has no frequency.
        f = float(np.sqrt(max(lam[r], 1.0)) / (2 * np.pi))
        loss = float(G.imag * (phi[:, r] @ plate.whole_core @ phi[:, r]) / max(lam[r], 1.0))
    return f, loss
