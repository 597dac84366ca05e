"""A law as a table has it: G' and eta at listed frequencies, to predict with and to begin a fit from."""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import ClassVar

import numpy as np
from scipy.interpolate import Akima1DInterpolator
from scipy.optimize import least_squares

from fitting.arrays import Array, Complex
from fitting.digits import band
from fitting.errors import OutsideModel
from fitting.laws.base import CoreLaw, fixed
from fitting.laws.fractional_zener import FractionalZener

STORAGE_PA, LOSS = (1e2, 1e11), (0.0, 10.0)
"""What a table may hold."""
_STEEPEST = 1.0
"""d ln G' / d ln f of a dashpot: beyond the ends no solid rises faster, and none falls."""
_POINTS = 25
"""Over the band, of the law that is begun with."""
_LOOSE = 0.02
"""Per unit of a log parameter: what the band says nothing of stays near the table's own size."""


@dataclass(frozen=True)
class Tabulated(CoreLaw):
    """G* = G' (1 + i eta): ln G' and eta through the rows by Akima's cubics over ln f.

    Beyond the rows a power law: ln G' straight with the slope it ends with, eta as it ends. Akima, J. ACM 17
    (1970): smooth, and one row that is off does not ring along the whole table.
    """

    kind: ClassVar[str] = "table"
    source: ClassVar[str] = "the table that is named, Akima's interpolation over ln f"

    frequency_hz: tuple[float, ...] = fixed("frequency_hz")
    """Ascending."""
    storage_modulus_pa: tuple[float, ...] = fixed("storage_modulus_pa")
    loss_factor: tuple[float, ...] = fixed("loss_factor")

    def __post_init__(self) -> None:
        f = self.frequency_hz
        if len(f) < 2 or not f[0] > 0 or any(not a < b for a, b in pairwise(f)) or not np.isfinite(f[-1]):
            raise OutsideModel(
                f"core law table: {len(f)} frequency_hz, expected two or more above 0, ascending"
            )
        if not len(f) == len(self.storage_modulus_pa) == len(self.loss_factor):
            raise OutsideModel(
                f"core law table: {len(f)} frequency_hz, {len(self.storage_modulus_pa)} storage_modulus_pa "
                f"and {len(self.loss_factor)} loss_factor, expected as many of each"
            )
        for name, (low, high) in (("storage_modulus_pa", STORAGE_PA), ("loss_factor", LOSS)):
            for at, value in zip(f, getattr(self, name), strict=True):
                if not low <= value <= high:
                    raise OutsideModel(
                        f"core law table: {name} = {value:g} at {at:g} Hz, expected {low:g} to {high:g}"
                    )

    def modulus(self, omega: Array) -> Complex:
        """G* in Pa at `omega` in rad/s, shape of `omega`. Raises `OutsideModel` at 0 and below."""
        omega = np.asarray(omega, dtype=float)
        if np.any(omega <= 0):
            raise OutsideModel(
                f"core law table asked at {float(np.min(omega)) / (2 * np.pi):.4g} Hz, expected above 0"
            )
        x = np.log(omega / (2 * np.pi))
        log_G, eta = self._curves
        low, high = np.log(self.band_hz)
        inside = np.clip(x, low, high)
        slopes = np.clip(log_G(np.array([low, high]), 1), 0, _STEEPEST)
        beyond = np.where(x < low, slopes[0], slopes[1]) * (x - inside)
        return np.asarray(np.exp(log_G(inside) + beyond) * (1 + 1j * eta(inside)))

    def jacobian(self, omega: Array) -> Complex:
        return np.empty((0, *np.shape(omega)), dtype=complex)

    @property
    def band_hz(self) -> tuple[float, float]:
        """The first and the last row's frequency."""
        return self.frequency_hz[0], self.frequency_hz[-1]

    def outside(self, frequency_hz: Array) -> str:
        """As `CoreLaw`: frequencies that no row reaches. Shape (any,)."""
        low, high = self.band_hz
        f = np.asarray(frequency_hz, dtype=float)
        # A band's own edge may round to just outside it.
        off = f[(f < low * (1 - 1e-9)) | (f > high * (1 + 1e-9))]
        if not len(off):
            return ""
        return (
            f"{len(off)} of {len(f)} frequencies ({band(off.min(), off.max())}) lie outside the "
            f"core law's table, {low:.4g} to {high:.4g} Hz: there G' goes on straight in logarithms and eta "
            "as it ends, which no row supports"
        )

    def to_fit(self, frequency_hz: Array) -> CoreLaw:
        """The fractional Zener nearest to the table over the frequencies, shape (any,), as far as rows go."""
        low, high = np.clip([np.min(frequency_hz), np.max(frequency_hz)], *self.band_hz)
        if not low < high:
            low, high = self.band_hz
        omega = 2 * np.pi * np.geomspace(low, high, _POINTS)
        wanted = self.modulus(omega)
        wanted = wanted.real * (1 + 1j * np.maximum(wanted.imag / wanted.real, 1e-4))
        middle = float(np.sqrt(omega[0] * omega[-1]))
        starts = [
            FractionalZener(
                0.8 * float(wanted.real.min()), 8 * float(wanted.real.max()), 1 / (middle * k), alpha
            )
            for k in (1.0, 30.0)
            for alpha in (0.5, 0.9)
        ]
        return min((_nearest(one, omega, wanted) for one in starts), key=lambda found: found[0])[1]

    @cached_property
    def _curves(self) -> tuple[Akima1DInterpolator, Akima1DInterpolator]:
        x = np.log(self.frequency_hz)
        return Akima1DInterpolator(x, np.log(self.storage_modulus_pa)), Akima1DInterpolator(
            x, np.array(self.loss_factor)
        )


def _nearest(start: FractionalZener, omega: Array, wanted: Complex) -> tuple[float, FractionalZener]:
    """By relative differences of G*; and how far off it is."""
    logs = np.log(start.values)
    lower, upper = start.log_limits

    def off(p: Array) -> Array:
        d = start.with_logs(p).modulus(omega) / wanted - 1
        return np.concatenate([d.real, d.imag, _LOOSE * (p - logs)])

    found = least_squares(off, np.clip(logs, lower + 1e-9, upper - 1e-9), bounds=(lower, upper))
    return float(found.cost), start.with_logs(found.x)
