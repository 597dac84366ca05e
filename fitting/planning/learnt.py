"""What a rival has learnt of its numbers, and of the model's own errors, from what was measured."""

from dataclasses import dataclass

import numpy as np
import scipy.linalg as la

from fitting.arrays import Array, Complex
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.marginal import prior_precision
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.several.responses import response_of


@dataclass(frozen=True, eq=False)
class LearntRival:
    """The posterior of one rival, linear about its fit."""

    fitted: Refitted
    root: Array
    """Covariance is R R^T: of the fitted numbers, then of the model's errors. Shape (k, k)."""
    errors: Array
    """Their posterior mean, in standard deviations. Shape (errors,)."""


def learnt(problem: DiagnosisProblem, evidence: Evidence, fitted: Refitted, B: Array) -> LearntRival:
    """From a fit. `B` is what the model's errors do, over the noise: shape (data, errors)."""
    response = response_of(problem, fitted.effects)
    v, dv = response.with_derivatives(fitted.law, fitted.u)
    A = evidence.over_sigma(v, _columns(fitted, dv)).T
    left = evidence.over_sigma(v, _rest(evidence, v))
    rest = fitted.jacobian[fitted.data :]
    k, errors = A.shape[1], B.shape[1]
    P = np.zeros((k + errors, k + errors))
    P[:k, :k] = A.T @ A + rest.T @ rest + np.diag(prior_precision(fitted, problem.plate))
    P[:k, k:], P[k:, :k] = A.T @ B, B.T @ A
    P[k:, k:] = B.T @ B + np.eye(errors)
    chi2 = fitted.chi2_per_dof
    # As a fit's covariance: a misfit widens, a good fit narrows nothing.
    wider = np.sqrt(max(1.0, chi2)) if np.isfinite(chi2) else 1.0
    d = 1 / np.sqrt(np.diag(P))
    L = np.linalg.cholesky(P * np.outer(d, d) + 1e-12 * np.eye(len(P)))
    root = wider * d[:, None] * la.solve_triangular(L, np.eye(len(P)), lower=True).T
    mean = np.asarray(np.linalg.solve(B.T @ B + np.eye(errors), B.T @ left), dtype=float)
    return LearntRival(fitted, root, mean)


def _columns(fitted: Refitted, dv: Complex) -> Complex:
    """Derivatives to what is fitted, as it is fitted. Shape (columns, points)."""
    n = len(fitted.law.names)
    return np.concatenate([dv[:n], (dv[n:] * scales(fitted)[:, None])[fitted.free]])


def _rest(evidence: Evidence, v: Complex) -> Complex:
    """Measured less predicted, such that `over_sigma` puts it over the noise. Shape (points,)."""
    if evidence.has_phase:
        return np.asarray(evidence.measured_m_s - v)
    return np.asarray((evidence.measured_m_s - np.abs(v)) * v / np.abs(v))


def scales(fitted: Refitted) -> Array:
    """Derivative of u to u as it is fitted. Shape of `u`."""
    q = [q for e in fitted.effects for q in e.parameters]
    logarithmic = np.array([False] * fitted.stated + [one.logarithmic for one in q], dtype=bool)
    return np.where(logarithmic, fitted.u, 1.0)
