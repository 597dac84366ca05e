"""The law of usual size nearest to another.

A fit may end far outside of what cores are, in a valley of its own: what the law does in the band it does as
well from there.
"""

import numpy as np
from scipy.optimize import least_squares

from fitting.arrays import Array
from fitting.diagnosis.candidates import at_rest, polished
from fitting.diagnosis.evidence import Evidence
from fitting.diagnosis.problem import DiagnosisProblem
from fitting.diagnosis.refitted import Refitted
from fitting.laws import CoreLaw

_OPEN = 1e-9
"""A range of one value is none for a bounded fit."""


def followed(problem: DiagnosisProblem, evidence: Evidence, fitted: Refitted) -> Refitted:
    """A fit followed to its very end, from where its law is of usual size too if it is not."""
    found = at_rest(problem, evidence, fitted)
    usual = within_search(found.law, problem.points.omega)
    if usual is found.law:
        return found
    again = polished(problem, found.effects, evidence, usual, found.u)
    if not again.may_reach(found.chi2):
        return found
    return min(found, at_rest(problem, evidence, again), key=lambda f: f.chi2)


def within_search(law: CoreLaw, omega: Array) -> CoreLaw:
    """The law of the ranges that are searched whose modulus is nearest to a law's; itself where it is one.

    `omega` in rad/s, shape (points,).
    """
    low, high = np.log([q.search for q in law.limits]).T
    logs = np.log(law.values)
    if np.all((logs >= low) & (logs <= high)):
        return law
    wanted = np.log(law.modulus(omega))

    def off(p: Array) -> Array:
        d = np.log(law.with_logs(p).modulus(omega)) - wanted
        return np.concatenate([d.real, d.imag])

    return law.with_logs(least_squares(off, np.clip(logs, low, high), bounds=(low - _OPEN, high + _OPEN)).x)
