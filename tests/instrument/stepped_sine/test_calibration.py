"""The vibrometer against the accelerometer."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sessions import point

from fitting.errors import TooFewPoints
from instrument.stepped_sine.calibration import Calibration, calibrate, phase_left

FREQUENCIES = (40.0, 80.0, 120.0, 160.0, 200.0, 240.0, 280.0)


def points(gain, delay_s, scatter=0.0, seed=0):
    random = np.random.default_rng(seed)
    found = []
    for k, f in enumerate(FREQUENCIES):
        omega = 2 * np.pi * f
        base = 9.81 * np.exp(1j * k)
        v = base / (1j * omega) * gain * np.exp(-1j * omega * delay_s)
        v *= 1 + scatter * (random.standard_normal() + 1j * random.standard_normal())
        found.append(
            point(
                k,
                f,
                purpose="calibration",
                base_accel_re_m_s2=base.real,
                base_accel_im_m_s2=base.imag,
                velocity_re_m_s=v.real,
                velocity_im_m_s=v.imag,
                velocity_std_m_s=max(scatter, 1e-6) * abs(v),
            )
        )
    return found


@given(st.floats(0.5, 2.0), st.floats(-5e-3, 5e-3))
def test_gain_and_delay_are_found_exactly_where_there_is_no_noise(gain, delay_s):
    found = calibrate(points(gain, delay_s))
    assert found.gain == pytest.approx(gain, rel=1e-9)
    assert found.delay_s == pytest.approx(delay_s, abs=1e-10)


def test_stated_errors_cover_the_scatter():
    z = []
    for seed in range(200):
        found = calibrate(points(1.02, 1.1e-3, 2e-3, seed))
        z.append([(found.gain - 1.02) / found.gain_std, (found.delay_s - 1.1e-3) / found.delay_std_s])
    assert np.all(np.std(z, axis=0) < 1.15)
    assert np.all(np.std(z, axis=0) > 0.7)


def test_a_calibration_undoes_what_it_found():
    found = calibrate(points(1.02, 1.1e-3))
    taken_off = Calibration(found.gain, found.delay_s).true_velocity(100.0, 1.02 * np.exp(-2j * np.pi * 0.11))
    assert taken_off == pytest.approx(1.0, rel=1e-9)


def test_two_points_are_too_few():
    with pytest.raises(TooFewPoints, match="2 calibration points, expected 3"):
        calibrate(points(1.0, 0.0)[:2])


def test_what_no_delay_explains_is_seen_and_a_sensor_turned_round_named():
    left, turned = phase_left(points(1.0, 1.1e-3, 1e-3), 1.1e-3)
    assert left < 0.01
    assert not turned
    against = points(-1.0, 1.1e-3, 1e-3)
    left, turned = phase_left(against, calibrate(against).delay_s)
    assert left > 0.5
    assert turned
    scattered = points(1.0, 1.1e-3, 0.8, seed=3)
    assert not phase_left(scattered, calibrate(scattered).delay_s)[1]
