"""A mode that does not go with the others: mistyped, or of another motion. No effect explains such a row."""

from dataclasses import dataclass

import numpy as np

from fitting.diagnosis.inference.marginal import cost
from fitting.diagnosis.inference.refit import refit
from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.search.catalogue_search import ScoredFit
from fitting.diagnosis.thresholds import VERDICT
from fitting.errors import OutsideModel
from fitting.mode_tables.fit import BegunModal
from fitting.numerics.chances import chi2_exceeded
from fitting.widened.enriched_plate import EnrichedReducedPlate

_WITHIN = 3.0
"""Times what the errors of the others explain, up to which they go with one law: errors are seldom known."""
_SPARE = 2
"""Numbers that the others must leave over."""
_FEWEST = 4
"""Modes: of three any one can be left out."""
_PLAINER = 25.0
"""Chi-square by which one must be the odd one."""
_MISREAD = 25.0
"""-2 ln of the chance that a row is misread (one table in fifty, any row of it) and then says just that: a
frequency within half of it known to 0.1 %, a loss factor to 3 %."""


@dataclass(frozen=True)
class Misread:
    """The odd one, and where the law of the others has it."""

    place: int
    """Among the modes of all tables, from 0."""
    frequency_hz: float
    loss_factor: float
    others: Refitted
    """Their fit, without any effect."""

    def says_more_than(self, best: ScoredFit, plate: EnrichedReducedPlate) -> bool:
        """Whether an explanation of all modes is plainly less likely, `plate` that of no effect.

        Where errors are stated by what both are worth; else by what they leave, priors counted in.
        """
        if self.others.noise_known:
            return cost(self.others, plate) + _MISREAD < best.cost
        return self.others.chi2 + _PLAINER < best.fitted.chi2


def misread(begun: BegunModal) -> Misread | None:
    """The one mode without which one law explains the rest; None where none or several are such."""
    problem, none = begun.problem, begun.none
    count = len(problem.frequency_hz)
    spare = 2 * (count - 1) - none.parameter_count
    if count < _FEWEST or spare < _SPARE or none.chi2 < _most(none, spare + _SPARE) + _PLAINER:
        return None
    most = _most(none, spare)
    # What ends above the goal is neither the odd one nor near to it.
    each = ((k, _without(begun, k, goal=most + _PLAINER)) for k in range(count))
    found = [(fit.chi2, k, fit) for k, fit in each if fit is not None]
    found.sort(key=lambda one: one[0])
    if not found or found[0][0] > most:
        return None
    if len(found) > 1 and found[1][0] < found[0][0] + _PLAINER:
        return None
    _, k, fit = found[0]
    kappa = np.concatenate([m.kappa for m in problem.members])
    log = problem.response().velocity(fit.law, fit.u)[k]
    return Misread(k, float(np.exp(log.real)), float(np.exp(log.imag / kappa[k])), fit)


def _most(none: Refitted, dof: int) -> float:
    """Chi-square that modes, stated numbers and the bend may leave together."""
    known = none.stated + none.law.bend_count
    return _WITHIN * dof + float(chi2_exceeded(VERDICT.check_level, known)) if known else _WITHIN * dof


def _without(begun: BegunModal, k: int, goal: float) -> Refitted | None:
    """The best fit of all but one mode, from the law of all and from the one that was begun with.

    `goal` as `refit` takes it.
    """
    rest = np.arange(len(begun.problem.frequency_hz)) != k
    response, u = begun.problem.response(), 0 * begun.none.u
    found = []
    for law in (begun.none.law, begun.start):
        try:
            found.append(refit(response, begun.evidence, law, u, points=rest, goal=goal))
        except (OutsideModel, np.linalg.LinAlgError):
            continue
    return min(found, key=by_chi2, default=None)
