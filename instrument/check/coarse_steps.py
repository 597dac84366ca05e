"""Steps too far apart for a resonance between them: a segment that cannot see what it was laid around."""

from collections.abc import Iterator

import numpy as np

from instrument.check.forecast import Forecast
from instrument.stepped_sine.plan import PlannedSegment

_BESIDE = 2.0
"""Half-power widths beside a mode at which its response is compared with that on it."""
_STANDS_OUT = 1.5
"""Times the response beside it, from which a mode shows as a resonance: others the base does not stir."""
_ACROSS = 1.0
"""Steps to a half-power width at least: with fewer none need lie on it."""


def coarse_remarks(forecast: Forecast, planned: PlannedSegment) -> Iterator[str]:
    """A line for each resonance that a segment's steps may miss; evenly stepped segments are meant."""
    f = np.sort(np.array(planned.frequencies_hz))
    for centre, decay in zip(forecast.mode_hz, forecast.mode_decay_1_s, strict=True):
        # The half-power width of a mode is 2 sigma in rad/s.
        width = float(decay / np.pi)
        at = int(np.searchsorted(f, centre))
        if not 0 < at < len(f) or f[at] - f[at - 1] <= width / _ACROSS:
            continue
        if min(f[at] - centre, centre - f[at - 1]) < width / 2:
            continue
        probe = np.array([centre, centre - _BESIDE * width, centre + _BESIDE * width])
        on, *beside = forecast.velocity_m_s(probe, 1.0)
        if on > _STANDS_OUT * max(beside):
            yield (
                f"segment {planned.segment}: no step on the resonance expected at about {centre:.4g} Hz, "
                f"which is {width:.2g} Hz wide: the nearest steps are {f[at - 1]:g} and {f[at]:g} Hz"
            )
