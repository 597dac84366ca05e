"""Fractional Zener solid, the paper's law: Eq. (1)."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from fitting.arrays import Array, Complex
from fitting.laws.base import CoreLaw, quantity


@dataclass(frozen=True)
class FractionalZener(CoreLaw):
    """G* = (G0 + Ginf (i omega tau)^alpha) / (1 + (i omega tau)^alpha).

    G0 is the relaxed and Ginf the unrelaxed modulus; 0 < alpha <= 1 and Ginf >= G0 keep it passive.
    """

    kind: ClassVar[str] = "fractional-zener"
    source: ClassVar[str] = "the paper's Eq. (1)"

    g0_pa: float = quantity("g0_mpa", to_si=1e6, lower=1e2, upper=1e10, search=(1e4, 1e7))
    ginf_pa: float = quantity("ginf_mpa", to_si=1e6, lower=1e3, upper=1e11, search=(1e6, 1e8))
    tau_s: float = quantity("tau_s", lower=1e-10, upper=1e3, search=(1e-6, 1e-2))
    alpha: float = quantity("alpha", lower=0.01, upper=1.0, search=(0.3, 1.0))

    def modulus(self, omega: Array) -> Complex:
        z = (1j * omega * self.tau_s) ** self.alpha
        return (self.g0_pa + self.ginf_pa * z) / (1 + z)

    def moduli(self, logs: Array, omega: Array) -> Complex:
        g0, ginf, tau, alpha = np.exp(np.clip(logs, *self.log_limits)).T[:, :, None]
        z = np.exp(alpha * (np.log(omega * tau) + 0.5j * np.pi))
        return np.asarray((g0 + ginf * z) / (1 + z))

    def jacobian(self, omega: Array) -> Complex:
        z = (1j * omega * self.tau_s) ** self.alpha
        dG_dz = (self.ginf_pa - self.g0_pa) / (1 + z) ** 2
        return np.array(
            [
                1 / (1 + z),
                z / (1 + z),
                dG_dz * self.alpha * z / self.tau_s,
                dG_dz * np.log(1j * omega * self.tau_s) * z,
            ]
        )

    def objections(self) -> list[str]:
        if self.ginf_pa >= self.g0_pa:
            return []
        return [
            f"ginf_mpa = {self.ginf_pa / 1e6:g} is below g0_mpa = {self.g0_pa / 1e6:g}: "
            "such a core would give energy back"
        ]
