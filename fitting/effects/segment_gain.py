"""One segment of a sweep was read with another gain: a range, an attenuator or a conversion of its own."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.data.levels import are_of, by_level
from fitting.effects.base import EVERY_STRUCTURE, Effect, EffectParameter
from fitting.effects.given import Points
from fitting.widened.enriched_plate import EnrichedReducedPlate

_EVERY = 0.0
"""In the place of a level: all of them."""
_ROUNDING = 1e-9
"""Of a frequency: a segment's own ends lie in it."""
_HZ = 1.0 / (2 * np.pi)


class SegmentGainEffect(Effect):
    """Velocity times a real factor from one frequency to another, at one level or at all.

    A factor alike in all segments is `gain_error`.
    """

    name = "segment_gain"
    enters = "channel"
    source = "a vibrometer's ranges differ by 1 % and more, and are chosen anew with the velocity"
    structures = EVERY_STRUCTURE
    parameters = (
        EffectParameter("factor", "1", 0.2, 5.0, 1.03, neutral=1.0, spread=0.05),
        EffectParameter("from", "Hz", 0.0, np.inf, 0.0, neutral=None, fixed=True),
        EffectParameter("to", "Hz", 0.0, np.inf, 0.0, neutral=None, fixed=True),
        EffectParameter("level", "m/s^2", 0.0, np.inf, _EVERY, neutral=None, fixed=True),
    )
    chance = 0.015
    of_a_segment = True
    discriminating_test = "one frequency read in every range that was used; the sweep repeated in one range"

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None if len(self._segments(points)) > 1 else "there is one segment"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [
            np.array([self.parameters[0].typical, low, high, level])
            for low, high, levels in self._segments(points)
            for level in (_EVERY, *levels)
        ]

    def reading(self, v: Complex, points: Points, u: Array) -> Complex:
        f = points.omega * _HZ
        here = (f >= u[1] * (1 - _ROUNDING)) & (f <= u[2] * (1 + _ROUNDING))
        if u[3] != _EVERY:
            here &= are_of(float(u[3]), points.drive_amplitude)
        return np.asarray(v * np.where(here, u[0], 1.0))

    def story(self, u: Mapping[str, float]) -> str:
        at = "" if u["level"] == _EVERY else f" at {u['level']:.3g} m/s^2"
        percent = 100 * (u["factor"] - 1)
        return (
            f"the velocity channel reads {percent:+.2g} % off from {u['from']:.4g} to {u['to']:.4g} Hz{at} "
            "alone"
        )

    def _segments(self, points: Points) -> list[tuple[float, float, list[float]]]:
        """Their lowest and highest frequencies, Hz, and the levels of those that were read at several."""
        if points.segment is None:
            return []
        found = []
        for label in np.unique(points.segment):
            f, a = (x[points.segment == label] for x in (points.omega * _HZ, points.drive_amplitude))
            levels = [float(np.median(a[part])) for part in by_level(a)]
            found.append((float(f.min()), float(f.max()), levels if len(levels) > 1 else []))
        return found
