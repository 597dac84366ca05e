"""Where a fit of a law and some effects ended, and what it knows."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex, Mask
from fitting.diagnosis.inference.pace import is_within_reach
from fitting.diagnosis.response.unknowns import Unknowns
from fitting.effects.base import Effect
from fitting.identification.uncertainty import limits_reached
from fitting.laws import CoreLaw

_NO_SLOPE, _DEPENDENT = 1e-300, 1e-6
"""Of columns of a Jacobian: one that is zero; the share below which a direction is made of the others."""
_ROUNDING = 1e-12
"""Of the largest singular value, at least: a direction that nothing fixes has a large variance, not none."""


@dataclass(frozen=True, eq=False)
class Refitted:
    """Where a fit of a law and some effects ended."""

    effects: tuple[Effect, ...]
    law: CoreLaw
    u: Array
    """The stated numbers, in standard deviations, then the effects' unknowns. Shape (unknowns,)."""
    velocity_m_s: Complex
    residuals: Array
    """Whitened; the bare plate's after the sweep's, then the stated numbers', bend's, law's and ties'."""
    jacobian: Array
    """To the log parameters of the law, to the stated numbers and to the free unknowns as they are fitted."""
    data: int
    """How many of `residuals` are readings."""
    free: Array
    """Which of `u` are fitted. Shape of `u`, true or false."""
    stated: int
    """How many of `u` are stated numbers."""
    noise_known: bool
    iterations: int = 0
    evaluations: int = 0
    converged: bool = True
    pace: float = np.inf
    """Chi-square gained by the better one of the last two steps; infinite where there were too few."""
    least_scale: float = 0.0
    """Of the readings' mean square over their stated one, where that is not known (`Evidence`)."""

    @property
    def parameter_count(self) -> int:
        """How many numbers were fitted that nothing was known of: neither stated ones nor the law's bend."""
        return self.jacobian.shape[1] - self.stated - self.law.bend_count

    @property
    def chi2(self) -> float:
        """Sum of squares, priors counted in."""
        return float(self.residuals @ self.residuals)

    @property
    def chi2_per_dof(self) -> float:
        """Chi-square per degree of freedom, of the sweep's data alone."""
        dof = self.data - self.parameter_count
        return float(np.sum(self.residuals[: self.data] ** 2) / dof) if dof > 0 else float("nan")

    def each(self) -> Iterator[tuple[Effect, slice]]:
        """Its effects, and where the unknowns of each are among `u`."""
        yield from zip(self.effects, Unknowns(self.stated, self.effects).slices, strict=True)

    def of(self, effect: Effect) -> Array:
        """The unknowns of one of its effects. Shape (parameters,)."""
        return Unknowns(self.stated, self.effects).of(self.effects.index(effect), self.u)

    def unknown_errors(self, temper: float = 1.0) -> Array:
        """Standard errors of `u` as they are fitted, of `tempered_covariance`. Shape of `u`.

        NaN where a number is not fitted; of the logarithm where it is fitted in that.
        """
        found = np.full(len(self.u), np.nan)
        variance = np.diag(self.tempered_covariance(temper))[len(self.law.names) :]
        found[self.free] = np.sqrt(np.maximum(variance, 0))
        return found

    @property
    def z(self) -> Array:
        """The stated numbers, in standard deviations of their tolerances. Shape (numbers,)."""
        return self.u[: self.stated]

    @cached_property
    def feels(self) -> Array:
        """An orthonormal basis of what its law and unknowns can do to the residuals. Shape (rows, columns).

        Kept: every effect that is looked at beside a fit is told from it.
        """
        return np.asarray(np.linalg.qr(self.jacobian)[0])

    def __getstate__(self) -> dict[str, object]:
        # Another process makes its own.
        return {name: value for name, value in vars(self).items() if name != "feels"}

    @property
    def owed(self) -> float:
        """Chi-square that one more step would gain, were the residuals linear; none at the end of a fit."""
        J = self.jacobian[:, self._moving]
        J = J / np.maximum(np.linalg.norm(J, axis=0), _NO_SLOPE)
        step = np.linalg.lstsq(J, self.residuals, rcond=_DEPENDENT)[0]
        return float(np.sum((J @ step) ** 2))

    def may_reach(self, goal: float) -> bool:
        """Whether a chi-square is within all the steps that a fit may have, at the pace of the last ones."""
        return is_within_reach(self.chi2, goal, self.pace)

    @property
    def covariance(self) -> Array:
        """Of the fitted parameters, scaled by the residual: only upwards where the noise is known.

        A parameter of the law that sits at its upper limit is taken as fixed there; what the data leave open
        is bounded by the ranges that are searched (`CoreLaw.open_widths`). Shape (columns, columns) of
        `jacobian`.
        """
        return self.tempered_covariance(1.0)

    def tempered_covariance(self, temper: float) -> Array:
        """`covariance` where readings say so much less than their noise has it (`predictive.temper`).

        What is known without them, of plate, law and effects, says what it says. Shape of `covariance`.
        """
        J, kept = self.weighted(temper)
        found = np.zeros((len(kept), len(kept)))
        if not kept.any():
            return found
        size = np.linalg.norm(J, axis=0)
        size = np.where(size > 0, size, 1.0)
        _, s, Vt = np.linalg.svd(J / size, full_matrices=False)
        root = Vt.T / np.maximum(s, _ROUNDING * s.max()) / size[:, None]
        found[np.ix_(kept, kept)] = root @ root.T
        return found

    def weighted(self, temper: float = 1.0) -> tuple[Array, Mask]:
        """The Jacobian of what may move, its rows of unit variance, and which columns those are.

        `temper` as `tempered_covariance` takes it.

        Below the rows of `residuals` stand those of the ranges that are searched, one a parameter. Shapes
        (rows, kept) and (columns,).
        """
        chi2 = self.chi2_per_dof
        scale = chi2 if np.isfinite(chi2) else 1.0
        scale = max(1.0 if self.noise_known else self.least_scale, scale)
        kept = self._moving
        J = self.jacobian[:, kept]
        # An unknown noise is the readings'; a misfit is everyone's.
        J[slice(None) if self.noise_known else slice(self.data)] /= np.sqrt(scale)
        J[: self.data] /= np.sqrt(temper)
        widths = self.law.open_widths
        bounds = np.zeros((len(widths), self.jacobian.shape[1]))
        bounds[:, : len(widths)] = np.diag(1 / widths)
        return np.vstack([J, bounds[:, kept]]), kept

    @property
    def _moving(self) -> Mask:
        """Which columns are of what does not sit at a limit of the law; near zero it may still be more."""
        fixed = {name for name, side in limits_reached(self.law).items() if side != "lower"}
        others = self.jacobian.shape[1] - len(self.law.names)
        return np.array([name not in fixed for name in self.law.names] + [True] * others)


def by_chi2(fitted: Refitted) -> float:
    """Order of fits: the one that leaves least comes first."""
    return fitted.chi2
