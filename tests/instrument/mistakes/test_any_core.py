"""The nearest core of data, up to a factor or not."""

import numpy as np
import pytest
import shear_pair_cases

from fitting.errors import OutsideModel
from fitting.stated.layers import Face
from fitting.structures.beam import Beam
from instrument.mistakes.any_core import FURTHEST, any_core
from instrument.mistakes.response_mistakes import response_of
from instrument.progress import quiet

PAIR = shear_pair_cases.pair(0.573)
SWEEP = shear_pair_cases.sweep(PAIR)
MODEL = any_core(PAIR, SWEEP.frequency_hz, quiet)


def test_the_nearest_core_is_that_of_the_data():
    found = MODEL.nearest(response_of(SWEEP), has_phase=True, free=False)
    assert found.distance < 0.02
    at = shear_pair_cases.LAW.modulus(np.array([MODEL.middle]))[0]
    np.testing.assert_allclose(10 ** found.core[0], at.real, rtol=0.05)
    np.testing.assert_allclose(np.exp(found.core[2]), at.imag / at.real, rtol=0.1)


def test_a_factor_is_found_where_it_is_asked_for():
    read = 30j * response_of(SWEEP)
    assert MODEL.nearest(read, has_phase=True, free=False).distance > 0.5
    found = MODEL.nearest(read, has_phase=True, free=True)
    assert found.distance < 0.02
    np.testing.assert_allclose(found.factor, 30j, atol=1.0)


def test_points_that_are_lost_count_no_more_than_they_may():
    read = response_of(SWEEP).copy()
    read[::10] *= 1e9
    found = MODEL.nearest(read, has_phase=True, free=False)
    assert found.distance < 0.02 + 0.1 * FURTHEST


def test_amplitudes_are_judged_without_a_phase():
    read = np.abs(response_of(SWEEP))
    assert MODEL.nearest(read, has_phase=False, free=False).distance < 0.02


def test_a_bare_beam_has_no_core():
    face = Face(2e-3, 70e9, 0.3, 2700.0)
    with pytest.raises(OutsideModel, match="no core"):
        any_core(Beam(0.2, 0.02, "clamped-free", face, pickup_m=0.1), np.array([20.0, 30.0]), quiet)
