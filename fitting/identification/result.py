"""The one result of an identification, whichever method found it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.data.noise import Noise
from fitting.digits import written_out
from fitting.identification.adjusted import Adjusted
from fitting.identification.as_stated import is_unlikely, pulled_together
from fitting.identification.doubt import ASTRAY, BIASED, Doubt
from fitting.identification.fit import Fit
from fitting.identification.known_curve import KnownCurve, known_curve
from fitting.identification.law_remarks import beyond_cores, gain_of_energy, hardly_known
from fitting.identification.quoted import REFERENCE_FREQUENCIES_HZ
from fitting.identification.uncertainty import Uncertainty, uncertainty_of
from fitting.identification.validation import Validation, rms
from fitting.laws import CoreLaw
from fitting.laws.bent_law import BentLaw
from fitting.sweep import Sweep

_BAND_POINTS = 41
"""Of the law that is given with its band: dense enough to draw it and to carry it on."""
_STRONG_CORRELATION = 0.99
"""Beyond, a pair's own errors are seven times what one has with the other known: a warning."""
LOST_PERCENT = 30.0
"""Difference in amplitude beyond which a fit has not followed the data at all."""
_PULLED = 3.0
"""Tolerances that a stated number may be moved without a word."""
_NAMED = 3
"""Numbers that are named of those moved together: a choice."""
_MISFIT = 1.5
"""Chi-square per degree of freedom that noise alone does not explain."""


@dataclass(frozen=True)
class LawBand:
    """G' and eta over the measured range with their standard errors. Shape (frequencies,) each."""

    frequency_hz: Array
    storage_modulus_pa: Array
    loss_factor: Array
    storage_modulus_standard_error_pa: Array
    loss_factor_standard_error: Array
    known: KnownCurve | None = None
    """The same of the curve as a whole, where that is known."""

    def values_at(self, frequency_hz: Array) -> Array:
        """Ln G' at frequencies inside, then eta. Shape (2 frequencies,)."""
        x, at = np.log(self.frequency_hz), np.log(frequency_hz)
        storage = np.interp(at, x, np.log(self.storage_modulus_pa))
        return np.concatenate([storage, np.interp(at, x, self.loss_factor)])


@dataclass(frozen=True)
class Identification:
    """What was found, how well it is known, and what the data do not say."""

    method: str
    law: CoreLaw
    fit: Fit
    uncertainty: Uncertainty
    noise: Noise
    measured_m_s: Array
    """Amplitudes, over measured base acceleration times the commanded one. Shape (points,)."""
    predicted_m_s: Array
    difference_percent: Array
    validation: Validation
    band: LawBand
    warnings: tuple[str, ...]
    """A `Doubt` among them says that the law may be wrong by more than is known of it."""

    @property
    def standard_errors(self) -> dict[str, float]:
        """In the parameters' own units; NaN for one at its limit."""
        size = self.uncertainty.standard_errors * self.law.values
        fixed = self.uncertainty.at_bound
        return {
            n: float("nan") if n in fixed else float(s) for n, s in zip(self.law.names, size, strict=True)
        }

    @property
    def chi2_means_something(self) -> bool:
        """Whether residuals are in units of a known noise."""
        return self.noise.source not in ("unknown", "misfit") and self.method == "direct"

    @property
    def rms_percent(self) -> float:
        """Of the differences in amplitude."""
        return rms(self.difference_percent)

    @property
    def max_percent(self) -> float:
        """Largest difference in amplitude."""
        return float(np.max(np.abs(self.difference_percent)))


def differences_percent(sweep: Sweep, velocity_m_s: NDArray[np.complex128]) -> Array:
    """100 (|predicted| - |measured|) / |measured|. Shape (points,)."""
    measured = np.abs(sweep.response_m_s)
    return np.asarray(100 * (np.abs(velocity_m_s) - measured) / measured)


