"""What blows of a hammer scatter by: force spectra, noise of both channels, where they land, and bounces."""

from dataclasses import dataclass

import numpy as np

from campaign.draws import log_uniform
from fitting.arrays import Array, Complex
from instrument.impact.mobility import Mobility, of_spectra

_HITS = (3, 5)
_FIRST_ZERO = (1.15, 2.2)
"""Of the pulse's spectrum, over the upper end of the band: there the force is 4 to 20 dB down."""
_FLOOR = (4e-4, 4e-3)
"""Of the velocity of one hit, over the largest line; each number as likely in its logarithm."""
_BELOW_HZ = (20.0, 200.0)
"""Where the velocity's noise begins to rise towards low frequencies."""
_FORCE_FLOOR = (1e-4, 6e-4)
"""Of the force of one hit, over its lowest line."""
_STRENGTH = 0.25
"""From hit to hit, in the logarithm."""
_SQUARELY = 3e-3
"""By which a hit that is not square gives another force than is read, in the logarithm."""
_LANDS_M = 7e-4
"""Beside the point that hits are meant for, and each beside the others."""
_BOUNCES = 0.3
"""Chance that a hit has a second one, which the force's window cuts off."""
_BOUNCE, _LATE_S = (2e-3, 2e-2), (4e-3, 2.5e-2)
"""Its size over the first's, and how much later it comes."""


@dataclass(frozen=True)
class Blows:
    """Hits on one point."""

    pulse_s: float
    """Of half a sine."""
    strength: tuple[float, ...]
    offsets_m: tuple[tuple[float, float], ...]
    """Where each lands beside the point."""
    floor: float
    below_hz: float
    force_floor: float
    bounce: tuple[float, ...]
    late_s: tuple[float, ...]

    def force(self, frequency_hz: Array) -> Array:
        """Size of the pulse's spectrum, one at its lowest. Shape (lines,)."""
        x = frequency_hz * self.pulse_s
        # Half a sine: cos(pi x) / (1 - 4 x^2), which is pi / 4 at x = 1/2.
        near = np.abs(1 - 4 * x**2) < 1e-9
        return np.asarray(
            np.abs(np.where(near, np.pi / 4, np.cos(np.pi * x) / np.where(near, 1.0, 1 - 4 * x**2)))
        )

    def read(self, rng: np.random.Generator, frequency_hz: Array, each: Complex) -> Mobility:
        """H1 of the hits and what they scatter by; `each` is the mobility of each. Shape (hits, lines)."""
        f, hits = frequency_hz, len(self.strength)
        pulse = np.array(self.strength)[:, None] * self.force(f)
        squarely = np.exp(_SQUARELY * rng.standard_normal((hits, 1)))
        again = 1 + np.array(self.bounce)[:, None] * np.exp(-2j * np.pi * np.outer(self.late_s, f))
        X = each * pulse * squarely * again
        rises = np.sqrt(1 + (self.below_hz / f) ** 2)
        X = X + self.floor * float(np.abs(each * pulse).max()) * rises * _circular(rng, X.shape)
        F = pulse + self.force_floor * _circular(rng, X.shape)
        return of_spectra(f, F, X)


def draw_blows(rng: np.random.Generator, highest_hz: float) -> Blows:
    """Of a hand and a tip chosen for a band."""
    hits = int(rng.integers(_HITS[0], _HITS[1] + 1))
    meant = _LANDS_M * rng.standard_normal(2)
    offsets = meant + _LANDS_M * rng.standard_normal((hits, 2))
    bounces = rng.random(hits) < _BOUNCES
    return Blows(
        pulse_s=1.5 / (highest_hz * float(rng.uniform(*_FIRST_ZERO))),
        strength=tuple(np.exp(_STRENGTH * rng.standard_normal(hits)).tolist()),
        offsets_m=tuple((float(x), float(y)) for x, y in offsets),
        floor=log_uniform(rng, *_FLOOR),
        below_hz=float(rng.uniform(*_BELOW_HZ)),
        force_floor=log_uniform(rng, *_FORCE_FLOOR),
        bounce=tuple((bounces * [log_uniform(rng, *_BOUNCE) for _ in range(hits)]).tolist()),
        late_s=tuple(rng.uniform(*_LATE_S, hits).tolist()),
    )


def _circular(rng: np.random.Generator, shape: tuple[int, ...]) -> Complex:
    return np.asarray((rng.standard_normal(shape) + 1j * rng.standard_normal(shape)) / np.sqrt(2))
