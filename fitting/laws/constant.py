"""Constant complex modulus: one storage modulus and one loss factor at all frequencies."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from fitting.arrays import Array, Complex
from fitting.laws.base import CoreLaw, quantity


@dataclass(frozen=True)
class ConstantModulus(CoreLaw):
    """G* = G (1 + i eta)."""

    kind: ClassVar[str] = "constant"
    source: ClassVar[str] = "structural damping"

    g_pa: float = quantity("g_mpa", to_si=1e6, lower=1e2, upper=1e11, search=(1e4, 1e7))
    loss_factor: float = quantity(
        "loss_factor", lower=1e-6, upper=10.0, search=(0.05, 1.5), zero_allowed=True
    )

    def modulus(self, omega: Array) -> Complex:
        return np.full(np.shape(omega), self.g_pa * (1 + 1j * self.loss_factor))

    def jacobian(self, omega: Array) -> Complex:
        one = np.ones(np.shape(omega))
        return np.array([(1 + 1j * self.loss_factor) * one, 1j * self.g_pa * one])
