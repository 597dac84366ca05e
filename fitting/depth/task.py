"""What the deeper looks share: the joint fit's residuals in units of what they are worth, and where it ended.

The rows are those of the linear errors (`Refitted.weighted`): readings and priors over their misfit, below
them the ranges that are searched, about the fit. A parameter at its limit stays there.
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
        fixed = limits_reached(self.law)
        names = self.law.names
        return np.array([n not in fixed for n in names] + [True] * (len(self.whole) - len(names)))

    @cached_property
    def mode(self) -> Array:
        """Where the fit ended. Shape (kept,)."""
        return self.whole[self.kept]

    @cached_property
    def limits(self) -> tuple[Array, Array]:
        """Least and largest values of the unknowns that may move. Shape (kept,) each."""
        low, high = self.problem.limits
        return low[self.kept], high[self.kept]

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
        return found[self.kept]

    def full(self, x: Array) -> Array:
        """All unknowns. Shapes (..., kept) to (..., unknowns)."""
        found = np.broadcast_to(self.whole, (*x.shape[:-1], len(self.whole))).copy()
        found[..., self.kept] = x
        return found

    def residuals(self, x: Array) -> Array:
        """Shape (rows,)."""
        r = self.problem.residuals(self.full(x)) / self.worth
        return np.concatenate([r, (x - self.mode) / self.widths])

    def jacobian(self, x: Array) -> Array:
        """Shape (rows, kept)."""
        J = self.problem.jacobian(self.full(x))[:, self.kept] / self.worth[:, None]
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
