"""What is said beside one law over temperatures."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from shear_pair_temperatures import alone, fitted, shifted

from fitting.effects import CATALOGUE
from fitting.identification.adjusted import Adjusted
from fitting.identification.doubt import doubts_among
from fitting.identification.result import LawBand
from fitting.temperature.simple import judge
from fitting.temperature.thermometers import Misread
from instrument.temperatures.shifted import Shifted

F_HZ = np.geomspace(50, 4000, 5)


@pytest.fixture(scope="module")
def fit_and_each():
    return fitted(shifted())[1:]


def made(fit_and_each, **said):
    fit, each = fit_and_each
    G, eta = fit.law.storage_and_loss(2 * np.pi * F_HZ)
    band = LawBand(F_HZ, G, eta, 0.01 * G, 0.01 * eta)
    return Shifted(fit, judge(fit), band, alone(each), None, 2.0, **said)


def moved(pull):
    return (Adjusted("held_width", 0.0, 0.7, 0.7 * pull, 0.3, pull, "mm"),)


def test_a_stated_number_that_was_moved_too_far_is_a_warning(fit_and_each):
    said = made(fit_and_each, adjusted=moved(-4.7)).warnings
    (doubt,) = doubts_among(said)
    assert "held_width by -4.7 standard deviations" in doubt


def test_one_that_stays_within_its_tolerance_is_none(monkeypatch, fit_and_each):
    monkeypatch.setitem(vars(fit_and_each[0]), "stated_covariance", np.array([[0.2]]))
    assert not any("moved" in one for one in made(fit_and_each, adjusted=moved(0.1)).warnings)


def test_a_law_that_stands_only_beside_a_cause_says_so(fit_and_each):
    """The material may as well not be simple: then its narrow band means nothing."""
    effect = CATALOGUE["channel_delay"]
    one = SimpleNamespace(of=lambda e: np.array([q.typical for q in e.parameters]))
    cause = SimpleNamespace(effect=effect, fit=SimpleNamespace(one=one))
    plain = made(fit_and_each)
    maybe = replace(plain, cause=cause, verdict=replace(plain.verdict, simple=None))
    assert any(said.startswith("this law stands only where") for said in maybe.warnings)
    assert not any("this law stands only where" in said for said in plain.warnings)


def test_a_cause_that_a_few_modes_ask_for_is_doubted(fit_and_each):
    """A textbook's formula, taken for a clamped beam, fits beside a core 5.6 times as stiff at the root."""
    effect = CATALOGUE["graded_core"]
    one = SimpleNamespace(of=lambda e: np.array([q.typical for q in e.parameters]))
    cause = SimpleNamespace(effect=effect, fit=SimpleNamespace(one=one))
    of_sweeps = replace(made(fit_and_each), cause=cause)
    of_tables = replace(of_sweeps, predicted_modes=(np.array([80.0, 500.0]), np.array([0.1, 0.2])))
    assert of_sweeps.verdict.simple
    assert not any("stands only where" in one for one in doubts_among(of_sweeps.warnings))
    assert any("stands only where" in one for one in doubts_among(of_tables.warnings))


def suspect(stated_c, by_others_c):
    return SimpleNamespace(stated_c=stated_c, by_others_c=by_others_c)


def test_temperatures_that_may_be_wrong_are_a_doubt_with_what_the_others_make_of_each(
    monkeypatch, fit_and_each
):
    def doubt(*suspects):
        monkeypatch.setitem(vars(fit_and_each[0]), "suspects", list(suspects))
        (said,) = [one for one in doubts_among(made(fit_and_each).warnings) if "farther from" in one]
        return said

    assert "as if one were stated wrongly: 7.7 degC (4.4 by the others): check" in doubt(suspect(7.7, 4.4))
    both = doubt(suspect(7.7, 4.4), suspect(14.15, 15.7))
    assert (
        "7.7 degC (4.4 by the others) or 14.15 degC (15.7 by the others) (these data do not tell which)"
        in both
    )
    monkeypatch.setitem(vars(fit_and_each[0]), "suspects", [])
    assert not any("farther from" in one for one in made(fit_and_each).warnings)


def test_a_free_factor_off_the_curve_of_the_others_is_a_doubt(monkeypatch, fit_and_each):
    wrong = Misread(1, 20.0, 23.5, 0, (Misread(2, 30.0, 26.0),))
    plain = made(fit_and_each)
    assert not any("free factors" in one for one in plain.warnings)
    monkeypatch.setattr("instrument.temperatures.shifted.off_any_curve", lambda fit: wrong)
    (said,) = [one for one in doubts_among(made(fit_and_each).warnings) if "free factors" in one]
    assert "stated wrongly: 20 degC (23.5 by the others) or 30 degC (26.0 by the others): check" in said
