"""What a rival expects of a hammer test of the bare plate."""

import numpy as np

from fitting.diagnosis.inference.evidence import BareModes
from fitting.diagnosis.several.of_files import Place
from fitting.nuisances.nuisances import Nuisances
from fitting.planning.further_readings import Places, effects_at
from fitting.planning.learnt import LearntRival, scales
from fitting.planning.rivalry import Forecast

_STEP = 1e-4
"""Of an unknown's typical size: what it is moved by to see what that changes of the bare plate. A choice."""


def struck_forecast(
    learnt: LearntRival, bare: BareModes, nuisances: Nuisances, stated: Places, place: Place
) -> Forecast:
    """Frequencies alone are asked.

    The plate is that of a `place`: `nuisances` are its own, `stated` where they are among those fitted.
    """
    fitted = learnt.fitted
    n, z = len(fitted.law.names), fitted.u[stated]
    shift = bare.stated_shift(nuisances, z)
    column = np.cumsum(fitted.free) - 1 + n
    by = np.zeros((n + int(fitted.free.sum()), len(shift)))
    by_z = bare.by_stated(nuisances, z)
    for k, g in enumerate(stated):
        by[column[g]] += by_z[k]
    scale, fresh = scales(fitted), []
    for effect, places in zip(*effects_at(fitted, place), strict=True):
        u = fitted.u[places]
        forms = effect.bare_forms(u)
        shifts = np.array([effect.bare_shift(bare, one) for one in forms])
        shift = shift + shifts.mean(axis=0)
        if len(forms) > 1:
            fresh.append((shifts[1] - shifts[0]) / 2)
        for m, (q, g) in enumerate(zip(effect.parameters, places.tolist(), strict=True)):
            if fitted.free[g]:
                h = _STEP * (abs(u[m]) if q.logarithmic else q.typical or 1.0)
                moved = [np.where(np.arange(len(u)) == m, one + h, one) for one in forms]
                there = np.mean([effect.bare_shift(bare, one) for one in moved], axis=0)
                by[column[g]] += scale[g] * (there - shifts.mean(axis=0)) / h
    rows = learnt.root[: len(by)].T @ by
    every = np.concatenate([rows, np.array(fresh)]) if fresh else rows
    return Forecast(bare.whitened_change(shift), bare.whitened_change(every.T), len(rows))
