"""A fit whose law ran to its lower limit: what is next to nothing may be more; a profile finds how much."""

from dataclasses import replace

import numpy as np
import pytest
from beam_tables import BEAM, read

from fitting.depth.intervals import Intervals
from fitting.depth.profile import profile
from fitting.depth.task import DepthTask
from fitting.laws.fractional_zener import FractionalZener
from fitting.mode_tables.fit import begin_modal, problem_of

LAW = FractionalZener(2e4, 3e8, 2e-6, 0.6)
AT_HZ = 20.0


@pytest.fixture(scope="module")
def quantities():
    """Of a fit in which `g0` went to 100 Pa: modes of some tens of Hz and more hardly tell it."""
    tables = [read(replace(BEAM, core=replace(BEAM.core, law=LAW)), 6, law=LAW)]
    begun = begin_modal(problem_of(tables, [BEAM]), LAW)
    assert begun.none.law.values[0] == pytest.approx(100.0, rel=1e-3)
    return begun.quantities(np.array([AT_HZ]))


def test_it_moves_by_its_value_over_the_end_of_its_range(quantities):
    task = quantities.task
    assert isinstance(task, DepthTask)
    assert task.mode[0] == pytest.approx(100.0 / LAW.limits[0].search[1], rel=1e-3)
    np.testing.assert_allclose(task.full(task.mode), task.whole)
    assert task.widths[0] == 1.0
    x, step = task.mode, 1e-7 * np.ones(len(task.mode))
    x[0] = 1e-3
    moved = task.residuals(x + step) - task.residuals(x - step)
    np.testing.assert_allclose(moved, 2 * task.jacobian(x) @ step, atol=1e-5 * np.abs(moved).max())


def test_the_profile_of_what_rests_on_it_holds_the_truth(quantities):
    found = profile(quantities)
    assert isinstance(found, Intervals)
    G, eta = LAW.storage_and_loss(np.array([2 * np.pi * AT_HZ]))
    for k, true in ((0, LAW.values[0]), (-2, G[0]), (-1, eta[0])):
        low, high = found.bounds[95][k]
        assert not low > true, found.names[k]
        assert true < high, found.names[k]
