"""What filled rubber loses of its modulus with strain, and gains of loss: Payne's effect as Kraus has it.

What links its filler breaks and heals as the rubber strains: the storage modulus falls, and what breaks and
heals rubs.
"""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex

LEAST = 0.3
"""Of the modulus; softening goes no further."""
HALF = 0.5
"""Kraus' m of most filled rubbers, with which what little is lost goes with the strain itself."""


@dataclass(frozen=True)
class Kraus:
    """G (1 - k (1 + c) r/(1 + c r)) + i b sqrt(G' G'') (1 + c) sqrt(r)/(1 + c r), r = s^2m.

    s is the strain over a reference, at which the share k is lost and b gained. Of his own numbers, G'
    falling from G_0 to G_inf and half of that at r = 1/c, k is (1 - G_inf/G_0) c/(1 + c). Over frequency the
    gain of a real rubber lies between G' and G'' (`docs/decisions/0060-what-softens-rubs.md`).

    Source: Kraus, J. Appl. Polym. Sci., Appl. Polym. Symp. 39 (1984).
    """

    k: float
    saturation: float = 0.0
    """c."""
    loss: float = 0.0
    """b."""
    exponent: float = HALF
    """m."""

    def lost(self, s: Array) -> Array:
        """Share of the modulus, of strains over the reference. Shape of `s`."""
        r = s ** (2 * self.exponent)
        return np.clip(self.k * (1 + self.saturation) * r / (1 + self.saturation * r), -1.0, 1 - LEAST)

    def gained(self, s: Array) -> Array:
        """Loss modulus over sqrt(G' G''). Shape of `s`."""
        r = s ** (2 * self.exponent)
        return np.asarray(self.loss * (1 + self.saturation) * np.sqrt(r) / (1 + self.saturation * r))


def strained(G: Complex, lost: Array | float, gained: Array | float) -> Complex:
    """A modulus less the share `lost`, and `gained` in loss modulus over its own sqrt(G' G'').

    Shape of `G`. Where a law that is tried has no loss, or less, nothing is gained.
    """
    return np.asarray(G * (1 - lost) + 1j * gained * _mean(G))


def strained_along(G: Complex, lost: Array, gained: Array) -> Complex:
    """Derivative of `strained` along those of what is lost and gained. Shape (ways, points)."""
    return np.asarray(1j * gained * _mean(G) - G * lost)


def _mean(G: Complex) -> Array:
    return np.sqrt(np.maximum(G.real * G.imag, 0.0))
