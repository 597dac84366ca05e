"""How well a fit knows what it found: covariance of the log parameters and what follows from it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.identification.fit import Fit
from fitting.laws import CoreLaw

_AT_BOUND = 1e-5
"""Distance to a limit, in the log parameter, that counts as sitting on it."""
_ROUNDING = 1e-14
"""Of the largest singular value: what is less is only what double precision leaves of nothing."""


@dataclass(frozen=True)
class Uncertainty:
    """First-order uncertainty of a fit."""

    covariance: Array
    """Of the log parameters, noise, model error and tolerances together; zero rows for those at a limit, NaN
    where the data do not suffice."""
    at_bound: dict[str, str]
    """Parameter name to "lower" or "upper"."""
    chi2_per_dof: float
    """Sum of squares of the whitened residuals per degree of freedom; NaN without any."""

    @property
    def standard_errors(self) -> Array:
        """Standard errors of the log parameters. Shape (parameters,)."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def correlations(self) -> Array:
        """Shape (parameters, parameters); NaN for parameters at a limit."""
        size = self.standard_errors
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.asarray(self.covariance / np.outer(size, size))

    def law_band(self, law: CoreLaw, omega: Array) -> tuple[Array, Array]:
        """Standard errors of G' in Pa and of eta at `omega`. Shape of `omega` each."""
        dG = law.jacobian(omega) * law.values[:, None]
        G, eta = law.storage_and_loss(omega)
        d_eta = (dG.imag - eta * dG.real) / G
        return self._propagate(dG.real), self._propagate(d_eta)

    def of_first(self, count: int) -> "Uncertainty":
        """Of the first parameters alone, the others marginalised."""
        return Uncertainty(self.covariance[:count, :count], self.at_bound, self.chi2_per_dof)

    def _propagate(self, gradient: Array) -> Array:
        return np.sqrt(np.maximum(np.einsum("if,ij,jf->f", gradient, self.covariance, gradient), 0))


def correlations_by_name(names: Sequence[str], own: Uncertainty) -> dict[str, dict[str, float]]:
    """Of the parameters of those names alone, each with each; NaN for one at a limit."""
    return {
        name: dict(zip(names, row.tolist(), strict=True))
        for name, row in zip(names, own.correlations, strict=True)
    }


def uncertainty_of(fit: Fit, *, noise_is_known: bool) -> Uncertainty:
    """Covariance (J^T J)^-1, scaled by the residual.

    Always where the noise is unknown; where it is known only upwards, since a misfit must not look certain.
    """
    names = fit.law.names
    at_bound = limits_reached(fit.law)
    free = np.array([name not in at_bound for name in names])
    readings = len(fit.residuals) if fit.readings is None else fit.readings
    dof = readings - len(fit.law.plain.names)
    weights = np.ones(len(fit.residuals)) if fit.weights is None else fit.weights
    noise = (fit.residuals / weights)[:readings]
    chi2_per_dof = float(noise @ noise / dof) if dof > 0 else float("nan")
    covariance = np.zeros((len(names), len(names)))
    if dof <= 0:
        return Uncertainty(covariance * np.nan, at_bound, chi2_per_dof)
    if fit.covariance is not None:
        # It knows what is open of a number that ran to zero.
        free = np.array([at_bound.get(name) != "upper" for name in names])
    block = np.ix_(free, free)
    if fit.covariance is not None:
        covariance[block] = fit.covariance[block]
    elif free.any():
        scale = max(1.0, chi2_per_dof) if noise_is_known else chi2_per_dof
        solve = _pseudo_inverse(fit.jacobian[:, free])
        # Weights choose among the points; the noise they let through is still the points' own.
        let_through = solve * weights
        covariance[block] = scale * let_through @ let_through.T
    return Uncertainty(covariance, at_bound, chi2_per_dof)


def _pseudo_inverse(J: Array) -> Array:
    """J^+ by singular values, columns scaled first. Shape (parameters, data)."""
    scale = np.linalg.norm(J, axis=0)
    scale = np.where(scale > 0, scale, 1.0)
    U, s, Vt = np.linalg.svd(J / scale, full_matrices=False)
    return np.asarray((Vt.T / np.maximum(s, _ROUNDING * s.max()) / scale[:, None]) @ U.T)


def limits_reached(law: CoreLaw) -> dict[str, str]:
    """Parameters that sit on a limit: name to "lower" or "upper"."""
    lower, upper = law.log_limits
    logs = np.log(np.maximum(law.values, 1e-300))
    found = {}
    for name, p, low, high in zip(law.names, logs, lower, upper, strict=True):
        if p - low < _AT_BOUND:
            found[name] = "lower"
        elif high - p < _AT_BOUND:
            found[name] = "upper"
    return found
