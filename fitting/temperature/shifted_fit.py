"""One law found with its shifts beside a law for each temperature: what each is worth, and their errors."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.depth.quantities import Quantities
from fitting.depth.task import DepthTask
from fitting.diagnosis.inference.refitted import Refitted
from fitting.laws import CoreLaw
from fitting.numerics.chances import chi2_above, f_above
from fitting.temperature.members import Joined
from fitting.temperature.one_law import OneLaw, OwnLaws
from fitting.temperature.shifts import Shift
from fitting.temperature.suspects import Suspect, suspects_of, widened

_TOLD = 0.5
"""Of a temperature: below it the others say nothing of any, and their scatter means nothing."""


@dataclass(frozen=True)
class ShiftedFit:
    """One law shifted, beside a law for each temperature, both with the same plate and the same causes."""

    one: Refitted
    own: Refitted
    joined: Joined
    """What was fitted."""

    @property
    def bands_hz(self) -> list[tuple[float, float]]:
        """Lowest and highest frequency of each sweep."""
        return self.joined.bands_hz

    @property
    def joint(self) -> OneLaw:
        """The law found, with its shifts."""
        assert isinstance(self.one.law, OneLaw)
        return self.one.law

    @property
    def law(self) -> CoreLaw:
        """At the reference temperature."""
        return self.joint.law

    @property
    def shift(self) -> Shift:
        """Its form."""
        return self.joint.shift

    @property
    def parameters(self) -> Array:
        """Parameters of the temperature shift. Shape (parameters,)."""
        return self.joint.parameters

    @cached_property
    def _covariance(self) -> Array:
        n = len(self.joint.names)
        return widened(self.one.covariance[:n, :n], self.suspects)

    @cached_property
    def suspects(self) -> list[Suspect]:
        """Stated temperatures of which one is wrong, the likeliest first; errors hold for any of them."""
        return suspects_of(self.one, self.joint)

    def _of(self, wanted: slice) -> Array:
        return self._covariance[wanted, wanted]

    @property
    def _own(self) -> int:
        return len(self.law.names) - self.law.bend_count

    @property
    def _shifts(self) -> slice:
        return slice(self._own, self._own + len(self.joint.theta))

    @property
    def parameter_errors(self) -> Array:
        """Shape (parameters,)."""
        size = self.shift.by_log(self.parameters)
        return np.asarray(np.abs(size) * np.sqrt(np.diag(self._of(self._shifts))))

    @property
    def sweeps_log_shift(self) -> Array:
        """Ln a_T of every sweep, at the temperature that it has by the fit. Shape (sweeps,)."""
        return self.joint.log_shift

    @property
    def log_shift(self) -> Array:
        """Ln a_T at every stated temperature; free factors are those of the sweeps. Shape (sweeps,)."""
        return self.shift.log_shift(self.parameters)

    @property
    def log_shift_errors(self) -> Array:
        """With what is not known of the temperatures. Shape (sweeps,)."""
        slope = self.shift.slope(self.parameters) * self.shift.by_log(self.parameters)
        return np.hypot(self._errors_by(slope), self._by_temperatures)

    @property
    def sweeps_log_shift_errors(self) -> Array:
        """Of `sweeps_log_shift`, by the parameters alone. Shape (sweeps,)."""
        return self._errors_by(self.joint.shift_slope)

    def _errors_by(self, slope: Array) -> Array:
        return np.sqrt(np.maximum(np.einsum("ki,ij,kj->k", slope, self._of(self._shifts), slope), 0.0))

    @property
    def _by_temperatures(self) -> Array:
        """Of free factors: what they and the reference's would be off. Shape (sweeps,)."""
        shift = self.shift
        if shift.kind != "free" or shift.error_k == 0:
            return np.zeros(len(self.joint.points))
        each, at = np.unique(shift.temperature_c, return_inverse=True)
        if len(each) < 2:
            return np.zeros(len(at))
        by_k = np.gradient(shift.log_shift(self.parameters, each), each)
        reference = by_k[np.argmin(np.abs(each - shift.reference_c))]
        found = shift.error_k * np.hypot(by_k, reference)
        return np.asarray(np.where(each == shift.nearest_c, 0.0, found)[at])

    @property
    def log_vertical(self) -> Array:
        """Ln b_T of every sweep. Shape (sweeps,)."""
        return self._vertical(np.log(np.array(self.joint.b)))

    @property
    def log_vertical_errors(self) -> Array:
        """Shape (sweeps,)."""
        stop = self._shifts.stop
        return self._vertical(np.sqrt(np.diag(self._of(slice(stop, stop + len(self.joint.b))))))

    def _vertical(self, each: Array) -> Array:
        places = [self.joint.vertical_place(k) for k in range(len(self.joint.points))]
        return np.array([0.0 if at is None else each[at] for at in places])

    @property
    def law_covariance(self) -> Array:
        """Of the law's log parameters, its bend's among them. Shape (names, names)."""
        at = self._law_columns
        return self._covariance[np.ix_(at, at)]

    @property
    def _law_columns(self) -> NDArray[np.intp]:
        """Where the law's parameters and its bend stand among those of the one law."""
        v = self._shifts.stop + len(self.joint.b)
        return np.r_[: self._own, v : v + self.law.bend_count]

    def quantities(self, frequency_hz: Array) -> Quantities:
        """What intervals may be asked for of the law at the reference temperature. Shape (frequencies,)."""
        response = self.joined.around(self.joint).response(self.one.effects)
        task = DepthTask.of(response, self.joined.evidence, self.one)
        return Quantities(task, frequency_hz, self.law, self._law_columns)

    def own_law(self, sweep: int) -> CoreLaw:
        """Of one temperature by itself, the plate shared with all others."""
        assert isinstance(self.own.law, OwnLaws)
        return self.own.law.laws[sweep]

    @cached_property
    def stated_covariance(self) -> Array:
        """Of the stated numbers, in standard deviations of their tolerances. Shape (numbers, numbers)."""
        n = len(self.one.law.names)
        stated = slice(n, n + self.one.stated)
        return self.one.covariance[stated, stated]

    @property
    def stated_errors(self) -> Array:
        """Of the stated numbers, in standard deviations of their tolerances. Shape (numbers,)."""
        return np.sqrt(np.maximum(np.diag(self.stated_covariance), 0.0))

    @property
    def chi2(self) -> float:
        """Of the one law, priors counted in."""
        return self.one.chi2

    @property
    def chi2_own(self) -> float:
        """Of a law for each temperature."""
        return self.own.chi2

    @cached_property
    def own_chi2_per_dof(self) -> float:
        """Of a law for each temperature: of readings alone, over those that are left for them to miss.

        Where a temperature has fewer readings than its law has parameters, these do not all count.
        """
        read = self.own.residuals[: self.own.data]
        return float(read @ read / self._own_degrees)

    @cached_property
    def _own_degrees(self) -> float:
        """Of freedom that a law for each temperature leaves."""
        left = self.own.data - min(float(self.own.parameter_count), _effective(self.own))
        return max(left, 1.0)

    @cached_property
    def degrees(self) -> float:
        """How many effective parameters fewer one law has, those with priors by what the data ask of them.

        Temperatures are readings as good as others, of a thermometer.
        """
        return max(1.0, _effective(self.own) - _effective(self.one) + self.thermometers)

    @property
    def thermometers(self) -> float:
        """How many of the stated temperatures are told by the others and the law."""
        count = len(self.joint.warmer)
        if not count:
            return 0.0
        stop = len(self.one.residuals) - sum(len(e.ties) for e in self.one.effects)
        return count - _shares(self.one)[stop - count : stop].sum()

    @property
    def temperature_chance(self) -> float:
        """Chance that temperatures are so far off by what is said of their error; 1 where they are exact."""
        if self.thermometers < _TOLD:
            return 1.0
        return float(chi2_above(float(self.joint.off @ self.joint.off), self.thermometers))

    @property
    def noise_known(self) -> bool:
        """Whether chi-square means anything."""
        return self.one.noise_known

    @property
    def converged(self) -> bool:
        """Whether the fit of one law came to its end."""
        return self.one.converged

    @property
    def p_value(self) -> float:
        """Chance that one law fits so much worse than many, were there one.

        What the many leave beyond noise is taken for noise: it is not the one law's fault. Where the noise is
        unknown all of it is, by Fisher's F.
        """
        more = max(self.chi2 - self.chi2_own, 0.0)
        if not self.noise_known:
            share = more / self.degrees / self.own_chi2_per_dof
            return float(f_above(share, self.degrees, self._own_degrees))
        return float(chi2_above(more / max(1.0, self.own_chi2_per_dof), self.degrees))


def _effective(fit: Refitted) -> float:
    """Trace of the hat matrix of the readings."""
    return float(_shares(fit)[: fit.data].sum())


def _shares(fit: Refitted) -> Array:
    """The diagonal of the hat matrix. Shape (rows,)."""
    J = fit.jacobian
    size = np.linalg.norm(J, axis=0)
    U, s, _ = np.linalg.svd(J / np.where(size > 0, size, 1.0), full_matrices=False)
    return np.asarray(np.sum(U[:, s > 1e-12 * s.max()] ** 2, axis=1))
