"""Modulus lost and loss gained with strain, beside a real rubber's."""

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import least_squares

from fitting.laws.kraus import LEAST, Kraus, strained

REAL = Path(__file__).parents[3].parent / "shared/data/real/shear"
G = np.array([1e6 * (1 + 0.2j), 3e6 * (1 + 0.5j)])


def test_at_the_reference_so_much_is_lost_and_gained_as_is_said():
    for exponent in (0.3, 0.5, 0.7):
        curve = Kraus(0.2, 0.8, 0.1, exponent)
        found = strained(G, curve.lost(np.ones(2)), curve.gained(np.ones(2)))
        assert found.real == pytest.approx(0.8 * G.real)
        assert found.imag == pytest.approx(0.8 * G.imag + 0.1 * np.sqrt(G.real * G.imag))
        np.testing.assert_array_equal(strained(G, curve.lost(np.zeros(2)), curve.gained(np.zeros(2))), G)


def test_most_loss_is_gained_where_half_of_what_can_be_lost_is_lost():
    curve, s = Kraus(0.2, 0.5, 0.1), np.geomspace(1e-3, 1e3, 1201)
    at = curve.gained(s).argmax()
    can_be = 0.2 * 1.5 / 0.5
    assert curve.lost(s)[at] == pytest.approx(can_be / 2, rel=0.01)


def test_no_more_is_lost_than_leaves_something():
    assert Kraus(0.8).lost(np.array([5.0])) == pytest.approx([1 - LEAST])


@pytest.mark.skipif(not REAL.exists(), reason="the real records are not here")
@pytest.mark.parametrize(("hz", "rms"), [(10, 0.012), (100, 0.035)])
def test_a_real_rubber_goes_so_and_not_without_a_gain(hz, rms):
    """At 100 Hz its readings scatter by 3 % from strain to strain."""
    table = np.genfromtxt(REAL / f"material_a_dma_sd_{hz}hz.csv", delimiter=",", names=True)
    table = table[table["strain_dyn_pct"] > 0.03]
    read = table["G_storage_pa"] + 1j * table["G_loss_pa"]

    def off(p):
        storage, loss, k, c, b = p
        small = np.full(len(read), read[0].real * storage + 1j * read[0].imag * loss)
        curve, strain = Kraus(k, c, b), table["strain_dyn_pct"]
        found = strained(small, curve.lost(strain), curve.gained(strain))
        return np.concatenate([found.real / read.real - 1, found.imag / read.imag - 1])

    def left(most):
        bounds = ([0.3, 0.1, 0.0, 0.0, -1e-9], [3.0, 3.0, 0.8, 20.0, most])
        fit = least_squares(off, [1.0, 1.0, 0.3, 1.0, most / 2], bounds=bounds)
        return np.sqrt(np.mean(fit.fun**2))

    assert left(2.0) < rms
    assert left(1e-9) > 1.8 * left(2.0)
