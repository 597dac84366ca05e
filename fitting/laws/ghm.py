"""Golla-Hughes-McTavish model: a spring beside a row of damped mini-oscillators."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from fitting.arrays import Array, Complex
from fitting.errors import OutsideModel
from fitting.laws.base import CoreLaw, quantity
from fitting.laws.vicinity import Vicinity


@dataclass(frozen=True)
class GollaHughesMcTavish(CoreLaw):
    """G* = G0 [1 + sum_k alpha_k (s^2 + 2 zeta_k omega_k s) / (s^2 + 2 zeta_k omega_k s + omega_k^2)].

    s = i omega. Positive alpha_k and zeta_k give loss at every frequency; from zeta_k = 1 a term relaxes
    without swinging.
    """

    kind: ClassVar[str] = "ghm"
    source: ClassVar[str] = "Golla and Hughes 1985; McTavish and Hughes 1993"

    g0_pa: float = quantity("g0_mpa", to_si=1e6, lower=1e2, upper=1e11, search=(1e4, 1e7))
    alpha: tuple[float, ...] = quantity("alpha", lower=1e-6, upper=1e6, search=(0.1, 30.0))
    # Beyond 50 a term is a relaxing one to 1e-4, tau = 2 zeta / omega: no data fix zeta and omega apart.
    zeta: tuple[float, ...] = quantity("zeta", lower=0.05, upper=50.0, search=(0.7, 10.0))
    omega_rad_s: tuple[float, ...] = quantity("omega_rad_s", lower=1e-4, upper=1e10, search=(1e2, 1e5))

    def __post_init__(self) -> None:
        super().__post_init__()
        if not len(self.alpha) == len(self.zeta) == len(self.omega_rad_s) or not self.alpha:
            raise OutsideModel(
                f"core law {self.kind}: {len(self.alpha)} alpha, {len(self.zeta)} zeta and "
                f"{len(self.omega_rad_s)} omega_rad_s, expected as many of each, at least one"
            )

    @classmethod
    def alternatives(cls, near: Vicinity) -> list[CoreLaw]:
        rest, rise = near.rest_and_rise_pa
        return [cls(rest, (2 * rise / rest,), (1.0,), (2 / near.times_s[0],))]

    def modulus(self, omega: Array) -> Complex:
        relaxed, _, _ = self._terms(omega)
        return np.asarray(self.g0_pa * (1 + np.tensordot(np.array(self.alpha) + 0j, relaxed, axes=1)))

    def jacobian(self, omega: Array) -> Complex:
        relaxed, s, D = self._terms(omega)
        a, z, w = (_column(p, s) for p in (self.alpha, self.zeta, self.omega_rad_s))
        to_g0 = self.modulus(omega)[None] / self.g0_pa
        # With N = s^2 + 2 zeta w s and D = N + w^2: d(N/D) = (w^2 dN - 2 w N dw) / D^2.
        to_zeta = a * 2 * w**3 * s / D**2
        to_omega = -2 * a * w * s * (s + z * w) / D**2
        return np.concatenate([to_g0, self.g0_pa * np.concatenate([relaxed, to_zeta, to_omega])])

    def objections(self) -> list[str]:
        # Alone, a term is lowest at omega^2 = omega_k^2 (1 - 2 zeta), and below zero there for zeta < 1/2.
        z, w = np.array(self.zeta), np.array(self.omega_rad_s)
        dips = w[z < 0.5] * np.sqrt(1 - 2 * z[z < 0.5])
        storage = self.modulus(dips).real
        if not np.any(storage <= 0):
            return []
        worst = int(np.argmin(storage))
        return [
            f"the storage modulus is {storage[worst] / 1e6:.3g} MPa at {dips[worst] / (2 * np.pi):.4g} Hz: "
            "such a core has no stiffness there, zeta below 0.5 needs a smaller alpha"
        ]

    def _terms(self, omega: Array) -> tuple[Complex, Complex, Complex]:
        """N/D of every term, s, and D. Shapes (terms, ...), (...), (terms, ...)."""
        s = 1j * np.asarray(omega, dtype=float)
        z, w = _column(self.zeta, s), _column(self.omega_rad_s, s)
        N = s**2 + 2 * z * w * s
        D = N + w**2
        return N / D, s, D


def _column(values: tuple[float, ...], like: Complex) -> Array:
    return np.array(values).reshape(-1, *(1,) * like.ndim)
