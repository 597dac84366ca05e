"""Fits where the readings are taken for a few percent: far starts still feel the bottom.

What is stated is taken at its word there: a tolerance moves a reading by less than such a valley is wide, and
without the stated numbers among the unknowns a fit takes two thirds of the time.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refit import ROUGH, evaluated, refit
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.several.responses import response_of
from fitting.effects.base import Effect
from fitting.laws import CoreLaw


def in_wide_valley(
    problem: DiagnosisProblem,
    effects: Sequence[Effect],
    evidence: Evidence,
    law: CoreLaw,
    u: Array,
    *,
    brief: bool = False,
) -> Refitted:
    """Some effects fitted roughly, from a law and their unknowns: a fit that knows of no stated numbers.

    `u` of shape (unknowns of the effects,). `brief` as `refit` takes it.
    """
    fixed = problem.with_stated_fixed
    response = response_of(fixed, effects, fixed.coarse)
    begun = np.concatenate([fixed.as_stated, u])
    fitted = refit(response, evidence.blunt(), law, begun, tolerance=ROUGH, brief=brief)
    # As the readings are it has some way to go.
    return replace(fitted, converged=False)


def of_effects(fitted: Refitted) -> Array:
    """The unknowns of its effects. Shape (unknowns of the effects,)."""
    return fitted.u[fitted.stated :]


def with_stated(problem: DiagnosisProblem, fitted: Refitted) -> Array:
    """The unknowns of a fit, stated numbers as stated where it knows of none. Shape (unknowns,)."""
    if fitted.stated == len(problem.nuisances):
        return fitted.u
    return np.concatenate([problem.as_stated, fitted.u])


def evaluated_with_stated(problem: DiagnosisProblem, evidence: Evidence, fitted: Refitted) -> Refitted:
    """A fit of a wide valley that knows of stated numbers too, nothing moved."""
    if fitted.stated == len(problem.nuisances):
        return fitted
    response = response_of(problem, fitted.effects, problem.coarse)
    return evaluated(response, evidence.blunt(), fitted.law, with_stated(problem, fitted))
