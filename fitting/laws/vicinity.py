"""What a law that offers itself in the place of another one may know of that one. No law by itself."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array

STORAGE_PA, LOSS = (1e3, 1e10), (1e-3, 5.0)
"""Where another law may begin: a fit that went astray may have made the stated one no material."""


@dataclass(frozen=True)
class Vicinity:
    """A law over the frequencies of a sweep."""

    frequency_hz: Array
    """Ascending, each once. Shape (frequencies,)."""
    storage_and_loss: Callable[[Array], tuple[Array, Array]]
    """The law's G' in Pa and eta at angular frequencies in rad/s."""

    @property
    def ends_hz(self) -> tuple[float, float]:
        """The lowest and the highest frequency."""
        return float(self.frequency_hz[0]), float(self.frequency_hz[-1])

    @property
    def rest_and_rise_pa(self) -> tuple[float, float]:
        """A modulus at rest, somewhat below G' at the lowest frequency, and its rise to the highest."""
        G = np.clip(self.storage_and_loss(2 * np.pi * np.array(self.ends_hz))[0], *STORAGE_PA)
        return float(0.8 * G[0]), float(max(G[1] - G[0], 0.1 * G[0]))

    @property
    def times_s(self) -> list[float]:
        """1/omega at the highest frequency, in the middle and at the lowest."""
        low, high = self.ends_hz
        return [1 / (2 * np.pi * x) for x in (high, np.sqrt(low * high), low)]

    @property
    def sextiles_hz(self) -> list[float]:
        """Six frequencies with as many points between each two of them."""
        return [float(np.exp(q)) for q in np.quantile(np.log(self.frequency_hz), np.linspace(0, 1, 6))]
