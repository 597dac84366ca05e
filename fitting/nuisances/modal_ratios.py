"""Modal damping ratios as unknowns of a fit: each a factor on what is stated."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fitting.arrays import Array
from fitting.nuisances.nuisance import Nuisance
from fitting.stated.number_names import number_name


@dataclass(frozen=True)
class StatedRatios:
    """What a fit knows of them; `each` are all its numbers, in standard deviations.

    `z` has shape (numbers,).
    """

    each: Sequence[Nuisance]

    @cached_property
    def _known(self) -> list[tuple[int, int, float]]:
        """Place of a number, its mode and its standard deviation."""
        return [
            (k, number_name(n.name).item, n.sigma) for k, n in enumerate(self.each) if n.kind == "damping"
        ]

    def factor(self, modes: int, z: Array) -> Array:
        """On the damping of so many modes. Shape (modes,)."""
        found = np.ones(modes)
        for k, mode, sigma in self._known:
            found[mode] = np.exp(sigma * z[k])
        return found

    def by(self, modes: int, z: Array) -> dict[int, tuple[int, float]]:
        """Of each number that is a ratio: its mode, and the derivative of that mode's factor."""
        factor = self.factor(modes, z)
        return {k: (mode, float(sigma * factor[mode])) for k, mode, sigma in self._known}
