from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from paper_law import TABLE_4

from fitting.errors import OutsideModel
from fitting.laws.bent_law import LOSS, REACH, STORAGE, BentLaw
from fitting.laws.constant import ConstantModulus
from fitting.laws.generalised_maxwell import GeneralisedMaxwell

BAND_HZ = np.array([14.0, 300.0])
OMEGA = 2 * np.pi * np.geomspace(10, 400, 60)
STRAIGHT = BentLaw.over(TABLE_4, BAND_HZ)
LAWS = [TABLE_4, ConstantModulus(0.5e6, 0.7), GeneralisedMaxwell(0.2e6, (0.3e6, 1e6), (2e-3, 2e-4))]


def bent(law, seed):
    straight = BentLaw.over(law, BAND_HZ)
    own = law.values
    whitened = np.random.default_rng(seed).normal(size=straight.bend_count)
    return straight.with_values(np.concatenate([own, np.exp(whitened)]))


def test_unbent_it_is_the_law_itself():
    np.testing.assert_allclose(STRAIGHT.modulus(OMEGA), TABLE_4.modulus(OMEGA), rtol=1e-14)
    own = len(TABLE_4.names)
    np.testing.assert_allclose(STRAIGHT.jacobian(OMEGA)[:own], TABLE_4.jacobian(OMEGA), rtol=1e-13)
    assert (STRAIGHT.plain, STRAIGHT.kind) == (TABLE_4, TABLE_4.kind)
    assert (TABLE_4.plain, TABLE_4.bend_count) == (TABLE_4, 0)
    np.testing.assert_array_equal(STRAIGHT.search_widths, TABLE_4.search_widths)


def test_its_parameters_are_the_laws_then_the_bends():
    own = len(TABLE_4.names)
    assert STRAIGHT.names[:own] == TABLE_4.names
    assert len(STRAIGHT.names) == len(STRAIGHT.values) == len(STRAIGHT.limits) == own + STRAIGHT.bend_count
    other = bent(TABLE_4, 1)
    np.testing.assert_allclose(other.with_logs(np.log(other.values)).values, other.values, rtol=1e-12)
    assert other.plain == TABLE_4


def test_a_bend_beyond_its_limits_is_refused_and_fitted_values_stay_within():
    with pytest.raises(OutsideModel, match="bend_2"):
        replace(STRAIGHT, bend=(1.0, 1e9, *STRAIGHT.bend[2:]))
    far = STRAIGHT.with_logs(np.log(STRAIGHT.values) + 30.0)
    assert all(q.holds(v) for q, v in zip(far.limits, far.values, strict=True))


def test_knots_reach_from_end_to_end_closer_than_a_bend_goes_on():
    knots = np.array(STRAIGHT.knots_hz)
    assert knots[[0, -1]] == pytest.approx(BAND_HZ)
    assert np.diff(np.log(knots)).max() < REACH


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.kind)
def test_jacobian_agrees_with_central_differences(law):
    law = bent(law, 2)
    logs, J = np.log(law.values), law.jacobian(OMEGA) * law.values[:, None]
    for k in range(len(logs)):
        step = 1e-5 * np.eye(len(logs))[k]
        up, down = (law.with_logs(logs + s * step).modulus(OMEGA) for s in (1, -1))
        np.testing.assert_allclose(J[k], (up - down) / 2e-5, atol=1e-7 * np.abs(law.modulus(OMEGA)).max())


def test_expected_bends_are_of_the_stated_size_everywhere_in_the_band_and_smooth():
    f = np.geomspace(*BAND_HZ, 23)
    G, eta = TABLE_4.storage_and_loss(2 * np.pi * f)
    found = [bent(TABLE_4, seed).storage_and_loss(2 * np.pi * f) for seed in range(3000)]
    b = np.array([[np.log(one[0] / G), np.log(one[1] / eta)] for one in found])
    # 3000 draws: a standard deviation is known to 1.3 %.
    for k, size in enumerate((STORAGE, LOSS)):
        np.testing.assert_allclose(np.std(b[:, k], axis=0), size, rtol=0.05)
        near = np.interp(np.log(f) - REACH, np.log(f), np.arange(len(f)))
        pairs = [(n, round(near[n])) for n in range(len(f)) if near[n] > 0]
        expected = [np.exp(-0.5 * (np.log(f[n] / f[m]) / REACH) ** 2) for n, m in pairs]
        agree = [np.corrcoef(b[:, k, n], b[:, k, m])[0, 1] for n, m in pairs]
        np.testing.assert_allclose(agree, expected, atol=0.06)
    # Storage and loss bend apart.
    assert abs(np.corrcoef(b[:, 0, 11], b[:, 1, 11])[0, 1]) < 0.06


