"""A spring beside a springpot: three numbers for a core without a glassy plateau in the band."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from fitting.arrays import Array, Complex
from fitting.laws.base import CoreLaw, quantity
from fitting.laws.vicinity import Vicinity


@dataclass(frozen=True)
class FractionalKelvinVoigt(CoreLaw):
    """G* = G0 [1 + (i omega tau)^alpha]."""

    kind: ClassVar[str] = "fractional-kelvin-voigt"
    source: ClassVar[str] = "fractional Kelvin-Voigt model, Bagley and Torvik 1983"

    g0_pa: float = quantity("g0_mpa", to_si=1e6, lower=1e2, upper=1e11, search=(1e4, 1e7))
    tau_s: float = quantity("tau_s", lower=1e-12, upper=1e4, search=(1e-6, 1e-1))
    alpha: float = quantity("alpha", lower=0.01, upper=1.0, search=(0.2, 0.9))

    @classmethod
    def alternatives(cls, near: Vicinity) -> list[CoreLaw]:
        """One to try in the place of the stated law: it rises as far, with alpha = 1/2."""
        (rest, rise), shortest = near.rest_and_rise_pa, near.times_s[0]
        return [cls(rest, shortest * (rise / rest / np.cos(np.pi / 4)) ** 2, 0.5)]

    def modulus(self, omega: Array) -> Complex:
        """G* in Pa. Shape of `omega`."""
        return np.asarray(self.g0_pa * (1 + self._springpot(omega)))

    def jacobian(self, omega: Array) -> Complex:
        """Derivatives to G0, tau and alpha. Shape (3, frequencies)."""
        x = self._springpot(omega)
        to_alpha = x * np.log(1j * np.asarray(omega) * self.tau_s)
        return np.array([1 + x, self.g0_pa * self.alpha * x / self.tau_s, self.g0_pa * to_alpha])

    def _springpot(self, omega: Array) -> Complex:
        return np.asarray((1j * np.asarray(omega) * self.tau_s) ** self.alpha)
