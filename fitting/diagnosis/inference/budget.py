"""Where the uncertainty of a law comes from, source by source, as the GUM lists it.

The fit is a linear map from rows of unit variance to its parameters: the variance of G' or eta is the sum
of what each row passes on. Readings carry noise and the model's own error together; these are told apart by
their share of the readings' covariance.
"""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.inference.begin import Begun
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.whitening import SHARE

NOISE, MODEL, HAMMER = "noise", "model error", "hammer test"
BEND, RANGES = "form of the law", "ranges searched"
_ROUNDING = 1e-12
"""Of the largest singular value: a direction with less of it is fixed by no row."""


@dataclass(frozen=True)
class Budget:
    """Standard uncertainties by source. Arrays have shape (frequencies,)."""

    frequency_hz: Array
    storage_relative: dict[str, Array]
    """Of G', relative."""
    loss_factor: dict[str, Array]
    """Of eta."""

    def total(self, by_source: dict[str, Array]) -> Array:
        """All of them together: sources are independent."""
        return np.asarray(np.sqrt(sum(part**2 for part in by_source.values())))


def budget_of(begun: Begun, frequency_hz: Array) -> Budget:
    """To first order, about where the fit without effects ended. Shape (frequencies,)."""
    none, law = begun.none, begun.none.law
    J, kept = none.weighted()
    size = np.linalg.norm(J, axis=0)
    size = np.where(size > 0, size, 1.0)
    to_fit = np.linalg.pinv(J / size, rcond=_ROUNDING) / size[:, None]
    passed = np.zeros((len(kept), J.shape[0]))
    passed[kept] = to_fit
    omega = 2 * np.pi * frequency_hz
    storage, eta = law.storage_and_loss(omega)
    by = law.jacobian(omega) * law.values[:, None]
    rows = passed[: len(law.names)]
    each = [
        _by_source(begun, slope.T @ rows)
        for slope in (by.real / storage, (by.imag - eta * by.real) / storage)
    ]
    return Budget(frequency_hz, *each)


def _by_source(begun: Begun, passed: Array) -> dict[str, Array]:
    """`passed` is what each row adds to a quantity. Shape (frequencies, rows)."""
    none = begun.none
    data, stated, bend = none.data, none.stated, none.law.bend_count
    bare = len(none.residuals) - data - stated - bend - len(none.law.breaches())
    found = _of_readings(begun.evidence, passed[:, :data])
    start = data
    if bare:
        found[HAMMER] = _size(passed[:, start : start + bare])
    start += bare
    for k, nuisance in enumerate(begun.problem.nuisances.each[:stated]):
        found[nuisance.name] = np.abs(passed[:, start + k])
    start += stated
    if bend:
        found[BEND] = _size(passed[:, start : start + bend])
    found[RANGES] = _size(passed[:, start + bend :])
    return found


def _of_readings(evidence: Evidence, passed: Array) -> dict[str, Array]:
    """Noise is what the readings' own scatter passes on; the rest of their variance is the model's error."""
    share = np.ones(len(evidence.sigma_m_s))
    if evidence.scale_known:
        white = evidence.sigma_m_s**2
        model = np.maximum(white - _noise_variance(evidence), 0.0)
        share = 1 - model / white
    share = np.concatenate([share] * (passed.shape[1] // len(share)))
    # Whitening is symmetric: what reaches a row from each reading.
    through = evidence.whitening(passed.T).T
    noise = np.sum(through**2 * share, axis=1)
    return {NOISE: np.sqrt(noise), MODEL: np.sqrt(np.maximum(np.sum(passed**2, axis=1) - noise, 0.0))}


def _noise_variance(evidence: Evidence) -> Array:
    """Of the readings, with the weights that sigma has."""
    size = np.abs(evidence.measured_m_s)
    together = evidence.noise_m_s**2 + (SHARE * size) ** 2
    return np.asarray(evidence.sigma_m_s**2 * evidence.noise_m_s**2 / together)


def _size(passed: Array) -> Array:
    return np.asarray(np.sqrt(np.sum(passed**2, axis=1)))
