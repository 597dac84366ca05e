"""A law at one temperature: its frequencies shifted by a factor, its modulus by another.

G*(omega) = b G*_0(a omega)
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from fitting.arrays import Array, Complex
from fitting.laws.base import CoreLaw, Quantity

_H = 1e-4
"""In ln omega: a central difference of a law that is smooth over a decade loses 1e-8."""
_FACTOR = Quantity("", 1.0, 1e-30, 1e30, (1e-6, 1e6))
"""Either shift as a parameter: thirty decades are no limit, six to either side are searched."""


@dataclass(frozen=True)
class ShiftedLaw(CoreLaw):
    """`law` shifted; the logarithms of both factors are its last parameters."""

    law: CoreLaw
    a: float = 1.0
    b: float = 1.0

    @property
    def kind(self) -> str:
        """Of the law that is shifted."""
        return self.law.kind

    @property
    def names(self) -> list[str]:
        """Of the law's own parameters, then of both factors."""
        return [*self.law.names, "shift", "vertical"]

    @property
    def values(self) -> Array:
        """In the order of `names`."""
        return np.append(self.law.values, [self.a, self.b])

    @property
    def limits(self) -> list[Quantity]:
        """In the order of `names`."""
        return [*self.law.limits, _FACTOR, _FACTOR]

    def with_values(self, values: Array) -> Self:
        """The shifted law with other parameters, in the order of `names`. Shape (names,)."""
        return replace(self, law=self.law.with_values(values[:-2]), a=float(values[-2]), b=float(values[-1]))

    def modulus(self, omega: Array) -> Complex:
        """G* in Pa at `omega` in rad/s."""
        return np.asarray(self.b * self.law.modulus(self.a * np.asarray(omega)))

    def jacobian(self, omega: Array) -> Complex:
        """dG*/dp, in the order of `names`. Shape (parameters, frequencies)."""
        at = self.a * np.asarray(omega)
        own = self.b * self.law.jacobian(at)
        up, down = (self.law.modulus(at * np.exp(h)) for h in (_H, -_H))
        by_a = self.b * (up - down) / (2 * _H) / self.a
        return np.concatenate([own, by_a[None], self.law.modulus(at)[None]])
