"""Roots of a band's modulus where they can be written down."""

import numpy as np
import pytest

from fitting.identification.pointwise_roots import BandProblem, nearest_root

G_LAW = np.full(4, 1e6 * (1 + 0.4j))
BAND = np.array([0, 0, 1, 1])


def problem(velocity_of, measured, std=1e-3):
    return BandProblem(velocity_of, G_LAW, np.asarray(measured, complex), np.full(4, std), BAND, 2)


def test_a_reading_in_proportion_to_the_modulus_has_one_root_with_its_error():
    u = np.array([0.3 - 0.1j, -0.2 + 0.05j])
    scale = 1 / G_LAW[0]
    of = problem(lambda G: (G * scale, np.full(4, scale)), np.exp(u[BAND]))
    found = nearest_root(of)
    np.testing.assert_allclose(found.u, u, atol=1e-6)
    # Two readings of each band: relative error over the root of two.
    np.testing.assert_allclose(found.error, 1e-3 / np.abs(np.exp(u)) / np.sqrt(2), rtol=1e-6)
    assert found.converged.all()
    assert found.is_alone.all()


@pytest.mark.parametrize(("other", "alone"), [(-0.25, False), (-1.2, True)])
def test_a_second_root_about_as_near_is_a_rival_and_one_far_off_is_not(other, alone):
    def velocity_of(G):
        x = G / G_LAW
        return (x - np.exp(0.2)) * (x - np.exp(other)), (2 * x - np.exp(0.2) - np.exp(other)) / G_LAW

    found = nearest_root(problem(velocity_of, np.zeros(4)))
    np.testing.assert_allclose(found.u, 0.2, atol=1e-4)
    assert found.is_alone.tolist() == [alone, alone]


def test_a_band_that_no_modulus_near_the_law_explains_has_no_root():
    found = nearest_root(problem(lambda G: (G / G_LAW, 1 / G_LAW), np.full(4, 1e4)))
    assert not found.converged.any()
