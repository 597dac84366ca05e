"""Data a candidate is judged by: the sweep, whitened, and the bare plate's frequencies beside it."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex, Mask
from fitting.data.noise import Noise
from fitting.data.readings import Readings
from fitting.diagnosis.inference.whitening import SHARE, Whitening
from fitting.effects.base import Effect
from fitting.nuisances.nuisances import Nuisances
from fitting.nuisances.sums import KeptOfLatest
from fitting.stated.layers import Face
from fitting.sweep import Sweep

_BLUNT = 0.03
"""Of a reading, as its noise: ten times what a sweep has, so that far starts still feel the bottom."""
_NO_ERROR = 0.02
"""Of the noise: directions of the model's error that are smaller are left out of a mean. A choice."""
_STEP = 1e-3
"""Of a stated number, in standard deviations, to either side: for derivatives. A choice."""


@dataclass(frozen=True)
class BareModes:
    """The hammer test beside the plate model: shifts of ln f, and what moves them."""

    shift: Array
    """ln(measured / model)."""
    softness: Array
    """Fall for a root that yields, one for mode 1."""
    scatter: Array
    """Standard deviation of `shift`."""
    lowering_per_density: Array
    """Fall for unit density of air."""
    clamp: float
    """Prior standard deviation of the root's yielding in the hammer test."""
    stiffness: Complex
    """phi^T P_p phi for the parts of K_0, on the model's modes. Shape (modes, parts)."""
    inertia: Array
    """The same for M. Shape (modes, parts)."""
    sensor: Array
    """What the sensor adds to phi^T M phi. Shape (modes,)."""
    by_line: Array
    """Fall of ln f for a metre of free length more: this test has a clamp line of its own. Shape (modes,)."""
    line_m: float
    """Standard deviation of where it is."""
    substrate: Face
    """The substrate as its file states it."""
    _kept: KeptOfLatest = field(default_factory=KeptOfLatest, init=False, compare=False, repr=False)

    @cached_property
    def _whitening(self) -> Whitening:
        columns = [self.clamp * self.softness, self.line_m * self.by_line]
        return Whitening.of((np.array(columns) / self.scatter).T)

    def whitened(self, expected: Array) -> Array:
        """(measured - expected shift) in standard deviations, the clamp marginalised. Shape (modes,)."""
        return self.whitened_change(self.shift - expected)

    def whitened_change(self, shift: Array) -> Array:
        """Shifts of ln f in standard deviations, the clamp marginalised. Shape (modes,) or (modes, any)."""
        return self._whitening((shift.T / self.scatter).T)

    def stated_shift(self, nuisances: Nuisances, z: Array) -> Array:
        """Shift of ln f as the stated numbers move, by Rayleigh's quotient. Shape (modes,)."""
        if not len(z):
            return np.zeros(len(self.shift))
        k, m = self._energies(nuisances.bare_coefficients(z))
        k_0, m_0 = self._energies(nuisances.bare_coefficients(0 * z))
        return np.asarray(np.log((k / m) / (k_0 / m_0)) / 2)

    @staticmethod
    def nearest(z: Array) -> Array:
        """Where slopes are taken: they change little from one tolerance to the next. Shape of `z`."""
        return np.round(z)

    def by_stated(self, nuisances: Nuisances, z: Array) -> Array:
        """Derivatives of `stated_shift` to z, at the `nearest` whole numbers. Shape (count, modes).

        Kept: all fits of one problem come by the same few places.
        """
        z = self.nearest(z)
        return self._kept.of(nuisances).get("slopes", z, lambda: self._slopes_at(nuisances, z))

    def _slopes_at(self, nuisances: Nuisances, z: Array) -> Array:
        found = np.zeros((len(z), len(self.shift)))
        for k in nuisances.of_bare_plate:
            up, down = z.copy(), z.copy()
            up[k], down[k] = z[k] + _STEP, z[k] - _STEP
            found[k] = (self.stated_shift(nuisances, up) - self.stated_shift(nuisances, down)) / (2 * _STEP)
        return found

    def _energies(self, c: tuple[Array | Complex, Array]) -> tuple[Array, Array]:
        return np.asarray((self.stiffness @ c[0]).real), self.inertia @ c[1] + self.sensor


