"""One law shifted, fitted to a shear pair's sweeps of three temperatures: milliseconds a fit."""

from dataclasses import replace

import numpy as np
import shear_pair_cases as cases

from fitting.data.noise import Noise, noise_of
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.temperature.joint import TemperatureProblem, fit_shifted
from fitting.temperature.shifted_law import ShiftedLaw
from fitting.temperature.shifts import Shift
from fitting.temperature.sweeps import AloneSweep, Sweeps

T, REFERENCE = np.array([10.0, 20.0, 30.0]), 20.0
LOG_A = np.array([1.5, 0.0, -1.2])
POINTS = (30, 25, 20)
PAIR = cases.pair(0.2533, exact=True)


def begun(k, law, *, known=True, pair=PAIR):
    """The sweep of one temperature by itself."""
    true = replace(pair, core=replace(pair.core, law=law))
    s = cases.sweep(true, points=POINTS[k], seed=k)
    noise = noise_of(s) if known else Noise(noise_of(s).std_m_s, "unknown")
    return begin(SmallProblem.of_small(s, pair), None, noise, None, cases.LAW)


def alone(each):
    """As what is said of them takes them."""
    return tuple(AloneSweep(b, None, noise_of(b.problem.sweep)) for b in each)


def fitted(laws, kind="free", *, vertical=False, known=True):
    """The problem, the fit, and each temperature by itself."""
    each = [begun(k, law, known=known) for k, law in enumerate(laws)]
    problem = TemperatureProblem(Sweeps.of(each), Shift(kind, T, REFERENCE), vertical)
    z = problem.stated([b.none.z for b in each])
    return problem, fit_shifted(problem, [b.none.law for b in each], z), each


def shifted(b=(1.0, 1.0, 1.0)):
    return [ShiftedLaw(cases.LAW, float(np.exp(s)), v) for s, v in zip(LOG_A, b, strict=True)]
