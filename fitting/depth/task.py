"""What the deeper looks share: the joint fit's residuals in units of what they are worth, and where it ended.

The rows are those of the linear errors (`Refitted.weighted`): readings and priors over their misfit, below
them the ranges that are searched, about the fit. A parameter at its upper limit stays there; one of the law
that ran below the range that is searched moves by its value over that range's end, not by its logarithm:

    x = p / p_high    d/dx = (1 / x) d/d(ln p)

where it has next to no effect a logarithm would never leave it (as in `CoreLaw.open_widths`).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Mask
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.joint_problem import JointProblem
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.response.response import Response
from fitting.identification.uncertainty import limits_reached
from fitting.laws import CoreLaw


@dataclass(frozen=True)
class DepthTask:
    """One joint fit; `x` holds its unknowns that may move."""

    problem: JointProblem
    fitted: Refitted

    @classmethod
    def of(cls, response: Response, evidence: Evidence, fitted: Refitted) -> "DepthTask":
        """Of a fit by a response and its evidence, of whatever specimens and data."""
        return cls(JointProblem(response, evidence, fitted.law, fitted.u, None), fitted)

    @property
    def law(self) -> CoreLaw:
        """Where the fit ended."""
        return self.fitted.law

    @cached_property
    def whole(self) -> Array:
        """All unknowns at the fit. Shape (unknowns,)."""
        return np.clip(self.problem.start, *self.problem.limits)

    @cached_property
    def kept(self) -> Mask:
        """Which of them may move. Shape (unknowns,)."""
        fixed = {name for name, side in limits_reached(self.law).items() if side != "lower"}
        names = self.law.names
        return np.array([n not in fixed for n in names] + [True] * (len(self.whole) - len(names)))

    @cached_property
    def mode(self) -> Array:
        """Where the fit ended. Shape (kept,)."""
        return self._to_x(self.whole[self.kept])

    @cached_property
    def _by_value(self) -> Mask:
        """Which of those that may move do so by their values. Shape (kept,)."""
        own = self._searched
        found = np.zeros(len(self.whole), dtype=bool)
        found[: len(own)] = self.law.values[: len(own)] < own[:, 0]
        return found[self.kept]

    @cached_property
    def _log_high(self) -> Array:
        """Logarithms of the ends of the ranges of these. Shape (by value,)."""
        own = self._searched
        high = np.full(len(self.whole), np.nan)
        high[: len(own)] = np.log(own[:, 1])
        return high[self.kept][self._by_value]

    @cached_property
    def _searched(self) -> Array:
        """The ranges of the law's parameters. Shape (parameters, 2)."""
        searched = self.law.limits[: len(self.law.search_widths)]
        return np.array([q.search for q in searched]).reshape(-1, 2)

    def _to_x(self, logs: Array) -> Array:
        found = np.array(logs)
        found[self._by_value] = np.exp(found[self._by_value] - self._log_high)
        return found

    def slope(self, x: Array) -> Array:
        """Derivatives of the fit's own unknowns to those here. Shape of `x`, (..., kept)."""
        found = np.ones(x.shape)
        found[..., self._by_value] = 1 / x[..., self._by_value]
        return found

    @cached_property
    def limits(self) -> tuple[Array, Array]:
        """Least and largest values of the unknowns that may move. Shape (kept,) each."""
        low, high = self.problem.limits
        return self._to_x(low[self.kept]), self._to_x(high[self.kept])

    @cached_property
    def worth(self) -> Array:
        """What every row of the fit is divided by: its misfit, never below one where the noise is known.

        Shape (rows,).
        """
        fitted = self.fitted
        chi2 = fitted.chi2_per_dof
        scale = chi2 if np.isfinite(chi2) and chi2 > 0 else 1.0
        scale = max(1.0 if fitted.noise_known else fitted.least_scale, scale)
        found = np.ones(len(fitted.residuals))
        found[slice(None) if fitted.noise_known else slice(fitted.data)] *= np.sqrt(scale)
        return found

    @cached_property
    def widths(self) -> Array:
        """Standard deviations of the ranges that are searched, infinite without one. Shape (kept,)."""
        found = np.full(len(self.whole), np.inf)
        own = self.law.search_widths
        found[: len(own)] = own
        return np.where(self._by_value, 1.0, found[self.kept])

    def full(self, x: Array) -> Array:
        """All unknowns. Shapes (..., kept) to (..., unknowns)."""
        found = np.broadcast_to(self.whole, (*x.shape[:-1], len(self.whole))).copy()
        own = np.array(x)
        own[..., self._by_value] = np.log(own[..., self._by_value]) + self._log_high
        found[..., self.kept] = own
        return found

    def residuals(self, x: Array) -> Array:
        """Shape (rows,)."""
        r = self.problem.residuals(self.full(x)) / self.worth
        return np.concatenate([r, (x - self.mode) / self.widths])

    def jacobian(self, x: Array) -> Array:
        """Shape (rows, kept)."""
        J = self.problem.jacobian(self.full(x))[:, self.kept] * self.slope(x) / self.worth[:, None]
        return np.vstack([J, np.diag(1 / self.widths)])

    @cached_property
    def root(self) -> Array:
        """A root of the linear covariance: root root^T. Shape (kept, kept)."""
        J = self.jacobian(self.mode)
        size = np.linalg.norm(J, axis=0)
        size = np.where(size > 0, size, 1.0)
        _, s, Vt = np.linalg.svd(J / size, full_matrices=False)
        return np.asarray(Vt.T / np.maximum(s, 1e-12 * s.max()) / size[:, None])

    @cached_property
    def covariance(self) -> Array:
        """Linear, about the fit. Shape (kept, kept)."""
        return self.root @ self.root.T
