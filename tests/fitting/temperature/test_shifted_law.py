"""A law at another temperature, and where the joint fit of several begins."""

from dataclasses import replace

import numpy as np
import pytest
from temperature_cases import LAW, REFERENCE, T, wlf

from fitting.temperature.shifted_law import ShiftedLaw
from fitting.temperature.shifts import ZERO_K, Shift
from fitting.temperature.start import start_of

OMEGA = 2 * np.pi * np.geomspace(14.0, 300.0, 9)


def test_a_shift_is_another_time_and_a_vertical_one_another_size():
    found = ShiftedLaw(LAW, a=3.0, b=1.1)
    np.testing.assert_allclose(
        found.modulus(OMEGA), 1.1 * replace(LAW, tau_s=3.0 * LAW.tau_s).modulus(OMEGA), rtol=1e-12
    )
    assert found.kind == LAW.kind
    assert found.names == [*LAW.names, "shift", "vertical"]


def test_its_derivatives_are_those_of_differences():
    law, h = ShiftedLaw(LAW, a=3.0, b=1.1), 1e-5
    for k, by in enumerate(law.jacobian(OMEGA)):
        up, down = (law.with_values(law.values * (1 + s * h * (np.arange(6) == k))) for s in (1, -1))
        difference = (up.modulus(OMEGA) - down.modulus(OMEGA)) / (2 * h * law.values[k])
        np.testing.assert_allclose(by, difference, rtol=1e-5, atol=1e-9 * np.abs(by).max())


def test_curves_of_one_law_are_laid_over_each_other():
    """Each temperature as if it had been found alone: the law with its own time."""
    log_a = wlf()
    laws = [replace(LAW, tau_s=float(LAW.tau_s * np.exp(s))) for s in log_a]
    law, shift = start_of(laws, [(14.0, 300.0)] * len(T), T, REFERENCE)
    assert shift == pytest.approx(log_a, abs=1e-3)
    np.testing.assert_allclose(law.modulus(OMEGA), LAW.modulus(OMEGA), rtol=1e-3)
    assert shift[2] == 0.0


def test_factors_that_bend_the_wrong_way_begin_no_flatter_than_arrhenius_s():
    """Noise may turn the curvature of few factors round; from C1 and C2 without end no fit comes back."""
    T_c = np.array([5.0, 13.0, 21.0, 29.0, 37.0])
    shift = Shift("wlf", T_c, 21.0)
    c1, c2 = shift.near(np.array([2.47, 1.40, 0.0, -1.82, -3.52]))
    assert c2 <= 21.0 + ZERO_K
    assert 1 < c1 < 100
