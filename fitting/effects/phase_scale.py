"""The phase meter's scale is off: phases come out a few percent too large or too small."""

from collections.abc import Mapping
from functools import lru_cache
from itertools import pairwise

import numpy as np

from fitting.arrays import Array, Complex, Places, as_slice
from fitting.effects.base import EVERY_STRUCTURE, Effect, EffectParameter
from fitting.effects.given import Points
from fitting.widened.enriched_plate import EnrichedReducedPlate

_HIGHEST = np.pi / 2
"""Of a peak's phase, rad; the lowest lies a turn below."""
_GAP = 0.1
"""In ln f, beyond which two points belong to different segments."""


class PhaseScaleEffect(Effect):
    """|v| e^{i factor phi}, phi as it is `counted`.

    0: continuously along a segment; 1: between 0 and a turn; 2: half a turn to either side.
    A plate's velocity relative to its base passes -pi at a resonance (below it -pi/2, above it -3 pi/2), or 0
    where the pickup moves against the tip. So the phase of every segment's largest reading is taken between
    -3 pi/2 and pi/2, a quarter turn off either; the others follow from it without a jump.
    """

    name = "phase_scale"
    enters = "channel"
    source = "gain error of a phase detector's output, phases taken as lags behind the reference"
    structures = EVERY_STRUCTURE
    parameters = (
        EffectParameter("factor", "1", 0.8, 1.2, 1.02, neutral=1.0, spread=0.03),
        EffectParameter("counted", "1", 0.0, 2.0, 0.0, neutral=None, fixed=True),
    )
    chance = 0.005
    discriminating_test = "two channels on one generator with a known phase between them"

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None if points.has_phase else "amplitudes do not show a phase"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([self.parameters[0].typical, counted]) for counted in (0.0, 1.0, 2.0)]

    def reading(self, v: Complex, points: Points, u: Array) -> Complex:
        if u[1] == 0:
            phase = continuous_phase(v, points.omega)
        else:
            phase = np.angle(v) % (2 * np.pi) if u[1] == 1 else np.angle(v)
        return np.asarray(v * np.exp(1j * (u[0] - 1) * phase))

    def story(self, u: Mapping[str, float]) -> str:
        return f"phases are read {100 * (u['factor'] - 1):+.2g} % off"


def continuous_phase(v: Complex, omega: Array) -> Array:
    """Argument of `v` (m/s over a real reference), rad, without jumps in a segment.

    Shapes (points,) of `omega`, (..., points) of `v`.
    """
    order, segments = _upwards(omega.tobytes())
    angle, size, phase = np.angle(v[..., order]), np.abs(v[..., order]), np.empty(v.shape)
    found = angle.copy()
    # Whole turns between segments are no matter: a segment's own follow from its peak.
    found[..., 1:] -= 2 * np.pi * np.cumsum(np.round(np.diff(angle) / (2 * np.pi)), axis=-1)
    for here in segments:
        largest = np.argmax(size[..., here], axis=-1, keepdims=True)
        peak = np.take_along_axis(found[..., here], largest, axis=-1)
        found[..., here] -= 2 * np.pi * np.ceil((peak - _HIGHEST) / (2 * np.pi))
    phase[..., order] = found
    return phase


@lru_cache(maxsize=32)
def _upwards(omega: bytes) -> tuple[Places, list[slice]]:
    """The order of frequencies in rad/s, and where each segment lies in it.

    Kept: every step of a fit asks for the same ones.
    """
    known = np.frombuffer(omega)
    order = np.argsort(known, kind="stable")
    gaps = np.flatnonzero(np.diff(np.log(known[order])) > _GAP) + 1
    return as_slice(order), [slice(a, b) for a, b in pairwise([0, *gaps.tolist(), len(known)])]
