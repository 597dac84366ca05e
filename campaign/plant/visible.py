"""How plainly a hidden effect shows: what no law of the declared kind can take up, in units of the noise.

The plant itself is the model here, so this is the most that any diagnosis could see in the sweep; what a
hammer test adds is left out.
"""

import numpy as np
from scipy.optimize import least_squares

from campaign.law import TrueLaw
from campaign.plant.cases import Case, Truth, clean
from campaign.plant.materials import nearest_zener
from campaign.schedule import Schedule
from fitting.arrays import Array

_MOST_EVALUATIONS = 8
_CLOSE = 1e-3
_LOWER = np.log([1e3, 1e4, 1e-8, 0.05])
_UPPER = np.log([1e8, 1e10, 1e1, 1.0])


def visible_chi2(case: Case) -> float:
    """Chi-square that the best fractional Zener leaves of the sweep without its noise and hum."""
    sweep, truth, g = case.sweep, case.truth, case.specimen.base_acceleration_m_s2
    times = np.zeros(len(sweep)) if sweep.time_s is None else sweep.time_s
    level_g = sweep.commanded_m_s2 / g
    schedule = Schedule(sweep.frequency_hz, sweep.segment, sweep.sweep, level_g, times)
    wanted = clean(truth, schedule, g)
    std = truth.noise.std_m_s(wanted * sweep.commanded_m_s2, sweep.sweep) / sweep.commanded_m_s2
    frequency_hz, which = np.unique(sweep.frequency_hz, return_inverse=True)
    zeros, ones = np.zeros(len(frequency_hz)), np.ones(len(frequency_hz), dtype=np.intp)
    undisturbed = Schedule(frequency_hz, ones, ones, ones.astype(float), zeros)

    def residuals(p: Array) -> Array:
        law = TrueLaw("fractional-zener", tuple(float(v) for v in np.exp(p)))
        v = clean(Truth({}, law, truth.noise), undisturbed, g)
        left = (v[which] - wanted) / std
        return np.concatenate([left.real, left.imag])

    start = np.log(nearest_zener(truth.law, 2 * np.pi * frequency_hz).values)
    start = np.clip(start, _LOWER + 1e-6, _UPPER - 1e-6)
    found = least_squares(residuals, start, bounds=(_LOWER, _UPPER), ftol=_CLOSE, max_nfev=_MOST_EVALUATIONS)
    return float(2 * found.cost)
