"""A fit that has come far enough to compare, followed to its very end."""

from types import SimpleNamespace

import numpy as np
import pytest

from fitting.diagnosis import candidates
from fitting.diagnosis.candidates import at_rest
from fitting.diagnosis.evidence import Evidence
from fitting.diagnosis.refit import refit
from fitting.diagnosis.thresholds import SEARCH
from fitting.laws.constant import ConstantModulus

BEGINNING, END = ConstantModulus(0.15e6, 0.4), ConstantModulus(0.5e6 * np.e, 0.3 * np.e)


class Winding:
    """Rosenbrock's valley in the logarithms of the law, its bottom at (1, 1)."""

    effects, parameters, nuisances, plate = (), (), (), None

    def with_derivatives(self, law, u):
        x, y = np.log(law.values / (0.5e6, 0.3))
        v = np.array([10 * (y - x**2), 1 - x], complex)
        return v, np.array([[-20 * x, -1], [10, 0]], complex)


@pytest.fixture
def valley(monkeypatch):
    """A problem whose response is the valley, and its readings."""
    monkeypatch.setattr(candidates, "response_of", lambda *_: Winding())
    nodes = SimpleNamespace(nodes=SimpleNamespace(omega=np.ones(1)))
    problem = SimpleNamespace(fine=nodes)
    problem.around = lambda law: problem
    return problem, Evidence(np.zeros(2, complex), np.ones(2), np.ones(2), np.zeros((4, 1)), True)


def test_what_is_on_its_way_along_a_winding_valley_owes_and_is_followed(valley):
    problem, evidence = valley
    on_the_way = refit(Winding(), evidence, BEGINNING, np.empty(0), brief=True)
    assert on_the_way.owed > 10 * SEARCH.least_owed
    found = at_rest(problem, evidence, on_the_way)
    assert found.law.values == pytest.approx(END.values, rel=1e-3)
    assert found.owed < 1e-6


def test_what_owes_nothing_stays_as_it_is(valley):
    problem, evidence = valley
    there = refit(Winding(), evidence, END, np.empty(0))
    assert at_rest(problem, evidence, there) is there
