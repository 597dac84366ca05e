"""Which stated temperature a form cannot do with, where each is a reading known to an error.

A wrong one bends the form, and its neighbours are moved in its place: how far each was moved says little.
Left without what is stated of one temperature, chi-square comes down by

    r_k^2 / (1 - h_k)

with r_k how far it was moved in standard deviations and h_k its leverage: one degree of freedom, were all
right. The one whose loss gains most is the wrong one, or one that gains about as much: near the ends of a
form two or three do. No fit is made again: about its end a fit is linear.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.inference.refitted import Refitted
from fitting.numerics.chances import chi2_above
from fitting.temperature.one_law import OneLaw
from fitting.temperature.shifts import FARTHEST

_UNLIKELY = 0.02
"""Chance, of any of the temperatures were all right, to gain as much: one right set in fifty is doubted. A
choice."""
_NEAR = 6.0
"""In chi-square, a ratio of twenty: what gains so nearly as much may be the wrong one as well."""
_UNTOLD = 0.02
"""Of its variance: less of a temperature the others do not tell."""
_AT_ITS_LIMIT = 0.99
"""Of how far a temperature may be moved: there a fit is not linear."""


@dataclass(frozen=True)
class Suspect:
    """A stated temperature that may be wrong."""

    member: int
    """From 0."""
    stated_c: float
    by_others_c: float
    """What it is by the form through the others, and by its own readings."""
    gain: float
    """Of chi-square, without what is stated of it."""
    moves: Array
    """By how much the parameters of the one law would be others. Shape (names,)."""
    wider: Array
    """What their covariance has more. Shape (names, names)."""


def suspects_of(one: Refitted, joint: OneLaw) -> list[Suspect]:
    """The stated temperatures of which one is wrong, the likeliest first; none where chance may have it so.

    `one` is the fit whose law is `joint`.
    """
    count, off = len(joint.warmer), joint.off
    if not count or np.abs(off).max() > _AT_ITS_LIMIT * FARTHEST:
        return []
    stop = len(one.residuals) - sum(len(e.ties) for e in one.effects)
    J, kept = one.weighted()
    size = np.linalg.norm(J, axis=0)
    # Of rows in standard deviations: where a misfit is everyone's, temperatures have their part of it.
    misfit = max(1.0, np.nan_to_num(one.chi2_per_dof)) if one.noise_known else 1.0
    back = np.linalg.pinv(J / np.where(size > 0, size, 1.0)) / np.where(size > 0, size, 1.0)[:, None]
    found = []
    names = len(joint.names)
    for k in range(count):
        row = stop - count + k
        left = 1.0 - float(J[row] @ back[:, row])
        if left < _UNTOLD:
            continue
        step = np.zeros(len(kept))
        step[kept] = back[:, row]
        r = float(one.residuals[row]) / np.sqrt(misfit)
        stated = float(joint.shift.temperature_c[k])
        error_k = joint.shift.error_k * np.sqrt(misfit)
        found.append(
            Suspect(
                k,
                stated,
                stated + error_k * r / left,
                r**2 / left,
                step[:names] * r / left,
                np.outer(step[:names], step[:names]) / left,
            )
        )
    found.sort(key=lambda s: -s.gain)
    if not found or not len(found) * chi2_above(found[0].gain, 1) < _UNLIKELY:
        return []
    return [s for s in found if s.gain > found[0].gain - _NEAR]


def widened(covariance: Array, suspects: Sequence[Suspect]) -> Array:
    """Of the one law's parameters where one of some temperatures is wrong, about where the fit has them.

    Shapes (names, names).
    """
    if not suspects:
        return covariance
    gains = np.array([s.gain for s in suspects])
    shares = np.exp((gains - gains.max()) / 2)
    shares /= shares.sum()
    more = sum(p * (s.wider + np.outer(s.moves, s.moves)) for p, s in zip(shares, suspects, strict=True))
    return np.asarray(covariance + more)
