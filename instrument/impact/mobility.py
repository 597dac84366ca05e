"""From blows on a treated plate to its mobility, with what it is worth, about its resonances."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from instrument.errors import BadInput
from instrument.impact.judge import Judged
from instrument.impact.spectra import force_window

GAIN = 0.01
"""How well a hammer's force is known beside the laser's velocity, relative: its sensitivity, and how squarely
a hand hits. A choice."""
DELAY_S = 1e-4
"""How well the delay between both channels is known: a calibration in place is of accelerometer and laser,
and a front-end may sample one input up to a sample after the other. A choice."""
_FADES_OUT = 0.25
"""Of a record: by then nothing rings any more."""
_NEIGHBOURS = 9
"""Lines over which the scatter of the blows is averaged: few blows tell that of one line badly."""
_PROMINENCE = 0.1
"""Of a peak's height, that it stands above what is around it; a choice."""
_OVER_SCATTER = 10.0
"""Of a peak over what the lines scatter by."""
_LEAST_REACH = 0.03
"""To either side of a resonance, of its frequency; and at least so many of its half widths: a choice."""
_HALF_WIDTHS = 3.0
_EVENLY = 60
"""Lines over the band where it has no peak."""


@dataclass(frozen=True)
class Mobility:
    """Velocity over force, a mean over blows. All of shape (lines,)."""

    frequency_hz: Array
    H: Complex
    """In m/s per N."""
    std: Array
    """Of each part of the mean."""

    def at(self, lines: NDArray[np.intp]) -> "Mobility":
        """The mobility at some of its lines. Shape of `lines` (any,)."""
        return Mobility(self.frequency_hz[lines], self.H[lines], self.std[lines])


def mobility_of(hits: Sequence[Judged]) -> Mobility:
    """H1 of hits whose response is a velocity. Raises `BadInput` for fewer than two.

    A plate that hangs still sways when its modes have died away, and a record that is cut off there would
    leak into every line. So it is the differences from sample to sample that are transformed, faded in
    before the blow and out at the end: they hold little of a slow motion, and are divided by what taking
    them does to a line.
    """
    if len(hits) < 2:
        raise BadInput(f"{len(hits)} good hit, expected two or more: one says nothing of its scatter")
    n, rate = len(hits[0].hit.force_n), hits[0].hit.sample_rate_hz
    f = np.asarray(np.fft.rfftfreq(n, 1 / rate)[1:], dtype=np.float64)
    steps = 1 - np.exp(-2j * np.pi * f / rate)
    F = np.array([np.fft.rfft(force_window(j) * j.hit.force_n)[1:] for j in hits])
    X = np.array([_differences(j) for j in hits]) / steps
    return of_spectra(f, F, X)


def of_spectra(frequency_hz: Array, F: Complex, X: Complex) -> Mobility:
    """H1 of spectra of force and of velocity, with what the hits scatter by. Shapes (hits, lines)."""
    hits, lines = F.shape
    power = np.maximum((np.abs(F) ** 2).sum(axis=0), 1e-300)
    H = (X * F.conj()).sum(axis=0) / power
    scatter = (np.abs(X - H * F) ** 2).sum(axis=0) / (hits - 1)
    around = np.ones(min(_NEIGHBOURS, lines))
    smooth = np.convolve(scatter, around, "same") / np.convolve(np.ones(lines), around, "same")
    return Mobility(frequency_hz, np.asarray(H), np.asarray(np.sqrt(smooth / power / 2)))


def _differences(judged: Judged) -> Complex:
    v = judged.hit.responses[0].samples
    n, into = len(v), judged.pulse.start
    out = round(_FADES_OUT * n)
    w = np.ones(n)
    w[:into] = 0.5 * (1 - np.cos(np.pi * np.arange(into) / max(into, 1)))
    w[n - out :] = 0.5 * (1 + np.cos(np.pi * np.arange(1, out + 1) / out))
    return np.asarray(np.fft.rfft(w * np.diff(v, prepend=v[0]))[1:])


def peaks_of(found: Mobility, low_hz: float, high_hz: float) -> list[tuple[float, float]]:
    """Frequency and half width of each resonance that stands out in a band, in Hz, the lowest first."""
    # Loaded here: with what it brings along it takes as long as a third of the window's start.
    from scipy.signal import find_peaks, peak_widths

    inside = (found.frequency_hz >= low_hz) & (found.frequency_hz <= high_hz)
    f, size, std = found.frequency_hz[inside], np.abs(found.H[inside]), found.std[inside]
    if len(f) < _NEIGHBOURS:
        return []
    at, facts = find_peaks(size, prominence=0)
    high = facts["prominences"] > np.maximum(_PROMINENCE * size[at], _OVER_SCATTER * std[at])
    width = peak_widths(size, at[high], rel_height=1 - np.sqrt(0.5))[0] * (f[1] - f[0])
    return list(zip(f[at[high]].tolist(), (width / 2).tolist(), strict=True))


def lines_about(
    found: Mobility, low_hz: float, high_hz: float, most: int, count: int
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """At most `count` lines about the lowest resonances of a band, and whose each is, from 1.

    Over the whole band where it has no resonance. Shape (lines,) each.
    """
    f = found.frequency_hz
    peaks = peaks_of(found, low_hz, high_hz)[:most]
    lines: dict[int, int] = {}
    for number, (peak, half) in enumerate(peaks, start=1):
        reach = max(_HALF_WIDTHS * half, _LEAST_REACH * peak)
        for k in _some(np.flatnonzero(np.abs(f - peak) <= reach), count // len(peaks)):
            lines.setdefault(k, number)
    if not lines:
        lines = dict.fromkeys(_some(np.flatnonzero((f >= low_hz) & (f <= high_hz)), _EVENLY), 1)
    places = np.array(sorted(lines), dtype=np.intp)
    return places, np.array([lines[k] for k in places.tolist()], dtype=np.intp)


def _some(lines: NDArray[np.intp], count: int) -> list[int]:
    """Evenly among them."""
    places = np.unique(np.round(np.linspace(0, len(lines) - 1, min(count, len(lines)))).astype(int))
    return [int(k) for k in lines[places]]
