"""Coefficients of a plate's parts as functions of its stated numbers."""

import numpy as np
import pytest

from fitting.nuisances.nuisance import Nuisance
from fitting.nuisances.stated_coefficients import PlateCoefficients
from fitting.plate.parts import coefficients
from fitting.stated.tolerances import STATED

NAMES = ("gain", "substrate_young", "core_thickness", "length")


@pytest.fixture
def stated(zn1):
    return PlateCoefficients(tuple(Nuisance(n, n, STATED[n].typical) for n in NAMES), zn1, zn1)


def test_as_stated_they_are_those_of_the_specimen(stated, zn1):
    np.testing.assert_array_equal(stated.at(np.zeros(4)), coefficients(zn1, zn1).all)
    assert not stated.change(np.zeros(4)).any()


def test_numbers_of_the_channel_move_none(stated):
    assert [NAMES[k] for k in stated.moving] == ["substrate_young", "core_thickness", "length"]
    assert not stated.change(np.array([3.0, 0.0, 0.0, 0.0])).any()


def test_they_are_those_of_the_moved_specimen(stated, zn1):
    z = np.array([0.0, 1.0, -2.0, 0.5])
    moved = stated.moved_specimen(z)
    assert moved.substrate.young_pa == pytest.approx(zn1.substrate.young_pa * np.exp(0.01))
    np.testing.assert_array_equal(stated.at(z), coefficients(moved, zn1).all)


def test_derivatives_are_exact_as_stated_and_followed_to_second_order_elsewhere(stated):
    np.testing.assert_array_equal(stated.by(np.zeros(4)), stated.by_there(np.zeros(4)))
    z = np.array([0.0, 1.0, -2.0, 1.0])
    exact, near, first = stated.by_there(z), stated.by(z), stated.by(np.zeros(4))
    assert np.abs(near - exact).max() < 0.1 * np.abs(first - exact).max()
