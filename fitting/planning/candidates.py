"""Frequencies that a step may be made at: as dense as the response is curved.

Between poles p of the response, a step's worth changes over a share of the distance |f - p| to the nearest
one: half a bandwidth on a resonance, far more between two.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from fitting.arrays import Array, Complex, Integers
from fitting.diagnosis.problem.plate_poles import PlatePoles

_SHARE = 0.25
"""Of the distance to the nearest pole, between two candidates."""
_NEVER_WIDER = 0.05
"""Largest spacing of candidates, as a share of their frequency."""
_MOST = 400
"""Candidates: where there would be more, all are set further apart. A bound on time."""
_APART = 1.15
"""Ratio of two resonances from which each has a region of its own."""
_WIDE = 0.6
"""Loss factor beyond which a pole is no resonance."""


@dataclass(frozen=True)
class Candidates:
    """Steps that could be made. Shape (candidates,) each, in ascending order of frequency."""

    frequency_hz: Array
    region: Integers
    """Number of the resonance region that each lies in, from 1: its segment once it is measured."""
    dwell_s: Array
    """Length of the reading."""
    seconds: Array
    """Of rig time: settling from scratch, and the dwell."""

    def __len__(self) -> int:
        return len(self.frequency_hz)


def resonances_hz(poles: PlatePoles, low_hz: float, high_hz: float) -> Complex:
    """Poles of the plate in a band and beside it, in Hz, what damps them imaginary. Shape (poles,)."""
    found: list[complex] = []
    # `near` holds the law to first order about the middle of what it is asked for.
    edges = np.geomspace(low_hz, high_hz, 2 + int(np.log2(high_hz / low_hz)))
    for low, high in pairwise(edges.tolist()):
        for p in poles.near(2 * np.pi * low, 2 * np.pi * high) / (2 * np.pi):
            if low / _APART <= p.real <= high * _APART and abs(p.imag) < _WIDE / 2 * p.real:
                found.append(complex(p))
    kept: list[complex] = []
    for p in sorted(found, key=lambda p: p.real):
        # Seen from two sides, a pole is found twice, a little apart.
        if not kept or abs(p - kept[-1]) > 0.02 * abs(p):
            kept.append(p)
    return np.array(kept, dtype=complex)


def candidate_frequencies(poles_hz: Complex, low_hz: float, high_hz: float) -> Array:
    """From `low_hz` to `high_hz`, both of them in it; mHz are not resolved. Shape (candidates,)."""
    spacing = _SHARE
    while True:
        f = [low_hz]
        while f[-1] < high_hz and len(f) <= _MOST:
            near = float(np.abs(f[-1] - poles_hz).min()) if len(poles_hz) else np.inf
            f.append(f[-1] + min(spacing * near, _NEVER_WIDER * f[-1]))
        if len(f) <= _MOST:
            break
        spacing *= 1.5
    f[-1] = high_hz
    if len(f) > 2 and f[-1] - f[-2] < 0.5 * (f[-2] - f[-3]):
        del f[-2]
    return np.unique(np.round(f, 3))


def regions(frequency_hz: Array, poles_hz: Complex) -> Integers:
    """Number of the resonance region of each frequency, from 1, parted midway. Shape (frequencies,)."""
    centres: list[float] = []
    for f in np.sort(poles_hz.real):
        inside = frequency_hz[0] <= f <= frequency_hz[-1]
        if inside and (not centres or f > _APART * centres[-1]):
            centres.append(float(f))
    if not centres:
        return np.ones(len(frequency_hz), dtype=np.intp)
    edges = np.sqrt(np.array(centres[1:]) * np.array(centres[:-1]))
    return np.asarray(1 + np.searchsorted(edges, frequency_hz), dtype=np.intp)
