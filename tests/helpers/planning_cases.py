"""A law of two parameters that readings see directly: what is right can be said without a plate."""

import numpy as np

from fitting.laws.constant import ConstantModulus
from fitting.planning.aims import Aims
from fitting.planning.sensitivity import Sensitivity

LAW = ConstantModulus(1e6, 0.5)
EVEN = np.array([0.5, 0.5])
"""Two rivals are as likely as each other."""


def sensitivity(sizes, others=0, seed=1):
    """Readings of ln G' (real part) and ln eta (imaginary), each so many over its noise.

    `others` are unknowns with unit priors that every reading sees too.
    """
    sizes = np.asarray(sizes, float)
    n = 2 + others
    rows = np.zeros((len(sizes), 2, n))
    rows[:, 0, 0] = rows[:, 1, 1] = sizes
    rows[:, :, 2:] = np.random.default_rng(seed).standard_normal((len(sizes), 2, others))
    prior = np.diag([1e-4, 1e-4, *np.ones(others)])
    ones = np.ones(len(sizes))
    return Sensitivity(LAW, ones.astype(complex), ones, rows, prior, others)


def aims():
    return Aims.over(LAW, 10.0, 100.0, 3)


def one(template, kind):
    return next(m for m in template.measurable(5e-3) if m.kind == kind)


def read(expecting, template, measurable):
    """What each expects of its own steps."""
    further = measurable.further
    rows = expecting.rows(measurable.part, len(further.at))
    return [f.of(rows) for f in expecting.forecasts(further, template.noise)]
