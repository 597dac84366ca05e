"""A wrong temperature among right ones: which sweep it is, what it should be, and when nothing is said."""

from types import SimpleNamespace

import numpy as np
import pytest

from fitting.temperature.shifts import Shift
from fitting.temperature.thermometers import each_its_own, misread, off_any_curve, rising

T = np.array([0.0, 10.0, 20.0, 30.0, 40.0])
FORMS = {"wlf": np.array([9.0, 110.0]), "arrhenius": np.array([1.2e5])}


def own(log_a, error=0.01):
    return SimpleNamespace(log_shift=log_a, sweeps_log_shift_errors=np.full(len(log_a), error))


def factors(kind, true_c, reference=20.0):
    """As sweeps of these true temperatures have them, from the second on."""
    log_a = Shift(kind, T, reference).log_shift(FORMS[kind], np.asarray(true_c))
    return log_a - log_a[1]


@pytest.mark.parametrize("kind", FORMS)
@pytest.mark.parametrize(("k", "true_c"), [(2, 40.0), (4, 55.0), (0, 12.0)])
def test_the_sweep_whose_temperature_is_wrong_is_named_with_its_own(kind, k, true_c):
    true = T.copy()
    true[k] = true_c
    found = misread(Shift(kind, T, 20.0, 0.3), own(factors(kind, true)))
    assert found.sweep == k
    assert found.stated_c == T[k]
    assert found.read_c == pytest.approx(true_c, abs=0.5)


def test_right_temperatures_too_few_and_two_wrong_ones_name_nobody():
    assert misread(Shift("wlf", T, 20.0, 0.3), own(factors("wlf", T))) is None
    assert (
        misread(Shift("wlf", T, 20.0, 0.3), own(factors("wlf", T + np.array([12.0, 0.0, -15.0, 0.0, 9.0]))))
        is None
    )
    few = own(factors("wlf", T + np.array([0.0, 0.0, 0.0, 20.0, 0.0]))[:4])
    assert misread(Shift("wlf", T[:4], 20.0, 0.3), few) is None
    assert (
        misread(Shift("free", T, 20.0, 0.3), own(factors("wlf", T + np.array([0.0, 0.0, 20.0, 0.0, 0.0]))))
        is None
    )


@pytest.mark.parametrize("kind", FORMS)
@pytest.mark.parametrize("k", [1, 2, 4])
def test_of_free_factors_one_that_lies_off_the_curve_of_the_others_is_named(kind, k):
    """The second is the reference here: its own error is in all other factors alike."""

    def free(true_c, kind_said="free"):
        of_form = own(factors(kind, true_c))
        of_form.shift = Shift(kind_said, T, 10.0, 0.3)
        return of_form

    off = T.copy()
    off[k] += 8.0
    found = off_any_curve(free(off))
    assert found.stated_c == T[k]
    assert found.read_c == pytest.approx(T[k] + 8.0, abs=0.7)
    assert off_any_curve(free(T)) is None
    assert off_any_curve(free(off, "wlf")) is None


def test_specimens_that_were_wrong_together_are_named_by_the_first_of_them():
    two, true = np.tile(T, 2), np.tile(T, 2)
    true[[3, 8]] = 18.0
    log_a = Shift("wlf", two, 20.0).log_shift(FORMS["wlf"], true)
    found = misread(Shift("wlf", two, 20.0, 0.3), own(log_a - log_a[0]))
    assert (found.sweep, found.further, found.stated_c) == (3, 1, 30.0)
    assert found.read_c == pytest.approx(18.0, abs=0.5)


def test_every_sweep_has_a_factor_of_its_own_two_of_one_temperature_too():
    shift = each_its_own(Shift("wlf", np.array([10.0, 20.0, 20.0]), 20.0, 0.3))
    assert shift.kind == "free"
    assert len(shift.names) == 2
    assert not shift.moves_temperatures


def test_a_factor_that_rises_with_the_temperature_is_seen():
    shift = Shift("free", np.array([0.0, 10.0, 40.0, 30.0]), 10.0)
    assert rising(shift, np.array([2.5, 0.0, -2.1, -3.8])) == (30.0, 40.0)
    assert rising(shift, np.array([2.5, 0.0, -3.9, -3.8])) is None


def test_a_factor_that_rises_by_no_more_than_its_error_is_not():
    shift = Shift("free", np.array([0.0, 10.0, 40.0, 30.0]), 10.0)
    log_a = np.array([2.5, 0.0, -2.1, -2.2])
    assert rising(shift, log_a, np.full(4, 0.05)) == (30.0, 40.0)
    assert rising(shift, log_a, np.full(4, 0.08)) is None


def test_what_shares_a_free_factor_may_be_a_little_warmer_or_colder_and_what_has_its_own_may_not():
    shared = Shift("free", np.array([10.0, 10.0, 20.0, 40.0]), 20.0, 0.3)
    assert shared.moves_temperatures
    assert not Shift("free", np.array([10.0, 20.0, 40.0]), 20.0, 0.3).moves_temperatures
    p = np.array([2.0, -3.0])
    moved = shared.log_shift(p, np.array([9.0, 11.0, 20.0, 42.0]))
    np.testing.assert_allclose(moved, [2.2, 1.8, 0.0, -3.3])
    np.testing.assert_allclose(shared.by_temperature(p, shared.temperature_c), [-0.2, -0.2, -0.175, -0.15])


def test_what_leaves_about_as_little_is_named_beside_and_what_leaves_far_more_is_not():
    """Of seven one near an end is 6 K off: at first by little beside the errors, then plainly."""
    seven = np.linspace(-10.0, 50.0, 7)
    true = seven.copy()
    true[0] -= 6.0
    form = Shift("wlf", seven, 20.0, 0.3)
    log_a = form.log_shift(FORMS["wlf"], true)
    scattered = misread(form, own(log_a - log_a[3], 0.11))
    assert {one.sweep for one in (scattered, *scattered.rivals)} == {0, 1}
    plain = misread(form, own(log_a - log_a[3], 0.02))
    assert (plain.sweep, plain.rivals) == (0, ())
    assert plain.read_c == pytest.approx(-16.0, abs=0.5)
