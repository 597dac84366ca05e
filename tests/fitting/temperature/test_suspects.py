"""Which stated temperature a form cannot do with: told without another fit, as another fit would tell it."""

from types import SimpleNamespace

import numpy as np
import pytest

from fitting.temperature.shifts import Shift
from fitting.temperature.suspects import suspects_of, widened

T = np.array([5.0, 15.0, 25.0, 35.0, 45.0])
ERROR_K = 0.3
CURVED = 0.25


def fitted(off_k, noise=0.02, without=None):
    """A parabola through what temperatures read, each temperature moved beside what is stated of it.

    Parameters are those of the parabola, then the temperatures in standard deviations; `without` what is
    stated of one of them.
    """
    x = (T - 20.0) / 20.0
    true = np.array([0.0, -2.0, CURVED])
    slope = true[1] / 20.0 + 2 * true[2] * x / 20.0
    off = np.zeros(5) if off_k is None else np.asarray(off_k, float)
    # The data are of temperatures colder than stated by `off`.
    y = np.vander(x, 3, increasing=True) @ true - slope * off
    data = np.column_stack([np.vander(x, 3, increasing=True), np.diag(slope * ERROR_K)]) / noise
    J = np.vstack([data, np.column_stack([np.zeros((5, 3)), np.eye(5)])])
    b = np.append(y / noise, np.zeros(5))
    if without is not None:
        J, b = np.delete(J, 5 + without, 0), np.delete(b, 5 + without)
    p = np.linalg.lstsq(J, b, rcond=None)[0]
    one = SimpleNamespace(
        residuals=J @ p - b,
        effects=(),
        chi2_per_dof=0.5,
        noise_known=True,
        weighted=lambda: (J, np.ones(J.shape[1], bool)),
    )
    joint = SimpleNamespace(
        warmer=tuple(np.exp(p[3:])), off=p[3:], names=list(range(8)), shift=Shift("wlf", T, 20.0, ERROR_K)
    )
    return one, joint, p, np.linalg.inv(J.T @ J)


@pytest.mark.parametrize(("k", "by"), [(0, 4.0), (4, 6.0)])
def test_a_wrong_end_is_named_with_what_it_bends_and_its_neighbour_is_not_named_alone(k, by):
    off = np.where(np.arange(5) == k, by, 0.0)
    found = suspects_of(*fitted(off)[:2])
    assert k in [s.member for s in found]
    its = next(s for s in found if s.member == k)
    assert its.by_others_c == pytest.approx(T[k] - by, abs=0.3)
    assert len(found) > 1


def test_a_wrong_middle_one_is_named_alone_with_its_value():
    (only,) = suspects_of(*fitted([0.0, 0.0, 2.4, 0.0, 0.0])[:2])
    assert only.stated_c == 25.0
    assert only.by_others_c == pytest.approx(22.6, abs=0.1)


def test_right_temperatures_and_those_that_are_exact_are_not_suspected():
    assert suspects_of(*fitted([0.2, -0.3, 0.1, 0.3, -0.2])[:2]) == []
    one, joint, *_ = fitted(None)
    assert suspects_of(one, SimpleNamespace(**{**vars(joint), "warmer": (), "off": np.zeros(0)})) == []


def test_where_a_temperature_is_as_far_as_it_may_be_moved_nothing_is_told():
    one, joint, *_ = fitted([0.0, 0.0, 9.0, 0.0, 0.0])
    assert suspects_of(one, SimpleNamespace(**{**vars(joint), "off": np.clip(3 * joint.off, -5, 5)})) == []


def test_gain_values_and_errors_are_those_of_a_fit_without_what_is_stated_of_it():
    off = [4.0, 0.0, 0.0, 0.0, 0.0]
    one, joint, p, C = fitted(off)
    for s in suspects_of(one, joint):
        again, _, p_k, C_k = fitted(off, without=s.member)
        assert s.gain == pytest.approx(one.residuals @ one.residuals - again.residuals @ again.residuals)
        assert s.by_others_c == pytest.approx(T[s.member] + ERROR_K * p_k[3 + s.member])
        np.testing.assert_allclose(s.moves, p_k - p, atol=1e-9)
        np.testing.assert_allclose(s.wider, C_k - C, atol=1e-9)


def test_errors_about_the_fit_hold_wherever_the_wrong_one_is():
    one, joint, p, C = fitted([4.0, 0.0, 0.0, 0.0, 0.0])
    found = suspects_of(one, joint)
    wide = widened(C, found)
    sigma = np.sqrt(np.diag(wide))
    truth = np.array([0.0, -2.0, CURVED])
    assert np.abs((p[:3] - truth) / np.sqrt(np.diag(C))[:3]).max() > 3
    assert np.abs((p[:3] - truth) / sigma[:3]).max() < 2
    assert widened(C, []) is C
