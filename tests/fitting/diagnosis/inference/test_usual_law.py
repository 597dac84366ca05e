"""A fit that has come far enough to compare, followed to its very end."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from fitting.data.readings import Readings
from fitting.diagnosis.executor import Executor
from fitting.diagnosis.inference import usual_law
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refit import CONVERGED, refit
from fitting.diagnosis.inference.usual_law import followed_to_convergence
from fitting.diagnosis.thresholds import SEARCH
from fitting.laws.constant import ConstantModulus
from fitting.laws.fractional_zener import FractionalZener

BEGINNING, END = ConstantModulus(0.15e6, 0.4), ConstantModulus(0.5e6 * np.e, 0.3 * np.e)


class Winding:
    """Rosenbrock's valley in the logarithms of the law, its bottom at (1, 1)."""

    effects, parameters, nuisances, plate, derivatives_cost_extra = (), (), (), None, False

    def with_derivatives(self, law, u):
        x, y = np.log(law.values / (0.5e6, 0.3))
        v = np.array([10 * (y - x**2), 1 - x], complex)
        return v, np.array([[-20 * x, -1], [10, 0]], complex)


@pytest.fixture
def valley(monkeypatch):
    """A problem whose response is the valley, and its readings."""
    monkeypatch.setattr(usual_law, "response_of", lambda *_: Winding())
    nodes = SimpleNamespace(nodes=SimpleNamespace(omega=np.ones(1)))
    problem = SimpleNamespace(fine=nodes)
    problem.around = lambda law: problem
    return problem, Evidence(Readings(np.zeros(2, complex)), np.ones(2), np.ones(2), np.zeros((4, 1)), True)


def test_what_is_on_its_way_along_a_winding_valley_owes_and_is_followed(valley):
    problem, evidence = valley
    on_the_way = refit(Winding(), evidence, BEGINNING, np.empty(0), brief=True)
    assert on_the_way.owed > 10 * SEARCH.least_owed
    found = followed_to_convergence(problem, evidence, on_the_way)
    assert found.law.values == pytest.approx(END.values, rel=1e-3)
    assert found.owed < 1e-6


def test_what_owes_nothing_stays_as_it_is(valley):
    problem, evidence = valley
    there = refit(Winding(), evidence, END, np.empty(0))
    assert followed_to_convergence(problem, evidence, there) is there


def test_what_ran_out_of_steps_is_followed_though_one_step_promises_nothing(valley, monkeypatch):
    problem, evidence = valley
    there = refit(Winding(), evidence, END, np.empty(0))
    followed = []

    def follow(*what, **how):
        followed.append(how["tolerance"])
        return there

    monkeypatch.setattr(usual_law, "refit", follow)
    followed_to_convergence(problem, evidence, replace(there, converged=False))
    assert followed == [CONVERGED]


def test_what_ran_out_of_steps_where_nothing_is_left_to_gain_has_come_to_its_end(valley):
    problem, evidence = valley
    there = refit(Winding(), evidence, END, np.empty(0))
    assert followed_to_convergence(problem, evidence, replace(there, converged=False)).converged


def test_what_could_not_gain_what_matters_in_all_its_steps_has_come_to_its_end(valley):
    _, evidence = valley
    freely = refit(Winding(), evidence, BEGINNING, np.empty(0), tolerance=CONVERGED)
    ended = refit(Winding(), evidence, BEGINNING, np.empty(0), tolerance=CONVERGED, least=50.0)
    assert ended.converged
    assert ended.evaluations < freely.evaluations
    assert ended.chi2 > freely.chi2


def test_it_is_told_how_far_it_must_come(valley, monkeypatch):
    problem, evidence = valley
    there, asked = refit(Winding(), evidence, END, np.empty(0)), []

    def follow(*what, **how):
        asked.append((how["goal"], how["least"]))
        return there

    monkeypatch.setattr(usual_law, "refit", follow)
    followed_to_convergence(problem, evidence, replace(there, converged=False), 3.0)
    assert asked == [(3.0, SEARCH.least_owed)]


OMEGA = 2 * np.pi * np.geomspace(15, 400, 20)


