"""Causes that a law imitates: a shear pair's mass, and effects whose readings are made by hand."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from shear_pair_problem import GAIN, MASS

from fitting.diagnosis.verdict.confounded import hides, in_light_of_the_law, last_word
from fitting.diagnosis.verdict.judgement import Judgement
from fitting.effects.base import Effect, EffectParameter
from fitting.laws.constant import ConstantModulus


def test_a_mass_of_a_shear_pair_hides_in_its_law_and_a_gain_does_not(clean):
    none = Judgement("none", None, {})
    settled = in_light_of_the_law(clean.search(MASS, GAIN), none)
    assert settled.verdict == "ambiguous"
    assert settled.equivalent == {"added_mass": ("added_mass", "none")}
    assert settled.accepted.fitted.of(MASS) == pytest.approx([0.0])
    assert "added_mass cannot be told from the core's modulus" in settled.note
    assert in_light_of_the_law(clean.search(GAIN), none) is none


def test_a_verdict_other_than_none_is_left_as_it_is(clean):
    named = Judgement("effect", None, {})
    assert in_light_of_the_law(clean.search(MASS), named) is named


LIKE = EffectParameter("size", "1", -1.0, 1.0, 0.1, spread=0.1)
"""As the law's first parameter, so large."""


def hidden(parameter, column, J_law=100.0):
    """Whether one effect hides whose readings move like `column`; the law's own two move one reading each."""
    law = ConstantModulus(1e6, 0.5)
    effect = type("Any", (Effect,), {"name": "any", "parameters": parameter})()
    J = np.column_stack([J_law * np.eye(3)[:, :2], column])
    none = SimpleNamespace(law=law, covariance=np.eye(2) / J_law**2)
    return hides(none, SimpleNamespace(effects=(effect,), jacobian=J), 2 * np.pi * np.array([10.0, 20.0]))


def test_hidden_is_what_leaves_nothing_and_moves_the_law_beyond_its_error():
    assert hidden((LIKE,), [100.0, 0.0, 0.0])
    # The law does not follow where only the effect is seen, by ten standard deviations.
    assert not hidden((LIKE,), [100.0, 0.0, 100.0])
    # It follows a thousandth of it, within its own error.
    assert not hidden((LIKE,), [1.0, 0.0, 0.0])


def test_only_an_effect_of_one_size_can_be_asked_whether_it_hides():
    place = EffectParameter("x", "m", 0.0, 1.0, 0.1, neutral=None)
    assert not hidden((replace(LIKE, neutral=None),), [100.0, 0.0, 0.0])
    assert not hidden((replace(LIKE, logarithmic=True),), [100.0, 0.0, 0.0])
    assert not hidden((LIKE, place), [100.0, 0.0, 0.0])


def test_of_a_mass_on_rubber_the_law_has_the_last_word_and_of_plates_it_has_not():
    assert last_word({"shear-pair"}) is in_light_of_the_law
    assert last_word({"plate"}) is None
    assert last_word({"beam"}) is None
