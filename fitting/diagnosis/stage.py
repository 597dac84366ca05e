"""A fit before or after, with everything that is said of it."""

import numpy as np
from numpy.typing import NDArray

from fitting.diagnosis.evidence import Evidence
from fitting.diagnosis.refit import Fitted
from fitting.diagnosis.result import Estimate, FoundEffect, Stage
from fitting.diagnosis.structure import structure
from fitting.diagnosis.task import Task
from fitting.effects.spanned import SpannedPlate
from fitting.identification.result import differences_percent, law_band
from fitting.identification.uncertainty import Uncertainty, limits_reached
from fitting.identification.validation import Validation

Array = NDArray[np.float64]


def stage_of(task: Task, evidence: Evidence, fitted: Fitted, validation: Validation) -> Stage:
    """`validation` is what the fit says of data it has not seen."""
    law = fitted.law
    reached = limits_reached(law)
    n = len(law.names)
    covariance = fitted.covariance
    # What sits at a limit has no first-order error of its own.
    at_limit = np.array([name in reached for name in law.names])
    by_law = covariance[:n, :n] * ~np.logical_or.outer(at_limit, at_limit)
    errors = np.sqrt(np.diag(by_law)) * law.values
    uncertainty = Uncertainty(by_law, np.zeros((n, n)), reached, fitted.chi2_per_dof)
    whitened = fitted.residuals[: fitted.data]
    chi2 = fitted.chi2_per_dof if evidence.scale_known else float("nan")
    return Stage(
        law=law,
        standard_errors={
            name: float("nan") if name in reached else float(e)
            for name, e in zip(law.names, errors, strict=True)
        },
        band=law_band(task.sweep, law, uncertainty),
        predicted_m_s=fitted.velocity_m_s,
        difference_percent=differences_percent(task.sweep, fitted.velocity_m_s),
        whitened=whitened,
        chi2_per_dof=chi2,
        validation=validation,
        structure=structure(task.sweep, evidence, whitened, chi2),
    )


def found_effects(fitted: Fitted, plate: SpannedPlate) -> tuple[FoundEffect, ...]:
    """The effects of a fit with their sizes and standard errors."""
    n = len(fitted.law.names)
    inner = np.full(len(fitted.u), np.nan)
    inner[fitted.free] = np.sqrt(np.maximum(np.diag(fitted.covariance)[n:], 0))
    found, start = [], 0
    for effect in fitted.effects:
        lower, upper = effect.limits(plate)
        parameters = {}
        for k, q in enumerate(effect.unknowns):
            value, error = float(fitted.u[start + k]), float(inner[start + k])
            if q.logarithmic:
                error *= value
            reach = 1e-6 * (upper[k] - lower[k]) if np.isfinite(upper[k]) else 0.0
            if not q.fixed and (value - lower[k] <= reach or upper[k] - value <= reach):
                error = float("nan")
            parameters[q.key] = Estimate(value, error, q.unit)
        if effect.replaces_law:
            errors = np.sqrt(np.diag(fitted.covariance)[:n]) * fitted.law.values
            for name, value, error in zip(fitted.law.names, fitted.law.values, errors, strict=True):
                parameters[name] = Estimate(float(value), float(error), _unit(name))
        found.append(FoundEffect(effect.name, parameters))
        start += len(effect.unknowns)
    return tuple(found)


def _unit(name: str) -> str:
    if name.endswith("_pa"):
        return "Pa"
    return "rad/s" if name.endswith("_rad_s") else "s" if name.endswith("_s") else "1"
