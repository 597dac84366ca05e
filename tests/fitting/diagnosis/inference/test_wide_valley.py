"""Fits of readings that are taken for a few percent."""

from types import SimpleNamespace

import numpy as np
import pytest

from fitting.data.readings import Readings
from fitting.diagnosis.inference import wide_valley
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.wide_valley import (
    evaluated_with_stated,
    in_wide_valley,
    of_effects,
    with_stated,
)
from fitting.diagnosis.response.unknowns import STATED_NUMBER
from fitting.effects import CATALOGUE
from fitting.laws.constant import ConstantModulus

LAW, GAIN = ConstantModulus(0.5e6, 0.5), CATALOGUE["gain_error"]
BY_STATED = 0.01
"""Of the reading, for a stated number off by its tolerance."""


class Reads:
    """The law in two points, and a third that a gain and a stated number move alike."""

    derivatives_cost_extra, plate, effects = True, None, (GAIN,)

    def __init__(self, stated):
        self.nuisances = (None,) * stated
        self.parameters = ((STATED_NUMBER,) * stated) + GAIN.parameters

    def velocity(self, law, u):
        off = BY_STATED * u[: len(self.nuisances)].sum()
        return np.array([*np.log(law.values), u[-1] + off], complex)

    def with_derivatives(self, law, u):
        dv = np.zeros((2 + len(u), 3), complex)
        dv[0, 0] = dv[1, 1] = dv[-1, 2] = 1.0
        dv[2 : 2 + len(self.nuisances), 2] = BY_STATED
        return self.velocity(law, u), dv


def task(stated):
    return SimpleNamespace(stated=stated, nuisances=(None,) * stated, as_stated=np.zeros(stated), coarse=None)


@pytest.fixture
def problem(monkeypatch):
    """With one stated number, and how it is without."""
    monkeypatch.setattr(wide_valley, "response_of", lambda problem, *_: Reads(problem.stated))
    found = task(1)
    found.with_stated_fixed = task(0)
    return found


EVIDENCE = Evidence(
    Readings(np.array([*np.log(LAW.values), 1.05], complex)),
    np.full(3, 1e-3),
    np.full(3, 1e-3),
    np.zeros((6, 1)),
    True,
)


def test_stated_numbers_are_none_of_its_unknowns_and_stay_as_stated(problem):
    found = in_wide_valley(problem, [GAIN], EVIDENCE, LAW, np.array([1.0]))
    assert found.stated == 0
    assert of_effects(found) == pytest.approx([1.05], rel=1e-3)
    assert with_stated(problem, found) == pytest.approx([0.0, 1.05], rel=1e-3)


def test_as_the_readings_are_it_is_still_on_its_way(problem):
    assert not in_wide_valley(problem, [GAIN], EVIDENCE, LAW, np.array([1.0])).converged


def test_told_of_stated_numbers_it_is_where_it_was_and_feels_them(problem):
    found = in_wide_valley(problem, [GAIN], EVIDENCE, LAW, np.array([1.0]))
    told = evaluated_with_stated(problem, EVIDENCE, found)
    assert told.stated == 1
    assert told.chi2 == pytest.approx(found.chi2)
    assert told.jacobian.shape[1] == found.jacobian.shape[1] + 1
    assert np.linalg.norm(told.jacobian[: told.data, 2]) > 0
    assert evaluated_with_stated(problem, EVIDENCE, told) is told
    assert with_stated(problem, told) is told.u
