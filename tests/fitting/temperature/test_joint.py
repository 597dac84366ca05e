"""One law shifted, fitted to a shear pair's sweeps of three temperatures at once."""

from dataclasses import replace

import numpy as np
import pytest
import shear_pair_cases as cases
from shear_pair_temperatures import LOG_A, POINTS, REFERENCE, T, begun, fitted, shifted

from fitting.laws.bent_law import BentLaw
from fitting.temperature.joint import TemperatureProblem
from fitting.temperature.shifted_fit import ShiftedFit
from fitting.temperature.shifts import Shift
from fitting.temperature.sweeps import Sweeps


@pytest.fixture(scope="module")
def found():
    return fitted(shifted())


def unlike():
    """Laws of temperatures that no shift lays over each other."""
    law = cases.LAW
    return [law.with_values(law.values * np.array([1.0, 1.0, 1.0, 0.6])), law, law]


@pytest.fixture(scope="module")
def apart():
    return fitted(unlike())[1]


def test_shifts_and_the_law_at_the_reference_are_found_within_their_errors(found):
    _, fit, _ = found
    assert isinstance(fit, ShiftedFit)
    assert fit.converged
    assert fit.log_shift[1] == fit.log_shift_errors[1] == 0.0
    off = (fit.log_shift - LOG_A)[[0, 2]] / fit.log_shift_errors[[0, 2]]
    assert (np.abs(off) < 3).all()
    assert (fit.log_shift_errors[[0, 2]] < 0.02).all()
    np.testing.assert_allclose(fit.parameter_errors, fit.log_shift_errors[[0, 2]], rtol=1e-3)
    law_off = np.log(fit.law.values / cases.LAW.values) / np.sqrt(np.diag(fit.law_covariance))
    assert (np.abs(law_off) < 3.5).all()


def test_a_simple_material_s_one_law_fits_as_well_as_many(found):
    _, fit, _ = found
    assert fit.chi2_own <= fit.chi2
    # Twelve parameters of three laws against four and two shifts.
    assert fit.degrees == pytest.approx(6.0, abs=0.1)
    assert fit.p_value > 0.01


def test_each_temperature_s_own_law_is_its_true_one(found):
    _, fit, _ = found
    omega = 2 * np.pi * np.array([200.0, 600.0])
    for k, law in enumerate(shifted()):
        np.testing.assert_allclose(fit.own_law(k).modulus(omega), law.modulus(omega), rtol=0.02)


def test_what_no_shift_explains_has_no_chance(apart):
    assert apart.p_value < 1e-6
    assert apart.chi2 > apart.chi2_own + 50


def test_a_law_for_each_that_is_stuck_begins_again_from_the_one_law(found):
    problem, fit, _ = found
    stuck = replace(fit.own, residuals=10 * fit.own.residuals)
    again = problem.both(fit.one, stuck)
    assert stuck.chi2 > fit.chi2
    assert again.chi2_own == pytest.approx(fit.chi2_own, abs=0.3)
    assert problem.both(fit.one, fit.own).own is fit.own


def test_vertical_shifts_are_each_temperature_s_own_but_the_reference_s():
    _, fit, _ = fitted(shifted((1.1, 1.0, 0.95)), vertical=True)
    assert fit.log_vertical[1] == 0.0
    off = (fit.log_vertical - np.log([1.1, 1.0, 0.95]))[[0, 2]]
    assert (np.abs(off) < 3.5 * fit.log_vertical_errors[[0, 2]]).all()
    assert (fit.log_vertical_errors[[0, 2]] > 0).all()


def test_without_vertical_shifts_none_is_said(found):
    _, fit, _ = found
    assert not fit.log_vertical.any()
    assert not fit.log_vertical_errors.any()


@pytest.mark.parametrize(("laws", "least", "most"), [(shifted, 1e-2, 1.0), (unlike, 0.0, 1e-6)])
def test_where_the_noise_is_unknown_a_law_for_each_says_what_it_is(laws, least, most):
    _, fit, _ = fitted(laws(), known=False)
    assert not fit.noise_known
    assert least <= fit.p_value <= most


def test_sweeps_stand_one_after_the_other_with_their_own_errors(found):
    task, _, begun_each = found
    each = [b.evidence for b in begun_each]
    assert task.points == POINTS
    assert len(task.evidence.measured_m_s) == sum(POINTS)
    total = sum(POINTS)
    np.testing.assert_array_equal(task.evidence.sigma_m_s[30:55], each[1].sigma_m_s)
    B, start = task.evidence.B, each[0].B.shape[1]
    second = np.r_[30:55, total + 30 : total + 55]
    own = slice(start, start + each[1].B.shape[1])
    np.testing.assert_array_equal(B[second][:, own], each[1].B)
    # What errs in one sweep says nothing of another.
    assert not np.delete(B[:, own], second, axis=0).any()


def test_what_sweeps_say_of_one_plate_is_their_mean_and_a_channel_s_own_stays():
    pair = cases.pair(0.2533)
    each = [begun(k, law, pair=pair) for k, law in enumerate(shifted())]
    task = TemperatureProblem(Sweeps.of(each), Shift("free", T, REFERENCE), vertical=False)
    names = [n.name for n in task.joined.each]
    each = [np.full(len(at), float(k)) for k, at in enumerate(task.joined.places)]
    said = dict(zip(names, task.stated(each), strict=True))
    assert said["mass"] == said["core_thickness"] == 1.0
    assert sorted(v for n, v in said.items() if n.startswith("gain")) == [0.0, 1.0, 2.0]


def test_a_law_bends_where_the_specimen_is_not_exact_over_all_reduced_frequencies():
    pair = cases.pair(0.2533)
    each = [begun(k, law, pair=pair) for k, law in enumerate(shifted())]
    task = TemperatureProblem(Sweeps.of(each), Shift("free", T, REFERENCE), vertical=False)
    start = task.one_law([b.none.law for b in each])
    assert isinstance(start.law, BentLaw)
    np.testing.assert_allclose(start.log_shift, LOG_A, atol=0.3)
    a = np.exp(start.log_shift)
    reduced = [f * k for band, k in zip(task.bands_hz, a, strict=True) for f in band]
    assert start.law.knots_hz[0] <= 1.01 * min(reduced)
    assert start.law.knots_hz[-1] >= 0.99 * max(reduced)


def test_the_law_s_quantities_move_as_their_gradients_say_and_are_as_uncertain_as_the_law(found):
    _, fit, _ = found
    quantities = fit.quantities(np.array([20.0, 200.0]))
    task, x = quantities.task, quantities.task.mode
    slope = quantities.gradient(x)
    step = 1e-6 * np.random.default_rng(0).standard_normal(len(x))
    moved = quantities.logs(x + step) - quantities.logs(x - step)
    np.testing.assert_allclose(moved, 2 * slope @ step, rtol=1e-5)
    assert quantities.names[: len(fit.law.plain.names)] == list(fit.law.plain.names)
    own = len(quantities.names) - 4
    known = np.sqrt(np.diag(fit.law_covariance))[:own]
    np.testing.assert_allclose(np.linalg.norm(slope[:own] @ task.root, axis=1), known, rtol=1e-3)
    assert np.sum(task.residuals(x) ** 2) == pytest.approx(
        fit.chi2 / max(1.0, fit.one.chi2_per_dof), rel=1e-6
    )
