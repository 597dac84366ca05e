"""Blows whose records were weighted by exp(-t / tau): against records in time, and the equation at s."""

from types import SimpleNamespace

import numpy as np
import pytest
from solved_in_full import OMEGA, G

from fitting.effects.exponential_window import ExponentialWindowEffect
from fitting.effects.given import ModulusAt
from fitting.laws.fractional_zener import FractionalZener

WINDOW = ExponentialWindowEffect()
TAU = 0.15
OF_VELOCITY, OF_ACCELERATION = (TAU, 0.0), (TAU, 1.0)


@pytest.mark.parametrize(("u", "integrations"), [(OF_VELOCITY, 0), (OF_ACCELERATION, 1)])
def test_a_record_weighted_in_time_reads_so(u, integrations):
    """A mass on a spring with viscous damping, struck by a unit impulse."""
    w_0, ratio, per_s = 2 * np.pi * 40.0, 0.02, 1 / TAU
    dt = 1e-5
    t = dt * np.arange(int(3.0 / dt))
    p = -ratio * w_0 + 1j * w_0 * np.sqrt(1 - ratio**2)
    # x = Im(e^(p t)) / Im p; what a transducer reads of it is windowed, then integrated.
    motion = (p ** (1 + integrations) * np.exp(p * t)).imag / p.imag
    record = motion * np.exp(-t * per_s)
    record[0] /= 2
    omega = 2 * np.pi * np.array([23.0, 39.0, 41.0, 90.0])
    read = np.exp(-1j * np.outer(omega, t)) @ record * dt
    if integrations:
        # The impulse itself, which a record of samples does not hold, and the division by i omega.
        read = (read + 1) / (1j * omega)
    s = 1j * omega + per_s
    X = 1 / (s**2 + 2 * ratio * w_0 * s + w_0**2)
    found = WINDOW.reading(1j * omega * X, SimpleNamespace(omega=omega), np.array(u))
    np.testing.assert_allclose(found, read, rtol=1e-4)


def test_the_plate_answers_at_the_shifted_frequency(full):
    plate = full.spanned.take(())
    C_1 = (plate.U * plate.d) @ plate.U.T
    expected = []
    for w, g in zip(OMEGA, G, strict=True):
        s = 1j * w + 1 / TAU
        A = plate.K_0 + g * plate.K_1 + s * C_1 + s**2 * plate.M
        expected.append(plate.observe @ np.linalg.solve(A, plate.load.astype(complex)))
    np.testing.assert_allclose(full.reduced(WINDOW, OF_VELOCITY), expected, rtol=1e-10)


def test_the_derivative_to_the_window_is_that_of_differences(full):
    by, difference = full.slope(WINDOW, OF_VELOCITY, 0)
    assert np.abs(by / difference - 1).max() < 1e-4


def test_the_modulus_is_the_law_s_at_the_shifted_frequency():
    law = FractionalZener(4e5, 8e6, 2e-4, 0.7)
    points = SimpleNamespace(omega=2 * np.pi * np.array([20.0, 100.0, 400.0]))
    s = 1j * points.omega + 1 / TAU
    z = (s * law.tau_s) ** law.alpha
    expected = (law.g0_pa + law.ginf_pa * z) / (1 + z)
    found = WINDOW.modulus(ModulusAt(law, points, None), points, np.array(OF_VELOCITY))
    np.testing.assert_allclose(found, expected, rtol=1e-3)
    assert np.abs(law.modulus(points.omega) / expected - 1).max() > 0.02


def test_an_exponential_window_needs_a_force():
    assert WINDOW.needs == {"force"}