@given(st.integers(0, 500))
def test_a_bend_keeps_a_core_passive(seed):
    G, eta = bent(TABLE_4, seed).storage_and_loss(OMEGA)
    assert np.all(G > 0)
    assert np.all(eta > 0)


def test_beyond_the_band_it_goes_back_to_the_law():
    far = 2 * np.pi * np.array([1e-2, 1e5])
    np.testing.assert_allclose(bent(TABLE_4, 3).modulus(far), TABLE_4.modulus(far), rtol=1e-6)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.kind)
def test_many_moduli_at_once_are_those_one_by_one(law):
    rng = np.random.default_rng(4)
    for one in (law, bent(law, 2)):
        rows = np.log(one.values) + 0.3 * rng.normal(size=(5, len(one.values)))
        # A row beyond a limit is kept within.
        rows[0, len(law.values) - 1] = 50.0
        expected = [one.with_logs(row).modulus(OMEGA) for row in rows]
        np.testing.assert_allclose(one.moduli(rows, OMEGA), expected, rtol=1e-12)


def test_a_slow_bend_goes_on_farther_than_the_usual_one_and_by_more():
    band = np.array([1.0, 1e6])
    usual, slow = (BentLaw.over(TABLE_4, band, slow=k, slow_reach=3.0) for k in (0.0, 4.0))
    omega = 2 * np.pi * np.array([1e2, 1e2 * np.exp(2.0)])
    usual_W, slow_W = (law._weights(omega) for law in (usual, slow))
    alike = [
        W[:, 0] @ W[:, 1] / np.sqrt((W[:, 0] @ W[:, 0]) * (W[:, 1] @ W[:, 1])) for W in (usual_W, slow_W)
    ]
    assert alike[0] == pytest.approx(np.exp(-2.0), abs=0.02)
    assert alike[1] == pytest.approx((np.exp(-2.0) + 16 * np.exp(-0.5 * (2 / 3) ** 2)) / 17, abs=0.02)
    assert slow_W[:, 0] @ slow_W[:, 0] == pytest.approx(17.0, rel=0.02)
    assert slow.with_values(slow.values).slow == 4.0


def test_a_law_that_may_bend_farther_is_the_same_law_and_its_bend_is_cheaper():
    law = bent(TABLE_4, 2)
    freer = law.freer(2.0)
    np.testing.assert_allclose(freer.modulus(OMEGA), law.modulus(OMEGA), rtol=1e-12)
    np.testing.assert_allclose(np.log(freer.bend), np.log(law.bend) / 2)


def test_where_a_law_has_next_to_no_loss_its_loss_bends_farther_and_derivatives_say_so():
    law = bent(TABLE_4, 4)
    count = len(law.knots_hz)
    faint = replace(law, faint=tuple(np.linspace(1.0, 4.0, count)))
    plain = TABLE_4.storage_and_loss(OMEGA)
    usual, more = (np.log(one.storage_and_loss(OMEGA)[1] / plain[1]) for one in (law, faint))
    at = np.interp(np.log(OMEGA / (2 * np.pi)), np.log(law.knots_hz), np.log(faint.faint))
    np.testing.assert_allclose(more, usual * np.exp(at), rtol=1e-9)
    np.testing.assert_allclose(faint.storage_and_loss(OMEGA)[0], law.storage_and_loss(OMEGA)[0])
    logs, J = np.log(faint.values), faint.jacobian(OMEGA) * faint.values[:, None]
    for k in range(len(logs) - count, len(logs)):
        step = np.eye(len(logs))[k] * 1e-5
        up, down = (faint.with_logs(logs + s * step).modulus(OMEGA) for s in (1, -1))
        np.testing.assert_allclose(J[k], (up - down) / 2e-5, atol=1e-4 * np.abs(J[k]).max())
    np.testing.assert_allclose(faint.moduli(logs[None], OMEGA)[0], faint.modulus(OMEGA), rtol=1e-9)
