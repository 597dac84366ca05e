import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from paper_law import TABLE_4

from fitting.errors import OutsideModel
from fitting.laws.table import Tabulated


def table_of(law, frequency_hz):
    G, eta = law.storage_and_loss(2 * np.pi * frequency_hz)
    return Tabulated(tuple(frequency_hz.tolist()), tuple(G.tolist()), tuple(eta.tolist()))


TABLE = table_of(TABLE_4, np.geomspace(10, 1000, 21))


def test_the_rows_are_met():
    G, eta = TABLE.storage_and_loss(2 * np.pi * np.array(TABLE.frequency_hz))
    np.testing.assert_allclose(G, TABLE.storage_modulus_pa, rtol=1e-12)
    np.testing.assert_allclose(eta, TABLE.loss_factor, rtol=1e-12)


def test_ten_rows_a_decade_follow_a_fractional_zener():
    # Measured: 0.02 % in G' and 0.03 % in eta.
    omega = 2 * np.pi * np.geomspace(10, 1000, 700)
    (G, eta), (G_true, eta_true) = TABLE.storage_and_loss(omega), TABLE_4.storage_and_loss(omega)
    np.testing.assert_allclose(G, G_true, rtol=1e-3)
    np.testing.assert_allclose(eta, eta_true, rtol=1e-3)


@given(st.floats(1e-3, 9.9), st.floats(1.01, 100.0))
def test_beyond_its_rows_it_is_a_power_law_and_says_so(f, ratio):
    (G, H), (eta, zeta) = TABLE.storage_and_loss(2 * np.pi * np.array([f, f / ratio]))
    assert (eta, zeta) == pytest.approx((TABLE.loss_factor[0],) * 2)
    slope = np.log(G / H) / np.log(ratio)
    near = TABLE.storage_and_loss(2 * np.pi * np.array([10.0, 10.001]))[0]
    assert slope == pytest.approx(np.log(near[1] / near[0]) / np.log(1.0001), abs=1e-4)
    assert "outside the core law's table, 10 to 1000 Hz" in TABLE.outside(np.array([f, 100.0]))
    assert TABLE.outside(np.array([10.0, 1000.0])) == ""


def test_a_falling_end_does_not_go_on_falling():
    noisy = Tabulated((10.0, 20.0, 40.0), (1e6, 2e6, 1.9e6), (0.5, 0.5, 0.5))
    G, _ = noisy.storage_and_loss(2 * np.pi * np.array([40.0, 4000.0]))
    assert G[1] == pytest.approx(G[0])


def test_a_fit_begins_at_the_nearest_fractional_zener():
    start = TABLE.to_fit(np.array([20.0, 400.0]))
    assert start.kind == "fractional-zener"
    omega = 2 * np.pi * np.geomspace(20, 400, 30)
    assert np.abs(start.modulus(omega) / TABLE_4.modulus(omega) - 1).max() < 0.01


def test_a_lossless_table_can_be_begun_with():
    law = Tabulated((10.0, 100.0), (1e6, 1e6), (0.0, 0.0)).to_fit(np.array([20.0, 50.0]))
    G, eta = law.storage_and_loss(2 * np.pi * np.array([30.0]))
    assert G[0] == pytest.approx(1e6, rel=0.02)
    assert eta[0] < 0.05


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        (((10.0,), (1e6,), (0.5,)), "two or more"),
        (((20.0, 10.0), (1e6, 1e6), (0.5, 0.5)), "ascending"),
        (((10.0, 20.0), (1e6,), (0.5, 0.5)), "as many of each"),
        (((10.0, 20.0), (1e6, -1.0), (0.5, 0.5)), "storage_modulus_pa = -1 at 20 Hz"),
        (((10.0, 20.0), (1e6, 1e6), (0.5, float("nan"))), "loss_factor = nan at 20 Hz"),
    ],
)
def test_what_is_no_table_is_refused(rows, said):
    with pytest.raises(OutsideModel, match=said):
        Tabulated(*rows)
