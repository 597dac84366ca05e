"""Which starts of an effect are followed beside a fit so far."""

from types import SimpleNamespace

import numpy as np

from fitting.diagnosis.candidates import CandidateFit
from fitting.effects.base import Effect, EffectParameter

SIZE = EffectParameter("size", "m", -1.0, 1.0, 0.1)
FORM = EffectParameter("form", "1", 0.0, 1.0, 0.0, neutral=None, fixed=True)
PLACE = EffectParameter("x", "m", 0.0, 1.0, 0.1, neutral=None)


class TwoForms(Effect):
    name, parameters = "two_forms", (SIZE, FORM)


class Placed(Effect):
    name, parameters = "placed", (SIZE, PLACE, FORM)


def followed(monkeypatch, effect, *starts):
    """The unknowns that rough fits begin at."""
    monkeypatch.setattr(CandidateFit, "_followed", lambda _, promise, u: SimpleNamespace(chi2=promise, u=u))
    known = [(promise, np.array(u)) for promise, u in starts]
    return [f.u.tolist() for f in CandidateFit(None, None, None, effect, known).near]


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
    monkeypatch.setattr(
        CandidateFit, "_rough", lambda _, law, u, evidence, *, brief: begun.append(u.tolist())
    )
    starts = (9.0, [0.3, 0.0]), (8.0, [0.2, 0.0]), (0.1, [0.1, 1.0])
    known = [(promise, np.array(u)) for promise, u in starts]
    CandidateFit(None, None, SimpleNamespace(law=None), TwoForms(), known).briefly()
    assert begun == [[0.3, 0.0], [0.1, 1.0]]
