"""Phasors and amplitudes beside predictions."""

import numpy as np
import pytest

from fitting.data.readings import Readings

V = np.array([3 + 4j, -1 + 1j, 0.2j])
DV = np.array([[0.1 - 0.2j, 0.3j, 0.1], [1.0, -0.5j, 0.2 + 0.1j]])


def test_a_phasor_is_two_data_and_an_amplitude_is_one():
    both, size = Readings(V), Readings(np.abs(V))
    assert (both.has_phase, both.count) == (True, 6)
    assert (size.has_phase, size.count) == (False, 3)
    assert both.data(V).tolist() == [3, -1, 0, 4, 1, 0.2]
    assert both.data(DV).shape == (2, 6)
    assert size.data(np.abs(V)).tolist() == np.abs(V).tolist()


def test_amplitudes_are_compared_with_the_size_of_what_is_predicted():
    assert Readings(V).off(2 * V).tolist() == V.tolist()
    assert Readings(np.abs(V)).off(-2j * V) == pytest.approx(np.abs(V))


def test_an_amplitude_changes_as_a_small_step_of_the_phasor_does():
    h = 1e-6
    difference = (np.abs(V + h * DV) - np.abs(V - h * DV)) / (2 * h)
    np.testing.assert_allclose(Readings(np.abs(V)).changes(V, DV), difference, rtol=1e-8)
    assert Readings(V).changes(V, DV) is DV


def test_data_of_some_points_are_both_parts_of_each():
    some = np.array([True, False, True])
    both, size = Readings(V), Readings(np.abs(V))
    assert both.data(V)[both.which(some)].tolist() == both.take(some).data(V[some]).tolist()
    assert both.each(np.arange(3.0)).tolist() == [0, 1, 2, 0, 1, 2]
    assert size.which(some).tolist() == some.tolist()
    assert size.take(np.array([2])).count == 1
