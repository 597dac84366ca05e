"""A cause that all temperatures have in common: there only where the data ask for it."""

from types import SimpleNamespace

import numpy as np
import pytest
from shear_pair_temperatures import alone, fitted, shifted

from fitting.effects import CATALOGUE
from fitting.temperature.causes import Cause, causes_of, one_law_serves, without_any
from fitting.temperature.members import Joined
from fitting.temperature.sweeps import Sweeps

GAIN = CATALOGUE["gain_error"]


def join(begun) -> Joined:
    return Sweeps.of(list(begun))


@pytest.fixture(scope="module")
def data():
    return fitted(shifted())


@pytest.fixture(scope="module")
def found(data):
    """What a fit that was stuck is asked for: the data are clean."""
    problem, _, each = data
    stuck = SimpleNamespace(noise_known=True, own_chi2_per_dof=50.0)
    (cause,) = causes_of(alone(each), problem, stuck, [GAIN], join)
    return cause


def test_an_effect_that_clean_data_do_not_ask_for_is_no_cause_though_the_law_beside_it_serves(found):
    assert one_law_serves(found.fit)
    assert found.gain < 0
    assert not found.serves


def test_the_fit_that_came_off_where_it_was_stuck_is_kept_without_the_effect(data, found):
    bare = without_any([found])
    assert bare is found.without
    assert bare.one.effects == ()
    assert bare.chi2 == pytest.approx(data[1].chi2, rel=1e-3)


def with_size(value, *, converged=True, gain=20.0):
    errors = np.array([0.01])
    one = SimpleNamespace(
        converged=converged,
        effects=(GAIN,),
        u=np.array([value]),
        unknown_errors=lambda: errors,
        each=lambda: iter([(GAIN, slice(0, 1))]),
    )
    fit = SimpleNamespace(one=one, noise_known=True, own_chi2_per_dof=1.0, p_value=0.4)
    return Cause(GAIN, fit, 10.0, None, None, gain)


def test_a_cause_has_a_size_a_gain_and_a_fit_that_came_to_its_end():
    assert with_size(1.05).serves
    assert not with_size(1.005).serves
    assert not with_size(1.05, converged=False).serves
    assert not with_size(1.05, gain=-1.0).serves


def test_a_cause_may_serve_where_all_that_it_lacks_is_the_end_of_its_fit():
    assert with_size(1.05, converged=False).may_serve
    assert not with_size(1.05).may_serve
    assert not with_size(1.005, converged=False).may_serve
    assert not with_size(1.05, converged=False, gain=-1.0).may_serve
