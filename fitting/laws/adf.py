"""Anelastic displacement fields: a spring beside fields that relax at a rate each."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from fitting.arrays import Array, Complex
from fitting.errors import OutsideModel
from fitting.laws.base import CoreLaw, quantity


@dataclass(frozen=True)
class AnelasticDisplacementFields(CoreLaw):
    """G* = G0 [1 + sum_k Delta_k ((omega/Omega_k)^2 + i omega/Omega_k) / (1 + (omega/Omega_k)^2)].

    The generalised Maxwell series with tau_k = 1/Omega_k and G_k = G0 Delta_k.
    """

    kind: ClassVar[str] = "adf"
    source: ClassVar[str] = "Lesieutre and Bianchini 1995"

    g0_pa: float = quantity("g0_mpa", to_si=1e6, lower=1e2, upper=1e11, search=(1e4, 1e7))
    delta: tuple[float, ...] = quantity("delta", lower=1e-6, upper=1e6, search=(0.1, 30.0))
    omega_rad_s: tuple[float, ...] = quantity("omega_rad_s", lower=1e-4, upper=1e10, search=(1e1, 1e5))

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.delta) != len(self.omega_rad_s) or not self.delta:
            raise OutsideModel(
                f"core law {self.kind}: {len(self.delta)} delta and {len(self.omega_rad_s)} omega_rad_s, "
                "expected as many of one as of the other, at least one"
            )

    def modulus(self, omega: Array) -> Complex:
        x = self._ratios(omega)
        return np.asarray(self.g0_pa * (1 + np.tensordot(np.array(self.delta) + 0j, _field(x), axes=1)))

    def jacobian(self, omega: Array) -> Complex:
        x = self._ratios(omega)
        field = _field(x)
        scale = (np.array(self.delta) / np.array(self.omega_rad_s)).reshape(-1, *(1,) * np.ndim(omega))
        # (x^2 + i x)/(1 + x^2) = i x/(1 + i x), whose derivative to x is i/(1 + i x)^2.
        to_omega = -scale * 1j * x / (1 + 1j * x) ** 2
        to_g0 = self.modulus(omega)[None] / self.g0_pa
        return np.concatenate([to_g0, self.g0_pa * np.concatenate([field, to_omega])])

    def _ratios(self, omega: Array) -> Array:
        """omega/Omega_k. Shape (fields, ...)."""
        return np.asarray(np.multiply.outer(1 / np.array(self.omega_rad_s), omega))


def _field(x: Array) -> Complex:
    return np.asarray((x**2 + 1j * x) / (1 + x**2))
