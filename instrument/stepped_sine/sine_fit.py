"""Sine fit at a known frequency, with offset, slope and harmonics (three-parameter fit of IEEE Std 1057).

    x(t) = c_0 + c_1 t + sum_k Re(X_k e^{i k omega t})

Least squares, so that any length of record serves: a projection over part of a cycle never settles.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fitting.arrays import Array, Complex

MOST_HARMONICS = 5
"""A shaker's distortion is in the second and third; more cost length of record."""
_BELOW_NYQUIST = 0.8
"""Share of the Nyquist frequency up to which harmonics are fitted."""
_LINES = 8
"""Lines either side of the frequency from which noise is read."""


@dataclass(frozen=True)
class SineFit:
    """Phasors of e^{+i omega t}, zero to peak, time from sample index 0. First axis: channels."""

    harmonics: Complex
    """Shape (channels, harmonics); the first is the fundamental."""
    std: Array
    """Of each part of the fundamental. Shape (channels,)."""
    mean: Array
    """Offset at the middle of the record. Shape (channels,)."""

    @property
    def phasor(self) -> Complex:
        """The phasor of the fundamental. Shape (channels,)."""
        return np.asarray(self.harmonics[:, 0])

    @property
    def distortion(self) -> Array:
        """Root sum of squares of the harmonics over the fundamental. Shape (channels,)."""
        higher = np.sqrt((np.abs(self.harmonics[:, 1:]) ** 2).sum(axis=1))
        return higher / np.maximum(np.abs(self.phasor), np.finfo(float).tiny)


def sine_fit(x: Array, first_sample: int, sample_rate_hz: float, frequency_hz: float) -> SineFit:
    """Fit x (channels, samples), whose first sample has index `first_sample`."""
    count = x.shape[1]
    harmonics = max(1, min(MOST_HARMONICS, int(_BELOW_NYQUIST * sample_rate_hz / 2 / frequency_hz)))
    basis, solve = _solver(count, frequency_hz / sample_rate_hz, harmonics)
    c = x @ solve.T
    local = c[:, 2::2] - 1j * c[:, 3::2]
    turn = np.exp(-2j * np.pi * frequency_hz / sample_rate_hz * first_sample * np.arange(1, harmonics + 1))
    return SineFit(local * turn, _std(x - c @ basis.T, frequency_hz / sample_rate_hz), c[:, 0])


@lru_cache(maxsize=32)
def _solver(count: int, cycles_per_sample: float, harmonics: int) -> tuple[Array, Array]:
    """The columns of the fit (samples, columns) and their pseudo-inverse."""
    n = np.arange(count)
    angle = 2 * np.pi * cycles_per_sample * n[:, None] * np.arange(1, harmonics + 1)
    basis = np.empty((count, 2 + 2 * harmonics))
    basis[:, 0] = 1.0
    basis[:, 1] = (n - (count - 1) / 2) / count
    basis[:, 2::2] = np.cos(angle)
    basis[:, 3::2] = np.sin(angle)
    return basis, np.asarray(np.linalg.pinv(basis), dtype=np.float64)


def _std(rest: Array, cycles_per_sample: float) -> Array:
    """Standard deviation of each part of the fundamental, from the residual's lines next to it.

    Noise near the frequency is what counts: white or not, hum at another frequency is left out.
    """
    count = rest.shape[1]
    spacing = 1 / count
    steps = np.concatenate([np.arange(-_LINES, 0), np.arange(1, _LINES + 1)])
    lines = cycles_per_sample + steps * spacing
    lines = lines[(lines > spacing) & (lines < 0.5)]
    if not lines.size:
        return np.asarray(rest.std(axis=1) * np.sqrt(2 / count))
    kernel = np.exp(-2j * np.pi * np.outer(np.arange(count), lines))
    return np.asarray(np.sqrt((np.abs(2 / count * (rest @ kernel)) ** 2).mean(axis=1) / 2))