def summarise(
    method: str,
    sweep: Sweep,
    noise: Noise,
    fit: Fit,
    validation: Validation,
    further_warnings: tuple[str, ...] = (),
) -> Identification:
    """Put the facts of a fit together."""
    known = noise.is_known and method == "direct"
    whole = uncertainty_of(fit, noise_is_known=known)
    uncertainty = whole.of_first(len(fit.law.plain.names))
    band = replace(law_band(sweep, fit.law, whole), known=_known(sweep, fit, whole))
    return Identification(
        method=method,
        law=fit.law.plain,
        fit=fit,
        uncertainty=uncertainty,
        noise=noise,
        measured_m_s=np.abs(sweep.response_m_s),
        predicted_m_s=np.abs(fit.velocity_m_s),
        difference_percent=differences_percent(sweep, fit.velocity_m_s),
        validation=validation,
        band=band,
        warnings=(
            *gain_of_energy(band.frequency_hz, band.loss_factor),
            *beyond_cores(band.storage_modulus_pa),
            *_hardly_known(band),
            *_warnings(sweep, fit, uncertainty, known),
            *further_warnings,
        ),
    )


def law_band(sweep: Sweep, law: CoreLaw, uncertainty: Uncertainty, points: int = _BAND_POINTS) -> LawBand:
    """The law over the measured range, logarithmic in frequency, with the reference frequencies inside it."""
    low, high = sweep_range(sweep)
    inside = [f for f in REFERENCE_FREQUENCIES_HZ if low <= f <= high]
    f = np.unique(np.concatenate([np.geomspace(low, high, points), inside]))
    omega = 2 * np.pi * f
    G, eta = law.storage_and_loss(omega)
    return LawBand(f, G, eta, *uncertainty.law_band(law, omega))


def _known(sweep: Sweep, fit: Fit, whole: Uncertainty) -> KnownCurve | None:
    if fit.posterior is None or np.isnan(whole.covariance).any():
        return known_curve(fit.law, whole.covariance, (), *sweep_range(sweep))
    return known_curve(fit.law, fit.posterior, [one.name for one in fit.adjusted], *sweep_range(sweep))


def sweep_range(sweep: Sweep) -> tuple[float, float]:
    """The first and the last frequency measured, Hz."""
    return float(sweep.frequency_hz.min()), float(sweep.frequency_hz.max())


def _warnings(sweep: Sweep, fit: Fit, uncertainty: Uncertainty, noise_is_known: bool) -> list[str]:
    law, said = fit.law.plain, list[str]()
    data = len(sweep) * (2 if sweep.has_phase else 1)
    if data <= len(law.names):
        said.append(
            f"too few points: {len(sweep)} ({data} numbers) for {len(law.names)} parameters, more than "
            "that are needed; the parameters found are one choice of many and carry no standard error"
        )
    if not fit.converged:
        said.append(f"not converged after {fit.iterations} iterations: take the values as provisional")
    if fit.criterion_met is False:
        said.append("the 5 % criterion is not met: some point differs by more than 5 %")
    off = rms(differences_percent(sweep, fit.velocity_m_s))
    if off > LOST_PERCENT:
        said.append(Doubt(f"{ASTRAY} data (rms {written_out(off, 3)} %): check units, level and pickup"))
    count = len(fit.adjusted)
    said.extend(
        moved_too_far(fit.adjusted, fit.posterior[-count:, -count:] if fit.posterior is not None else None)
    )
    if noise_is_known and uncertainty.chi2_per_dof > _MISFIT:
        said.append(
            Doubt(
                f"chi-square per degree of freedom is {written_out(uncertainty.chi2_per_dof, 3)} where noise "
                f"and model error leave 1: the model lacks something, and {BIASED}"
            )
        )
    return [*said, *_law_warnings(fit.law, uncertainty)]


