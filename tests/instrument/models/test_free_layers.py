"""Where G' of a free layer is hardly known, its loss factor may be far larger than its error says."""

from dataclasses import replace

import numpy as np
import pytest
from beam_tables import BEAM

from fitting.laws.constant import ConstantModulus
from instrument.models.free_layers import remark_on_free_layers

LAW = ConstantModulus(2e8, 0.1)
FREE = replace(BEAM, constraining=None)
BAND_HZ = (30.0, 2000.0)


def covariance(storage, loss):
    """Of ln G' and ln eta, the errors of ln G' and ln G'' being independent."""
    return np.array([[storage**2, -(storage**2)], [-(storage**2), storage**2 + loss**2]])


def said(storage, loss, specimen=FREE):
    return remark_on_free_layers([specimen], LAW, covariance(storage, loss), BAND_HZ)


def test_a_loss_factor_that_may_be_much_larger_is_told_with_the_factor_and_what_to_do():
    (words,) = said(0.25, 0.05)
    assert "G' of a free layer is hardly known: at 30 Hz to 25 %, G'' to 5 %" in words
    assert "2 times as large, 0.2 and not 0.1" in words
    assert "a thicker layer, thinner metal, or the metal's stiffness measured bare" in words


def test_a_storage_modulus_that_may_be_nothing_gives_no_factor():
    (words,) = said(0.6, 0.1)
    assert "is more than 5 times as large as 0.1" in words


@pytest.mark.parametrize(("storage", "loss"), [(0.1, 0.02), (0.25, 0.2)])
def test_nothing_is_said_where_it_is_known_well_or_no_worse_than_the_loss_modulus(storage, loss):
    assert said(storage, loss) == ()


def test_nothing_is_said_of_a_constrained_core_or_of_errors_that_are_not_known():
    assert said(0.25, 0.05, BEAM) == ()
    assert said(np.nan, np.nan) == ()
