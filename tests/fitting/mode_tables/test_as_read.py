"""Peaks, half-power widths and poles of one mode whose stiffness changes over it, found by themselves."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq, minimize_scalar, newton

from fitting.laws import LAWS
from fitting.mode_tables.as_read import READS, Stiffness, as_read

LAW = LAWS["fractional-zener"](0.3e6, 40e6, 2e-5, 0.65)
MASS = 1.0


class OneMode:
    """A mass on a spring of metal and one of rubber, which takes a share of the stiffness at 100 Hz."""

    def __init__(self, share, law=LAW):
        omega = 2 * np.pi * 100.0
        G = law.modulus(np.array([omega]))[0].real
        self.law, self.metal, self.rubber = law, (1 - share) * omega**2, share * omega**2 / G

    def stiffness(self, omega):
        return self.metal + self.rubber * self.law.modulus(np.atleast_1d(omega))

    def own(self):
        """omega_r, and lambda about it."""
        omega = 600.0
        for _ in range(200):
            omega = float(np.sqrt(self.stiffness(omega)[0].real))
        at = omega * np.array([1 - 1e-4, 1.0, 1 + 1e-4])
        G = self.law.modulus(at)
        core = self.rubber * G[1:2] / omega**2
        rest, none = np.array([self.metal / omega**2 + 0j]), np.zeros(1, complex)
        return omega, Stiffness(rest, core, (G[2:] - G[:1]) / (2e-4 * G[1]), none)

    def size(self, omega):
        return float(np.abs(omega / (self.stiffness(omega) - omega**2))[0])

    def peak_and_width(self):
        omega, _ = self.own()
        peak = minimize_scalar(
            lambda w: -self.size(w),
            bounds=(0.7 * omega, 1.4 * omega),
            method="bounded",
            options={"xatol": 1e-9},
        ).x
        level = self.size(peak) / np.sqrt(2)
        low, high = (
            brentq(lambda w: self.size(w) - level, *sorted((peak, far * omega))) for far in (0.2, 4.0)
        )
        return peak, (high - low) / peak

    def pole(self):
        omega, k = self.own()
        start = omega * (1 + 0.5j * k.loss_factor[0])
        p = newton(lambda w: self.stiffness(np.array([w]))[0] - w**2, start, tol=1e-10)
        return abs(p), 2 * p.imag / abs(p)


@pytest.mark.parametrize("share", [0.05, 0.2, 0.4])
@pytest.mark.parametrize(("how", "within"), [("half-power", 2e-4), ("poles", 5e-4)])
def test_what_is_read_is_that_of_the_response_and_of_the_law_in_the_complex_plane(how, within, share):
    one = OneMode(share)
    f_true, eta_true = one.peak_and_width() if how == "half-power" else one.pole()
    omega, k = one.own()
    ln_f, eta = as_read(how, k)
    assert omega * np.exp(ln_f[0]) == pytest.approx(f_true, rel=within)
    assert eta[0] == pytest.approx(eta_true, rel=0.01)
    # What the core's slope does is no trifle.
    more = eta_true / k.loss_factor[0] - 1
    assert (more > 0.02) == (share > 0.1)
    assert more == pytest.approx((k.sigma * k.core).real[0] / 2, rel=0.5, abs=0.01)


def of(eta, rising=0.0, losing=0.0, share=1.0):
    whole = 1 + 1j * np.array([eta])
    core = share * whole
    return Stiffness(whole - core, core, np.array([rising + 1j * losing]), np.zeros(1, complex))


def test_the_model_s_own_are_left_as_they_are():
    assert READS == ("model", "poles", "half-power")
    ln_f, eta = as_read("model", of(0.3, 0.2, 0.1))
    assert (ln_f.tolist(), eta.tolist()) == ([0.0], [0.3])


@given(st.floats(1e-4, 0.05))
def test_a_core_that_stays_as_it_is_has_one_loss_factor_however_it_is_read(eta):
    for how in READS:
        ln_f, as_eta = as_read(how, of(eta))
        assert abs(ln_f[0]) < eta**2
        assert as_eta[0] == pytest.approx(eta, rel=eta + 1e-6)


@given(st.floats(0.01, 0.8), st.floats(0.0, 0.5), st.floats(-0.3, 0.3), st.floats(0.1, 1.0))
def test_widths_grow_with_the_loss_and_with_the_slope(eta, rising, losing, share):
    for how in ("poles", "half-power"):
        _, here = as_read(how, of(eta, rising, losing, share))
        _, more = as_read(how, of(1.05 * eta, rising, losing, share))
        _, steeper = as_read(how, of(eta, rising + 0.05, losing, share))
        assert here[0] < more[0]
        assert here[0] < steeper[0]


@given(st.floats(1e-3, 5.0), st.floats(-0.1, 0.9), st.floats(-0.3, 0.3), st.floats(0.02, 1.0))
def test_whatever_a_search_comes_by_is_a_number_and_with_losses_up_to_one_that_of_a_pole_or_peak(
    eta, rising, losing, share
):
    k = of(eta, rising, losing, share)
    for how in READS:
        ln_f, as_eta = as_read(how, k)
        assert np.isfinite([ln_f, as_eta]).all()
        assert as_eta[0] > 0
        if how == "model" or eta > 1 or (ln_f[0], as_eta[0]) == (0.0, k.loss_factor[0]):
            continue
        if how == "poles":
            turned = np.arcsin(as_eta / 2)
            off = [abs(k.denominator(ln_f + 1j * angle)[0]) for angle in (turned, np.pi - turned)]
            assert min(off)[0] == pytest.approx(0.0, abs=1e-6)
        else:
            # At a peak the amplitude neither rises nor falls.
            assert k.size(ln_f)[1][0] == pytest.approx(0.0, abs=1e-6)
