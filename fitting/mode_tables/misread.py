"""A mode that does not go with the others: mistyped, or of another motion.

By two rules. A gross one leaves more than errors three times as large, tolerances and the law's bend explain.
A smaller one a law takes up: it bends, and stated numbers move, each within what it may. But all residuals
together, those of bend and stated numbers among them, are a chi-square with as many degrees of freedom as
there are readings beyond the law's parameters; and a row that is right takes two of these along when it is
left out.
"""

from dataclasses import dataclass, replace

import numpy as np

from fitting.diagnosis.inference.marginal import cost
from fitting.diagnosis.inference.refit import refit
from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.search.catalogue_search import ScoredFit
from fitting.diagnosis.thresholds import VERDICT
from fitting.errors import OutsideModel
from fitting.mode_tables.fit import BegunModal
from fitting.numerics.chances import chi2_above, chi2_exceeded, f_above
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
_AGREED = 0.01
"""Tail probability from which rows go together: all of them, or the others without one. A choice."""
_UNLIKE = 0.005
"""Chance, of any row of a right table, to take as much along as the odd one. A choice: where everything else
is known exactly one right table in two hundred is doubted, with tolerances fewer."""


@dataclass(frozen=True)
class Misread:
    """The odd one, and where the law of the others has it."""

    place: int
    """Among the modes of all tables, from 0."""
    frequency_hz: float
    loss_factor: float
    others: Refitted
    """Their fit, without any effect."""
    with_it: float = np.nan
    """Chi-square of all rows, priors counted in."""
    plain: bool = True
    """Whether it is gross: then no law of all rows is to be trusted."""
    rivals: tuple["Misread", ...] = ()
    """Other rows, any one of which may be the one instead; the likeliest first."""

    def beyond(self, best: ScoredFit, plate: EnrichedReducedPlate) -> float:
        """By how much a misread row costs more than an explanation of all modes, `plate` that of no effect.

        In -2 ln of a probability. Where errors are stated by what both are worth; else by what they leave,
        priors counted in.
        """
        if self.others.noise_known:
            return cost(self.others, plate) + _MISREAD - best.cost
        return self.others.chi2 + _PLAINER - best.fitted.chi2


def misread(begun: BegunModal) -> Misread | None:
    """The one mode without which one law explains the rest; None where none or several are such."""
    problem, none = begun.problem, begun.none
    count, dof = len(problem.frequency_hz), none.data - none.parameter_count
    if count < _FEWEST or dof - 2 < _SPARE or not chi2_above(none.chi2, dof) < _AGREED:
        return None
    most, agreed = _most(none, dof - 2), float(chi2_exceeded(_AGREED, dof - 2))
    gross = none.chi2 >= _most(none, dof) + _PLAINER
    # What ends above the goal is neither the odd one nor near to it.
    goal = most + _PLAINER if gross else agreed
    each = ((k, _without(begun, k, goal)) for k in range(count))
    found = sorted(((k, fit) for k, fit in each if fit is not None), key=lambda one: one[1].chi2)
    if not found:
        return None
    k, fit = found[0]
    if gross and fit.chi2 <= most and not any(other.chi2 < fit.chi2 + _PLAINER for _, other in found[1:]):
        return _odd(begun, k, fit, plain=True)
    unlike = [
        _odd(begun, k, fit, plain=False)
        for k, fit in found
        if fit.chi2 <= agreed and count * _chance(begun, fit, dof - 2) < _UNLIKE
    ]
    # Where any of most rows may be the one, it is none of them.
    if not unlike or len(unlike) > count / 2:
        return None
    return replace(unlike[0], rivals=tuple(unlike[1:]))


def _chance(begun: BegunModal, others: Refitted, left: int) -> float:
    """That a row which is right takes as much along; `left` are the degrees of freedom of the others."""
    taken = max(begun.none.chi2 - others.chi2, 0.0)
    chance = float(chi2_above(taken, 2))
    if begun.problem.scale_known:
        return chance
    return max(chance, float(f_above(taken / 2 / (others.chi2 / left), 2, left)))


def _odd(begun: BegunModal, k: int, others: Refitted, *, plain: bool) -> Misread:
    """A row beside the law of the others."""
    kappa = np.concatenate([m.kappa for m in begun.problem.members])
    log = begun.problem.response().velocity(others.law, others.u)[k]
    return Misread(
        k, float(np.exp(log.real)), float(np.exp(log.imag / kappa[k])), others, begun.none.chi2, plain
    )


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