def moved_too_far(numbers: Sequence[Adjusted], covariance: Array | None) -> list[Doubt]:
    """That stated numbers were moved further than they may be, one by one or together; seldom anything.

    `covariance` of them in tolerances, shape (numbers, numbers); None where it is not known.
    """
    if said := pulled_too_far(numbers):
        why = "they are stated wrongly or the model lacks something"
        return [Doubt(f"{said}: {why}, and {BIASED}; see 'viscorig diagnose'")]
    if covariance is None or not numbers:
        return []
    z = np.array([one.pull for one in numbers])
    chi_square, directions = pulled_together(z, covariance)
    if not is_unlikely(chi_square, directions):
        return []
    most = sorted(numbers, key=lambda one: -abs(one.pull))[:_NAMED]
    named = ", ".join(f"{one.name} by {one.pull:+.1f}" for one in most)
    return [
        Doubt(
            "stated numbers had to be moved together further than data as these move them (chi-square "
            f"{chi_square:.3g} of {directions} directions; most {named} standard deviations): one of them is "
            f"stated wrongly or the model lacks something, and {BIASED}; see 'viscorig diagnose'"
        )
    ]


def pulled_too_far(numbers: Sequence[Adjusted]) -> str:
    """Which of them were moved further by themselves than they may be; empty for none."""
    pulled = sorted((one for one in numbers if abs(one.pull) > _PULLED), key=lambda one: -abs(one.pull))
    named = ", ".join(f"{one.name} by {one.pull:+.1f}" for one in pulled)
    return named and (
        f"stated numbers had to be moved further than their tolerances say ({named} standard "
        f"deviations, limit {_PULLED:g})"
    )


def _law_warnings(fitted: CoreLaw, uncertainty: Uncertainty) -> list[str]:
    """What the data say of the parameters one by one, the bends of the law together."""
    law = fitted.plain
    said = [
        f"{name} sits at its {side} bound: the data do not fix it on that side"
        for name, side in uncertainty.at_bound.items()
        if name in law.names
    ]
    if isinstance(fitted, BentLaw) and fitted.places_at_limit(uncertainty.at_bound):
        said.append(
            f"the law bends as far as it may at {fitted.places_at_limit(uncertainty.at_bound)} of "
            f"{len(fitted.knots_hz)} places: its form is not this material's, or something else is amiss"
        )
    said.extend(_looseness_warnings(law, uncertainty))
    said.extend(_correlation_warnings(law, uncertainty))
    return [*said, *law.objections()]


def _hardly_known(band: LawBand) -> list[str]:
    G, eta = band.storage_modulus_pa, band.loss_factor
    return [
        *hardly_known("G'", band.frequency_hz, G, band.storage_modulus_standard_error_pa),
        *hardly_known("the loss factor", band.frequency_hz, eta, band.loss_factor_standard_error),
    ]


def _looseness_warnings(law: CoreLaw, uncertainty: Uncertainty) -> list[str]:
    said = []
    lower, upper = law.log_limits
    logs = np.log(np.maximum(law.values, 1e-300))
    for k, (name, error) in enumerate(zip(law.names, uncertainty.standard_errors, strict=True)):
        if name in uncertainty.at_bound or not error > 0:
            continue
        if error > 1:
            said.append(f"{name} is not fixed by the data: its standard error is larger than itself")
        for side, distance in (("lower", logs[k] - lower[k]), ("upper", upper[k] - logs[k])):
            if distance < 2 * error < 2:
                said.append(f"{name} lies within two standard errors of its {side} bound")
    return said


def _correlation_warnings(law: CoreLaw, uncertainty: Uncertainty) -> list[str]:
    C, names = uncertainty.correlations, law.names
    return [
        f"{names[i]} and {names[j]} are correlated {C[i, j]:+.3f}: the data fix a combination of them, "
        "not each; rely on G'(f) and eta(f) inside the measured band"
        for i in range(len(names))
        for j in range(i + 1, len(names))
        if abs(C[i, j]) > _STRONG_CORRELATION
    ]
