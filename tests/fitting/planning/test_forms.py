"""Forms of an explanation that a fit does not choose between by moving."""

from types import SimpleNamespace

import numpy as np
import pytest

from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.several.of_files import EACH, OfFiles
from fitting.effects import CATALOGUE
from fitting.planning import forms
from fitting.planning.forms import forms_of

LINE, CLAMP = CATALOGUE["clamp_line"], CATALOGUE["clamp_compliance"]
RIVALS = SimpleNamespace(problem=SimpleNamespace(plate=None, points=None), evidence=None, temper=1.0)
STATED = [0.3, -0.2]


def fitted(effect, *u):
    each, nothing = np.array([*STATED, *u]), np.empty(0)
    free = np.ones(len(each), bool)
    return Refitted((effect,), None, each, nothing, nothing, nothing, 0, free, len(STATED), True)


@pytest.fixture
def costs(monkeypatch):
    """Of a form, by its last free choice; a fit moves nothing."""
    by_choice = {0.0: 11.0, 1.0: 10.0}
    monkeypatch.setattr(
        forms, "polished", lambda problem, effects, evidence, law, u: fitted(effects[0], *u[2:])
    )
    monkeypatch.setattr(forms, "cost", lambda f, plate, temper: by_choice[f.u[3]])
    return by_choice


def test_a_clamp_line_may_have_had_the_spot_measured_from_it_or_not(costs):
    one = fitted(LINE, 2e-3, 1.0)
    (first, p), (other, q) = forms_of(RIVALS, one)
    assert first is one
    assert other.u.tolist() == [*STATED, 2e-3, 0.0]
    assert (p / q, p + q) == (pytest.approx(np.exp(0.5)), pytest.approx(1.0))


def test_what_fits_far_worse_is_no_form_to_reckon_with(costs):
    costs[0.0] = 30.0
    one = fitted(LINE, 2e-3, 1.0)
    assert forms_of(RIVALS, one) == [(one, 1.0)]


def test_in_every_mounting_it_was_measured_the_same_way(costs):
    one = fitted(OfFiles(LINE, 2, EACH), 2e-3, 1.0, 2.2e-3, 1.0, EACH)
    _, (other, _) = forms_of(RIVALS, one)
    assert other.u[2:].tolist() == [2e-3, 0.0, 2.2e-3, 0.0, EACH]


def test_what_a_fit_moves_has_one_form():
    one = fitted(CLAMP, 5e13)
    assert forms_of(RIVALS, one) == [(one, 1.0)]
