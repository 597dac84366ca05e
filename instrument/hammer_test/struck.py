"""Blows on the treated plate as they come: force and velocity in, hits and the mobility out. Pure."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from fitting.arrays import Array
from instrument.errors import BadInput
from instrument.hammer_test.analysis import HammerAnalysis, HammerSettings
from instrument.impact.mobility import Mobility, lines_about, mobility_of, peaks_of
from instrument.impact.record import ResponseChannel
from instrument.stepped_sine.calibration import Calibration
from instrument.stream.derived import HitRevised, StruckFound
from instrument.stream.event import Derived
from instrument.stream.raw import BlockAcquired, HammerTestEnded, RangeSet, StrikingBegan
from instrument.stream.scaling import Scaling

FEWEST_HITS = 3
"""Their scatter is what the mobility is worth: of two it would hardly be known."""
OVERLOADED = "overload of the velocity"
"""In why a hit was refused: the laser's range had no room for it."""
_LONGEST_FREE_S = 2.0
"""Of a record of a plate that hangs free: no treated one rings so long above its slowest mode of 50 Hz."""
_RESONANCES, _LINES = 6, 120
"""Read of the lowest in the sweep's band, and lines about them: a bound on the diagnosis's time. Choices."""
_SLOW = (0.15, 0.35)
"""Of the lowest resonance: there a plate moves as a whole, or bends as under a weight."""
_TELLS = 0.3
"""Of one, that its motion as a whole has to be at the laser's spot to say which way it was pushed."""
_CYCLES = 4.0
"""Of the slowest line in a record."""


def settings_for(began: StrikingBegan, hammer: HammerSettings) -> HammerSettings:
    """How these hits are recorded, by how those of the bare plate are."""
    longest = _LONGEST_FREE_S if began.held == "free" else hammer.record_s
    record_s, hits = min(hammer.record_s, longest), max(FEWEST_HITS, hammer.hits)
    return replace(hammer, hits=hits, record_s=record_s, sensor=None)


class StruckAnalysis(HammerAnalysis):
    """Follows the blows on a treated plate."""

    def __init__(
        self,
        began: StrikingBegan,
        hammer: HammerSettings,
        scaling: Scaling,
        sample_rate_hz: float,
        band_hz: tuple[float, float],
        range_set: RangeSet,
        calibration: Callable[[str], Calibration | None],
    ) -> None:
        """`band_hz` is the sweep's; `range_set` the laser's, `calibration` gives that of a range."""
        super().__init__(settings_for(began, hammer), scaling, sample_rate_hz)
        self._began, self._band_hz, self._calibration = began, band_hz, calibration
        self._range = range_set

    response = "velocity"

    def range_set(self, event: RangeSet) -> list[Derived]:
        """The laser's, from here on; blows that were read in another one, at its delay, are let go of."""
        if event.name == self._range.name:
            return []
        self._range = event
        found: list[Derived] = []
        for number, hit in enumerate(self._hits, start=1):
            if hit.accepted:
                hit.accepted = False
                found.append(HitRevised(number, accepted=False))
        return found

    def _rows(self, block: BlockAcquired) -> Array:
        volts = block.volts
        velocity = self._scaling.velocity(volts, self._range.scale_m_s_v)
        return np.stack([self._scaling.units("force", volts), velocity])

    def _channel(self, samples: Array) -> ResponseChannel:
        return ResponseChannel("velocity", "velocity", samples)

    def ended(self, _: HammerTestEnded) -> list[Derived]:
        """The mobility of the accepted hits; none where they are too few."""
        kept = [h.judged for h in self._hits if h.accepted]
        known = self._calibration(self._range.name)
        try:
            found = mobility_of(kept)
        except BadInput:
            return []
        found, remarks = self._turned(found)
        if known is None:
            remarks.append(f"the laser's range {self._range.name} is not calibrated")
        else:
            right = np.exp(2j * np.pi * found.frequency_hz * known.delay_s) / known.gain
            found = replace(found, H=found.H * right, std=found.std / known.gain)
        places, segment = lines_about(found, *self._band_hz, _RESONANCES, _LINES)
        lines, b = found.at(places), self._began
        return [
            StruckFound(
                b.held, b.struck_mm, b.spot_mm, b.size_mm, b.mounting, len(kept),
                _floats(lines.frequency_hz), tuple(segment.tolist()), _floats(lines.H.real),
                _floats(lines.H.imag), _floats(lines.std), tuple(remarks),
            )
        ]  # fmt: skip

    def _turned(self, found: Mobility) -> tuple[Mobility, list[str]]:
        """Whichever side it was struck from.

        The way it moves far below its resonances tells the force's sign.
        """
        f, H = found.frequency_hz, found.H
        slowest = _CYCLES / self.record_s
        lowest = min((p for p, _ in peaks_of(found, slowest, self._band_hz[1])), default=self._band_hz[0])
        slow = (f > max(_SLOW[0] * lowest, slowest)) & (f < _SLOW[1] * lowest)
        if not slow.any():
            return found, []
        s = 2j * np.pi * f[slow]
        if self._began.held == "clamped":
            way = float(np.median((H[slow] / s).real))
        else:
            assert self._began.spot_mm is not None
            places = np.array([self._began.struck_mm, self._began.spot_mm]) / self._began.size_mm - 0.5
            # A uniform plate's heave and two turns.
            whole = 1 + 12 * float(places[0] @ places[1])
            if abs(whole) < _TELLS:
                return found, []
            way = float(np.median((H[slow] * s).real)) * whole
        if way > 0:
            return found, []
        turned = replace(found, H=-H)
        return turned, ["it was struck against the laser's direction: the force's sign is turned"]


def _floats(values: Array) -> tuple[float, ...]:
    return tuple(float(v) for v in values)
