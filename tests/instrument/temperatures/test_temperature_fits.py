"""The fits that one law over temperatures may need, of a shear pair's sweeps."""

from dataclasses import replace

import numpy as np
import pytest
from shear_pair_temperatures import LOG_A, PAIR, REFERENCE, T, begun, shifted

from fitting.laws import LAWS
from fitting.temperature.shifts import Shift
from fitting.temperature.simple import in_doubt
from instrument.progress import quiet
from instrument.temperatures.members import AtTemperature, Members
from instrument.temperatures.temperature_fits import TemperatureFits


def fits(laws, at_c=T, kind="free"):
    sweeps = [begun(k % len(T), law).problem.sweep for k, law in enumerate(laws)]
    every = [AtTemperature(s, t, f"{t:g}.csv") for s, t in zip(sweeps, at_c, strict=True)]
    return TemperatureFits(Members(every, [PAIR]), Shift(kind, np.array(at_c), REFERENCE), False, quiet)


@pytest.fixture(scope="module")
def simple():
    of = fits(shifted())
    return of, *of.fitted(with_effects=False)


def test_each_temperature_is_fitted_by_itself_and_then_all_under_one_law(simple):
    _, alone, problem, fit = simple
    assert len(alone) == len(T)
    assert problem.joined.lengths == tuple(len(a.frequency_hz) for a in alone)
    assert not in_doubt(fit)
    assert np.all(np.abs(fit.log_shift - LOG_A) < 3.5 * fit.log_shift_errors + 1e-9)


def test_a_law_that_serves_is_let_bend_no_further(simple):
    of, _, problem, fit = simple
    assert of.freer(problem, fit) is fit


def test_free_factors_of_single_sweeps_are_no_other_fit_apart_and_sweeps_have_no_columns(simple):
    of, alone, *_ = simple
    assert of.each_apart(alone) is None
    assert of.read_otherwise(alone) == ""


def test_a_temperature_that_two_sweeps_share_by_mistake_has_a_factor_for_each_when_they_are_apart():
    of = fits(shifted(), (10.0, 20.0, 20.0))
    alone, _, fit = of.fitted(with_effects=False)
    assert in_doubt(fit)
    apart = of.each_apart(alone)
    assert not in_doubt(apart)
    assert apart.log_shift[2] - apart.log_shift[1] == pytest.approx(LOG_A[2] - LOG_A[1], abs=0.05)


def test_another_material_at_one_temperature_stays_in_doubt_however_far_its_law_bends():
    cold, middle, warm = shifted()
    other = LAWS["fractional-zener"](1e6, 9e6, 2e-3, 0.9)
    of = fits([cold, middle, replace(warm, law=other)])
    _, problem, fit = of.fitted(with_effects=False)
    assert in_doubt(fit)
    assert in_doubt(of.freer(problem, fit))


def test_one_sweep_of_another_material_is_the_odd_one():
    laws = shifted()
    other = replace(laws[1], law=LAWS["fractional-zener"](1e6, 9e6, 2e-3, 0.9))
    of = fits([*laws, other], (*T, T[1]))
    alone, _, fit = of.fitted(with_effects=False)
    assert in_doubt(fit)
    (odd,) = of.odd_ones(alone)
    assert odd.place == 3
    assert odd.p_value > 0.01
    # Of three sweeps any two may go together.
    assert of.odd_ones(alone[:3]) == []


def test_sweeps_at_one_temperature_cannot_say_that_another_one_is_odd():
    """Left to themselves they go together whatever the material is."""
    laws = shifted()
    other = replace(laws[0], law=LAWS["fractional-zener"](1e6, 9e6, 2e-3, 0.9))
    of = fits([laws[1], laws[1], laws[1], other], (T[1], T[1], T[1], T[0]))
    alone, *_ = of.fitted(with_effects=False)
    assert of.odd_ones(alone) == []