@dataclass(frozen=True)
class Evidence:
    """The readings, what each is worth, and the model's own error."""

    readings: Readings
    sigma_m_s: Array
    """Noise and the white part of the model's error, weights counted in. Shape (points,)."""
    noise_m_s: Array
    B: Array
    """Model error over sigma, one column a nuisance. Shape (data, nuisances)."""
    scale_known: bool
    """Whether chi-square means anything."""
    bare: BareModes | None = None
    least_scale: float = 0.0
    """Of the readings' mean square over that of `sigma_m_s`, where the scale is not known: few readings that
    happen to be met well are not known so well."""
    whitening: Whitening = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "whitening", Whitening.of(self.B))

    @classmethod
    def of(
        cls, sweep: Sweep, noise: Noise, nuisances: Complex, v: Complex, bare: BareModes | None
    ) -> "Evidence":
        """`nuisances` are changes of the prediction `v`, one a row. Shape (any, points)."""
        weight = sweep.relative_weight
        if noise.is_known:
            sigma = np.hypot(noise.std_m_s, SHARE * np.abs(v)) / weight
        else:
            sigma = np.abs(sweep.response_m_s) / weight
            nuisances = 0 * nuisances
        readings = Readings(sweep.response_m_s)
        plain = cls(readings, sigma, noise.std_m_s, np.zeros((1, 1)), noise.is_known, bare)
        return replace(plain, B=plain.over_sigma(v, nuisances).T)

    @property
    def measured_m_s(self) -> Complex | Array:
        """The readings: phasors, or amplitudes where no phase is known. Shape (points,)."""
        return self.readings.measured_m_s

    @property
    def has_phase(self) -> bool:
        """Whether readings are phasors."""
        return self.readings.has_phase

    @property
    def count(self) -> int:
        """Real numbers measured, the bare plate's not counted."""
        return self.readings.count

    def residuals(self, v: Complex) -> Array:
        """Whitened (predicted - measured). Shape (count,)."""
        return self.whitening(self.readings.data(self.readings.off(v) / self.sigma_m_s))

    def jacobian(self, v: Complex, dv: Complex) -> Array:
        """Derivatives of `residuals`. Shape (count, parameters)."""
        return self.whitening(self.over_sigma(v, dv).T)

    def over_sigma(self, v: Complex, dv: Complex) -> Array:
        """Changes of the prediction in standard deviations, parts side by side. Shape (..., count)."""
        # Times what is one over it: complex numbers divide slowly, and parts by themselves do not.
        return self.readings.data(self.readings.changes(v, dv)) * self._per_sigma

    @cached_property
    def _per_sigma(self) -> Array:
        """Of every datum. Shape (count,)."""
        return self.readings.each(1 / self.sigma_m_s)

    def bare_moves(self, effect: Effect, u: Array) -> Array:
        """Change of the bare plate's whitened residuals as an effect comes in. Shape (modes,), or none."""
        if self.bare is None:
            return np.empty(0)
        shift = effect.bare_shift(self.bare, u)
        return self.bare.whitened(np.zeros(len(shift))) - self.bare.whitened(shift)

    def blunt(self) -> "Evidence":
        """The same readings taken for a few percent: wide valleys for a first descent."""
        sigma = np.maximum(self.sigma_m_s, _BLUNT * np.abs(self.measured_m_s))
        return replace(self, sigma_m_s=sigma, B=0 * self.B[:, :1])

    def scaled(self, factor: float) -> "Evidence":
        """The same readings, noise and the white part of the model's error times a factor."""
        return replace(
            self,
            sigma_m_s=self.sigma_m_s * factor,
            noise_m_s=self.noise_m_s * factor,
            B=self.B / factor,
        )

    def with_noise(self, noise_m_s: Array) -> "Evidence":
        """The same readings with another noise, the model's error as it is. Shape (points,)."""
        white = SHARE * np.abs(self.measured_m_s)
        times = np.hypot(noise_m_s, white) / np.hypot(self.noise_m_s, white)
        B = self.B / self.readings.each(times)[:, None]
        return replace(self, sigma_m_s=self.sigma_m_s * times, noise_m_s=noise_m_s, B=B)

    def with_errors_of(self, others: Sequence["Evidence"]) -> "Evidence":
        """The same readings; its model error has the mean covariance of all `others`, itself among them."""
        each = [one.B * self.readings.each(one.sigma_m_s / self.sigma_m_s)[:, None] for one in others]
        U, size, _ = np.linalg.svd(np.hstack(each) / np.sqrt(len(others)), full_matrices=False)
        kept = size > _NO_ERROR
        return replace(self, B=U[:, kept] * size[kept])

    def parts(self, points: Mask) -> Mask:
        """Which data belong to some points. Shape (data,), from (points,)."""
        return self.readings.which(points)

    def take(self, points: Mask) -> "Evidence":
        """Some of the points; the bare plate stays. `points` of shape (all points,), true or false."""
        return replace(
            self,
            readings=self.readings.take(points),
            sigma_m_s=self.sigma_m_s[points],
            noise_m_s=self.noise_m_s[points],
            B=self.B[self.parts(points)],
        )
