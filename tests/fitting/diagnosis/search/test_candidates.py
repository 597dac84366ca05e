"""Which starts of an effect are followed beside a fit so far."""

from types import SimpleNamespace

import numpy as np
import pytest

from fitting.diagnosis.search import candidates
from fitting.diagnosis.search.candidates import CandidateFit
from fitting.effects.base import Effect, EffectParameter
from fitting.laws.fractional_zener import FractionalZener

OMEGA = 2 * np.pi * np.geomspace(20, 300, 9)
PROBLEM = SimpleNamespace(points=SimpleNamespace(omega=OMEGA))
USUAL = FractionalZener(4e5, 8e6, 2e-4, 0.7)
SIZE = EffectParameter("size", "m", -1.0, 1.0, 0.1)
FORM = EffectParameter("form", "1", 0.0, 1.0, 0.0, neutral=None, fixed=True)
PLACE = EffectParameter("x", "m", 0.0, 1.0, 0.1, neutral=None)


class TwoForms(Effect):
    name, parameters = "two_forms", (SIZE, FORM)


class Placed(Effect):
    name, parameters = "placed", (SIZE, PLACE, FORM)


def followed(monkeypatch, effect, *starts):
    """The unknowns that rough fits begin at."""
    monkeypatch.setattr(CandidateFit, "followed", lambda _, start: SimpleNamespace(chi2=start[0], u=start[1]))
    known = [(promise, np.array(u)) for promise, u in starts]
    return [f.u.tolist() for f in CandidateFit(None, None, None, effect, known).fit_near()]


def test_every_form_of_an_effect_is_followed_whatever_a_linear_step_promises(monkeypatch):
    found = followed(monkeypatch, TwoForms(), (9.0, [0.3, 0.0]), (8.0, [0.2, 0.0]), (0.1, [0.1, 1.0]))
    assert sorted(found) == [[0.1, 1.0], [0.2, 0.0], [0.3, 0.0]]


def test_of_one_form_a_start_that_promises_little_is_left(monkeypatch):
    assert followed(monkeypatch, TwoForms(), (9.0, [0.3, 0.0]), (0.1, [0.2, 0.0])) == [[0.3, 0.0]]


def test_of_many_places_those_that_promise_are_followed(monkeypatch):
    starts = (90.0, [0.3, 0.5, 0.0]), (0.1, [0.2, 0.1, 0.0]), (0.1, [0.2, 0.1, 1.0])
    assert followed(monkeypatch, Placed(), *starts) == [[0.3, 0.5, 0.0]]


def test_what_is_looked_at_briefly_is_looked_at_in_every_form(monkeypatch):
    begun = []
    monkeypatch.setattr(CandidateFit, "_rough", lambda _, law, u, *, brief: begun.append((law, u.tolist())))
    starts = (9.0, [0.3, 0.0]), (8.0, [0.2, 0.0]), (0.1, [0.1, 1.0])
    known = [(promise, np.array(u)) for promise, u in starts]
    CandidateFit(PROBLEM, None, SimpleNamespace(law=USUAL), TwoForms(), known).briefly()
    assert begun == [(USUAL, [0.3, 0.0]), (USUAL, [0.1, 1.0])]


def test_a_law_at_its_limits_is_left_for_the_usual_one_nearest_to_it(monkeypatch):
    begun = []
    monkeypatch.setattr(CandidateFit, "_rough", lambda _, law, u, *, brief: begun.append(law))
    far = FractionalZener(2.4e5, 4e9, 1e-10, 0.47)
    known = [(9.0, np.array([0.3, 0.0]))]
    CandidateFit(PROBLEM, None, SimpleNamespace(law=far), TwoForms(), known).briefly()
    (usual,) = begun
    assert 1e-6 * (1 - 1e-6) <= usual.tau_s <= 1e-2
    assert np.abs(usual.modulus(OMEGA) / far.modulus(OMEGA) - 1).max() < 0.1


class Springs(Effect):
    name = "springs"
    parameters = (
        EffectParameter("k", "N/m", 1e2, 1e8, 1e4, logarithmic=True, neutral=float("inf")),
        EffectParameter("slope", "1", -1.0, 1.0, 0.3),
    )

    def starts(self, plate, points):
        return [np.array([1e4, slope]) for slope in (0.5, -0.5)]


@pytest.mark.parametrize(
    ("stiff", "expected"), [(9e7, [[9e7, -0.5], [1e4, 0.5]]), (2e4, [[2e4, -0.5]]), (4e3, [[4e3, -0.5]])]
)
def test_of_springs_that_a_linear_step_makes_decades_stiffer_the_soft_ones_are_heard_too(
    monkeypatch, stiff, expected
):
    problem = SimpleNamespace(plate=None, points=None)
    starts = [(9.0, np.array([stiff, -0.5])), (0.1, np.array([3 * stiff, 0.5]))]
    monkeypatch.setattr(
        CandidateFit, "followed", lambda _, start: SimpleNamespace(chi2=-start[0], u=start[1])
    )
    found = CandidateFit(problem, None, None, Springs(), starts).fit_near()
    assert [f.u.tolist() for f in found] == expected


@pytest.mark.parametrize(("promising", "begun"), [(0.1, [0.1]), (0.3, [0.1, 0.3])])
def test_the_first_start_is_not_followed_again_where_it_is_the_most_promising_one(
    monkeypatch, promising, begun
):
    one = CandidateFit(None, None, None, TwoForms(), [(9.0, np.array([promising, 0.0]))])
    one.problem = SimpleNamespace(plate=None, points=None)
    monkeypatch.setattr(TwoForms, "starts", lambda *_: [np.array([0.1, 0.0])])
    monkeypatch.setattr(CandidateFit, "_wide", lambda _, u: [SimpleNamespace(chi2=u[0])])
    assert [f.chi2 for f in one.fit_far()] == begun


def test_of_places_those_are_followed_in_wide_valleys_that_come_furthest_in_a_few_steps(monkeypatch):
    """What promises most by a linear step from a wrong law need not be the place."""
    promised = [(9.0 - k, np.array([0.1, x, 0.0])) for k, x in enumerate((0.5, 0.9, 0.1, 0.3, 0.7))]
    one = CandidateFit(PROBLEM, None, None, Placed(), promised)
    followed = []

    def fitted(law, u, *, brief):
        assert brief
        return SimpleNamespace(chi2=abs(u[1] - 0.2), effects=(), law=law, u=u, stated=0)

    monkeypatch.setattr(CandidateFit, "fit_plain", lambda _: [])
    monkeypatch.setattr(CandidateFit, "_first_start", promised[0][1])
    monkeypatch.setattr(CandidateFit, "_laws", (USUAL,))
    monkeypatch.setattr(
        CandidateFit, "_in_wide_valley", lambda _, law, u, *, brief: fitted(law, u, brief=brief)
    )
    monkeypatch.setattr(
        candidates, "in_wide_valley", lambda *args: followed.append(args[-1][1]) or SimpleNamespace(chi2=0.0)
    )
    assert len(one.fit_far()) == 2
    assert sorted(followed) == [0.1, 0.3]
