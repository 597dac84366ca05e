"""Readings that are worth something else: another noise beside the same error of the model."""

import numpy as np
import pytest

from fitting.data.noise import Noise
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.whitening import SHARE
from fitting.sweep import Sweep

F = np.linspace(20.0, 30.0, 8)
V = (1.0 + 0.5j) * np.linspace(1.0, 2.0, 8)
ONE = np.ones(8, dtype=np.intp)
SWEEP = Sweep(F, V, np.full(8, 9.81), ONE, ONE)
MODEL_ERROR = np.array([0.01 * V, 0.002j * V])
ALONE = np.array([0.02 * V * np.cos(F)])


def evidence(noise_m_s):
    return Evidence.of(SWEEP, Noise(noise_m_s, "local scatter"), MODEL_ERROR, V, None)


@pytest.mark.parametrize("times", [0.1, 1.0, 3.0])
def test_with_another_noise_readings_are_worth_what_they_are_with_that_from_the_start(times):
    noise = 0.01 * np.linspace(1.0, 3.0, 8)
    other = times * noise[::-1]
    found, expected = evidence(noise).with_noise(other), evidence(other)
    np.testing.assert_allclose(found.sigma_m_s, expected.sigma_m_s)
    np.testing.assert_allclose(found.B, expected.B)
    np.testing.assert_array_equal(found.noise_m_s, expected.noise_m_s)
    v, dv = V * (1 + 0.01 * np.cos(F)), 0.3j * V
    np.testing.assert_allclose(found.residuals(v), expected.residuals(v))
    np.testing.assert_allclose(found.jacobian(v, dv[None]), expected.jacobian(v, dv[None]))


def test_ten_times_the_noise_makes_readings_worth_a_hundredth_and_leaves_the_models_error():
    quiet = evidence(np.full(8, 0.01))
    loud = quiet.with_noise(np.full(8, 0.1))
    off = V + 0.05j * np.cos(3 * F)
    assert np.sum(loud.residuals(off) ** 2) == pytest.approx(np.sum(quiet.residuals(off) ** 2) / 100, rel=0.1)
    # In m/s, as it was.
    np.testing.assert_allclose(
        loud.B * np.tile(loud.sigma_m_s, 2)[:, None], quiet.B * np.tile(quiet.sigma_m_s, 2)[:, None]
    )


def test_the_models_white_error_stays_where_noise_vanishes():
    found = evidence(np.full(8, 0.01)).with_noise(np.zeros(8))
    np.testing.assert_allclose(found.sigma_m_s, SHARE * np.abs(V))


def test_errors_of_several_have_the_mean_of_their_covariances():
    noise = Noise(np.full(8, 0.01), "local scatter")
    one, other = (
        Evidence.of(SWEEP, noise, error, v, None) for error, v in ((MODEL_ERROR, V), (ALONE, 1.2 * V))
    )

    def covariance(of):
        B = of.B * np.tile(of.sigma_m_s, 2)[:, None]
        return B @ B.T

    found = one.with_errors_of([one, other])
    np.testing.assert_array_equal(found.sigma_m_s, one.sigma_m_s)
    np.testing.assert_allclose(covariance(found), (covariance(one) + covariance(other)) / 2, atol=1e-8)
    assert found.B.shape == (16, 3)
    # What is as good as nothing beside the noise takes no time.
    assert one.with_errors_of([one, Evidence.of(SWEEP, noise, 1e-5 * ALONE, V, None)]).B.shape == (16, 2)
