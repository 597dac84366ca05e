"""How fast a fit gets on, and whether it may still get to where it would matter."""

import numpy as np
from scipy.optimize import OptimizeResult

_MOST_STEPS = 75
"""As many as a fit may have, its grid made anew twice: what would take more of them is not on its way."""
_MAY_QUICKEN = 2.0
"""Times its pace that a rough fit is trusted with in the steps it has left. Of 110 that were followed all the
way beside better ones none came from further behind; a choice."""
_SEEN = 2
"""Steps that a pace is judged by: one may have been cut short."""


def is_within_reach(chi2: float, goal: float, pace: float) -> bool:
    """Whether a fit that gains `pace` of chi-square a step may come down to `goal`."""
    return chi2 - goal <= _MOST_STEPS * pace


class Steps:
    """The steps of a fit as it takes them: a callback of scipy's.

    It ends the fit where a chi-square of `goal` is out of reach, or one of `rival` by the end of the
    evaluations that it may have, `most`: of rough fits those that have come furthest by then are chosen. So
    it does where less than `least` is left to gain in all the steps that a fit may have: it has converged.
    """

    def __init__(
        self, goal: float = np.inf, rival: float = np.inf, most: int = _MOST_STEPS, least: float = 0.0
    ) -> None:
        self._goal, self._rival, self._most, self._least = goal, rival, most, least
        self.converged = False
        self._chi2 = list[float]()

    def __call__(self, intermediate_result: OptimizeResult) -> None:
        """Take note of a step. Raises `StopIteration` to end the fit."""
        self._chi2.append(2 * float(intermediate_result.cost))
        if not is_within_reach(self._chi2[-1], self._goal, self.pace):
            raise StopIteration
        self.converged = _MOST_STEPS * self.pace < self._least
        if self.converged:
            raise StopIteration
        if np.isfinite(self._rival) and np.isfinite(self.pace):
            left = self._most - int(intermediate_result.nfev)
            if self._chi2[-1] - self._rival > _MAY_QUICKEN * left * self.pace:
                raise StopIteration

    @property
    def pace(self) -> float:
        """Chi-square gained by the better one of the last two steps; without bound before there are three.

        The first one is from where it began, which says nothing.
        """
        if len(self._chi2) <= _SEEN:
            return np.inf
        return float(np.max(-np.diff(self._chi2[-_SEEN - 1 :])))
