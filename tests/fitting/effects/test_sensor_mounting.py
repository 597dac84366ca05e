"""A bracket below the pads beside two masses on springs, and an accelerometer on wax."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.effects.given import Points
from fitting.effects.sensor_mounting import SensorMountingEffect

F_0, M, BRACKET = 900.0, 0.5, 0.4
K = 3e5 * (1 + 0.6j)


@pytest.fixture
def at():
    omega = 2 * np.pi * np.array([20.0, 90.0, 300.0])
    return Points(omega, np.full(3, 9.81), np.arange(3.0), True, True, "absolute", mass_kg=M)


def two_masses(omega, damping_ratio):
    """Of base acceleration one: of the bracket, and of the mass on its pads. Shape (points,) each.

    The bracket's damper stands on the ground: the base's motion reaches it through its spring alone.
    """
    k = BRACKET * (2 * np.pi * F_0) ** 2
    found = []
    for w in omega:
        c = 2 * damping_ratio * np.sqrt(k * BRACKET)
        A = np.array([[k + 1j * w * c + K - BRACKET * w**2, -K], [-K, K - M * w**2]])
        found.append(np.linalg.solve(A, [k, 0.0]))
    return np.array(found).T


@pytest.mark.parametrize("damping_ratio", [0.0, 0.2])
def test_a_bracket_moves_as_two_masses_on_springs_do(at, damping_ratio):
    alone = K / (K - M * at.omega**2)
    moves = at.drive_amplitude / (1j * at.omega)
    read = SensorMountingEffect().reading(alone * moves, at, np.array([F_0, damping_ratio, 0.0, 1 / BRACKET]))
    np.testing.assert_allclose(read / moves, two_masses(at.omega, damping_ratio)[1], rtol=1e-12)


def test_a_relative_reading_is_one_less(at):
    u, moves = np.array([F_0, 0.02, 0.0, 1.0]), at.drive_amplitude / (1j * at.omega)
    T = K / (K - M * at.omega**2)
    whole = SensorMountingEffect().reading(T * moves, at, u)
    relative = SensorMountingEffect().reading((T - 1) * moves, replace(at, reads="relative"), u)
    np.testing.assert_allclose(relative, whole - moves)


def test_the_base_s_own_sensor_reads_too_much_so_the_mass_too_little(at):
    base = SensorMountingEffect(on_base=True)
    r = at.omega / (2 * np.pi * F_0)
    for damping_ratio in (0.0, 0.05):
        read = base.reading(np.ones(3, complex), at, np.array([F_0, damping_ratio, 1.0]))
        np.testing.assert_allclose(read, 1 - r**2 + 2j * damping_ratio * r)


def test_one_that_resonates_far_away_changes_nothing(at):
    for form in SensorMountingEffect().variants():
        u = form.starts(None, at)[0].copy()
        u[0] = 1e9
        np.testing.assert_allclose(form.reading(np.ones(3, complex), at, u), 1, rtol=1e-6)


def test_both_begin_above_what_is_measured(at):
    top = at.omega.max() / (2 * np.pi)
    assert all(u[0] > 1.5 * top for form in SensorMountingEffect().variants() for u in form.starts(None, at))


def test_a_weak_one_five_times_as_strong_rises_five_times_as_far(at):
    form, begun = SensorMountingEffect(), np.array([1e6, 0.02, 0.0, 0.5])
    rise = [form.reading(np.ones(3, complex), at, u) - 1 for u in (begun, form.scaled(begun, 5.0))]
    np.testing.assert_allclose(rise[1].real, 5 * rise[0].real, rtol=1e-3)
