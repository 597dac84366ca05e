"""A core that is another one in one file."""

import numpy as np
import pytest
from shear_pair_cases import LAW

from fitting.diagnosis.several.between_files import BetweenFiles
from fitting.diagnosis.several.effect_among_files import among
from fitting.effects import CATALOGUE
from fitting.effects.core_difference import CoreDifferenceEffect
from fitting.effects.given import ModulusAt, Points

EFFECT = CoreDifferenceEffect()
OMEGA = 2 * np.pi * np.geomspace(20, 400, 7)
POINTS = Points(OMEGA, np.ones(7), np.arange(7.0), True, True, "absolute")


def test_storage_and_loss_factor_are_each_another_one():
    found = EFFECT.modulus(ModulusAt(LAW, POINTS, None), POINTS, np.array([0.2, -0.1]))
    G, eta = LAW.storage_and_loss(OMEGA)
    assert found.real == pytest.approx(1.2 * G)
    assert found.imag / found.real == pytest.approx(0.9 * eta)


def test_it_lies_between_files_of_specimens_that_are_not_one():
    assert isinstance(among(EFFECT, 3, ()), BetweenFiles)
    assert among(EFFECT, 3, ()).objection(POINTS, None) is None
    # One plate that is measured again has one core, whatever its temperature is.
    alone = "it lies between files, and there is one"
    assert among(EFFECT, 3, (), one_plate=True).objection(POINTS, None) == alone
    assert among(EFFECT, 1, ()).objection(POINTS, None) == alone
    warmer = CATALOGUE["temperature_difference"]
    assert among(warmer, 3, (), one_plate=True).objection(POINTS, None) is None


def test_pads_are_the_same_under_other_masses():
    assert EFFECT.on("shear-pair") is None
    assert EFFECT.on("beam") is EFFECT


def test_it_says_which_way():
    said = EFFECT.story({"stiffer": 0.203, "lossier": -0.05})
    assert said == "the core is another one: G' +20 %, loss factor -5 %"
