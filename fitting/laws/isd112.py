"""3M ISD-112 as the paper prints it: Eq. (19), with no free parameter."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from fitting.arrays import Array, Complex
from fitting.errors import OutsideModel
from fitting.laws.base import CoreLaw

LOWEST_HZ = 1.0
"""Eq. (19b) turns negative below 0.27 Hz and is a fit to data from hertz upwards."""


@dataclass(frozen=True)
class Isd112(CoreLaw):
    """G' = 2.783 - 1.023/(0.394 + 0.0003736 f) in MPa, eta by Eq. (19b)."""

    kind: ClassVar[str] = "isd112"
    source: ClassVar[str] = "the paper's Eq. (19)"

    def modulus(self, omega: Array) -> Complex:
        """G* in Pa. Shape of `omega`. Raises `OutsideModel` below `LOWEST_HZ`."""
        f = np.asarray(omega, dtype=float) / (2 * np.pi)
        if np.any(f < LOWEST_HZ):
            raise OutsideModel(
                f"core law isd112 asked at {float(np.min(f)):.4g} Hz, expected {LOWEST_HZ:g} Hz or more"
            )
        G = 2.783 - 1.023 / (0.394 + 0.0003736 * f)
        s = 0.005 + 0.0006134 * f
        eta = 1.683 + 0.001468 / s - 0.5274 / s**0.25
        return 1e6 * G * (1 + 1j * eta)

    def jacobian(self, omega: Array) -> Complex:
        return np.empty((0, *np.shape(omega)), dtype=complex)