@pytest.mark.parametrize(("reached", "chi2"), [(True, 511.9), (False, 516.2)])
def test_a_law_far_from_what_cores_are_is_left_where_a_usual_one_does_better(monkeypatch, reached, chi2):
    """A drift's fit: in its own valley the law is G' 34 % off."""
    far = FractionalZener(3.2e5, 9.4e10, 3.3e-10, 0.76)
    begun, matters = [], 516.2 - SEARCH.least_owed

    def polished(problem, effects, evidence, law, u, goal):
        assert goal == matters
        begun.append(law)
        return SimpleNamespace(law=law, chi2=511.9, may_reach=lambda goal: reached and goal == matters)

    monkeypatch.setattr(usual_law, "polished", polished)
    monkeypatch.setattr(usual_law, "followed_to_convergence", lambda problem, evidence, fitted, *_: fitted)
    problem = SimpleNamespace(points=SimpleNamespace(omega=OMEGA))
    fitted = SimpleNamespace(law=far, chi2=516.2, effects=(), u=np.empty(0))
    found = usual_law.followed(problem, None, fitted)
    (usual,) = begun
    assert usual.ginf_pa <= 1.001e8
    assert np.abs(usual.modulus(OMEGA) / far.modulus(OMEGA) - 1).max() < 0.1
    assert found.chi2 == chi2


def test_what_a_usual_law_gains_less_than_matters_by_takes_nothing_s_place(monkeypatch):
    far = FractionalZener(3.2e5, 9.4e10, 3.3e-10, 0.76)
    fitted = SimpleNamespace(law=far, chi2=516.2, effects=(), u=np.empty(0))
    given_up = SimpleNamespace(law=far, chi2=516.15, may_reach=lambda goal: True)
    monkeypatch.setattr(usual_law, "polished", lambda *_: given_up)
    monkeypatch.setattr(usual_law, "followed_to_convergence", lambda problem, evidence, one, *_: one)
    problem = SimpleNamespace(points=SimpleNamespace(omega=OMEGA))
    assert usual_law.followed(problem, None, fitted) is fitted


def test_a_law_of_usual_size_is_begun_from_nowhere_else(monkeypatch):
    fitted = SimpleNamespace(law=FractionalZener(3.5e5, 7.9e6, 1.1e-4, 0.79))
    monkeypatch.setattr(usual_law, "followed_to_convergence", lambda problem, evidence, fitted, *_: fitted)
    problem = SimpleNamespace(points=SimpleNamespace(omega=OMEGA))
    assert usual_law.followed(problem, None, fitted) is fitted


def test_of_a_law_far_from_what_cores_are_both_ways_are_followed_in_one_go(monkeypatch):
    class Counting(Executor):
        def together(self, calls, report=lambda fraction: None):
            asked.append(len(calls))
            return super().together(calls, report)

    asked, ends = [], iter([510.0, 509.0])
    monkeypatch.setattr(usual_law, "polished", lambda *_: SimpleNamespace(may_reach=lambda goal: True))
    monkeypatch.setattr(usual_law, "followed_to_convergence", lambda *_: SimpleNamespace(chi2=next(ends)))
    problem = SimpleNamespace(points=SimpleNamespace(omega=OMEGA))
    far = FractionalZener(3.2e5, 9.4e10, 3.3e-10, 0.76)
    fitted = SimpleNamespace(law=far, chi2=516.2, effects=(), u=np.empty(0))
    assert usual_law.followed(problem, None, fitted, Counting()).chi2 == 509.0
    assert asked == [2]


@pytest.mark.parametrize(("brief", "grids"), [(True, ["coarse", "fine"]), (False, ["fine"])])
def test_a_rough_fit_that_was_on_its_way_goes_on_where_it_was_begun_first(valley, monkeypatch, brief, grids):
    problem, evidence = valley
    problem.coarse, problem.nuisances, asked = "coarse", (), []

    def response_of(problem, effects, grid="fine"):
        asked.append(grid)
        return Winding()

    monkeypatch.setattr(usual_law, "response_of", response_of)
    rough = refit(Winding(), evidence, BEGINNING if brief else END, np.empty(0), brief=brief)
    assert rough.converged is not brief
    found = usual_law.finished(problem, evidence, rough)
    assert found.law.values == pytest.approx(END.values, rel=1e-3)
    assert list(dict.fromkeys(asked)) == grids


def test_a_rough_fit_that_cannot_come_to_a_goal_is_left_on_few_nodes(valley, monkeypatch):
    problem, evidence = valley
    problem.coarse, problem.nuisances = "coarse", ()
    rough = refit(Winding(), evidence, BEGINNING, np.empty(0), brief=True)
    monkeypatch.setattr(usual_law, "polished", None)
    # Of a sum of squares.
    assert usual_law.finished(problem, evidence, rough, goal=-1e9).chi2 <= rough.chi2
