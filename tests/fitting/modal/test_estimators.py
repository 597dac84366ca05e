import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fitting.modal.frf import DampingEstimate, Frf, Refusal, corrected
from fitting.modal.half_power import half_power, ratio_of
from fitting.modal.lscf import lscf, lscf_poles
from fitting.modal.rational_fit import RationalFit, rational_fit

MOTIONS = {"displacement": 0, "velocity": 1, "acceleration": 2}


def analytic(f, modes, motion="acceleration"):
    """FRF of modes (hertz, ratio, amplitude)."""
    w = 2 * np.pi * f
    H = sum(
        a * (1j * w) ** MOTIONS[motion] / ((2 * np.pi * f_r) ** 2 - w**2 + 2j * z * 2 * np.pi * f_r * w)
        for f_r, z, a in modes
    )
    return Frf(f, H, motion)


@given(
    st.sampled_from(sorted(MOTIONS)),
    st.floats(np.log(4e-4), np.log(0.2)),
    st.floats(50, 500),
    st.floats(0, 1),
)
def test_half_power_is_exact_to_its_resolution(motion, log_zeta, f_n, offset):
    zeta = float(np.exp(log_zeta))
    lines = 20  # in the bandwidth
    step = 2 * zeta * f_n / lines
    low, high = max(f_n * (1 - 4 * zeta), step), f_n * (1 + 5 * zeta)
    f = np.arange(low, high, step) + offset * step
    found = half_power(analytic(f, [(f_n, zeta, 1.0)], motion), f_n)
    assert isinstance(found, DampingEstimate)
    # interpolation in |H|^-2: the remainder falls with the square of the resolution
    assert found.ratio == pytest.approx(zeta, rel=0.5 / lines**2 + 2 * zeta / lines**2)
    assert found.frequency_hz == pytest.approx(f_n, rel=2 * zeta / lines**2 + 1e-9)


@given(st.floats(1e-4, 0.25), st.floats(1, 1000))
def test_formulas_invert_the_exact_half_power_points(zeta, f_n):
    c, s = np.cos(2 * np.arcsin(zeta)), np.sin(2 * np.arcsin(zeta))
    receptance = f_n * np.sqrt([c - s, c + s])
    assert ratio_of(*receptance, "displacement") == (pytest.approx(zeta), pytest.approx(f_n))
    accelerance = f_n / np.sqrt([c + s, c - s])
    assert ratio_of(*accelerance, "acceleration") == (pytest.approx(zeta), pytest.approx(f_n))
    mobility = f_n * (np.sqrt(1 + zeta**2) + np.array([-zeta, zeta]))
    assert ratio_of(*mobility, "velocity") == (pytest.approx(zeta), pytest.approx(f_n))


def test_half_power_refuses_what_it_cannot_read():
    coarse = analytic(np.arange(90, 110, 0.5), [(100, 0.002, 1.0)])
    assert "lines between" in half_power(coarse, 100).why
    cut = analytic(np.arange(100.5, 120, 0.01), [(100, 0.01, 1.0)])
    assert "edge" in half_power(cut, 100).why
    shallow = analytic(np.arange(99.5, 100.5, 0.01), [(100, 0.05, 1.0)])
    assert isinstance(half_power(shallow, 100), Refusal)


def test_exponential_window_is_taken_off():
    # sigma = zeta omega_n grows by 1/T_w
    T_w = 0.7
    omega_d, sigma = 2 * np.pi * 100 * np.sqrt(1 - 0.002**2), 2 * np.pi * 100 * 0.002 + 1 / T_w
    measured = np.hypot(omega_d, sigma)
    found = corrected(measured / (2 * np.pi), sigma / measured, 1 / T_w)
    assert found == pytest.approx((100.0, 0.002), rel=1e-12)


def truncated(modes, seconds, rate=1024.0):
    """Plain transform of decays from a unit impulse, cut off at the end of the record."""
    t = np.arange(int(seconds * rate)) / rate
    h = sum(
        a * np.exp(-z * 2 * np.pi * f * t) * np.sin(2 * np.pi * f * np.sqrt(1 - z**2) * t)
        for f, z, a in modes
    )
    return Frf(np.fft.rfftfreq(len(t), 1 / rate), np.fft.rfft(h) / rate, "displacement")


@pytest.mark.parametrize("zeta", [0.0004, 0.0029, 0.01])
@pytest.mark.parametrize("f_n", [17.7, 201.9])
def test_rational_fit_is_immune_to_truncation(zeta, f_n):
    found = rational_fit(truncated([(f_n, zeta, 1.0)], 4.0), f_n, 0.002)
    assert isinstance(found, RationalFit)
    assert found.estimate.ratio == pytest.approx(zeta, rel=2e-2)
    assert found.estimate.frequency_hz == pytest.approx(f_n, rel=1e-4)


@pytest.mark.parametrize("size", [1e-12, 1e-6, 1e6])
def test_rational_fit_is_the_same_in_any_unit(size):
    modes = [(50.0, 0.004, 1.0), (180.0, 0.002, -0.6), (420.0, 0.001, 0.3)]
    frf = analytic(np.arange(5.0, 600.0, 0.25), [(f, z, a * size) for f, z, a in modes], "displacement")
    for f, zeta, _ in modes:
        found = rational_fit(frf, f, 0.002)
        assert isinstance(found, RationalFit)
        assert found.estimate.ratio == pytest.approx(zeta, rel=1e-4)


@pytest.mark.parametrize("apart", [2, 3, 5, 10])
@pytest.mark.parametrize("strength", [1.0, -0.6, 2.0])
def test_rational_fit_separates_close_modes(apart, strength):
    zeta, f_1 = 0.002, 200.0
    f_2 = f_1 * (1 + apart * 2 * zeta)
    rng = np.random.default_rng(apart)
    frf = truncated([(f_1, zeta, 1.0), (f_2, zeta, strength)], 16.0)
    noise = 0.002 * np.abs(frf.H).max() * (rng.normal(size=len(frf.H)) + 1j * rng.normal(size=len(frf.H)))
    frf = Frf(frf.frequency_hz, frf.H + noise, frf.motion)
    for near, other in ((f_1, f_2), (f_2, f_1)):
        found = rational_fit(frf, near, 0.003, (other,))
        assert isinstance(found, RationalFit)
        assert found.estimate.ratio == pytest.approx(zeta, rel=3e-2)


def test_rational_fit_states_the_scatter_it_has():
    frf = truncated([(100.0, 0.003, 1.0)], 8.0)
    z = []
    for seed in range(100):
        rng = np.random.default_rng(seed)
        noise = 0.01 * np.abs(frf.H).max() * (rng.normal(size=len(frf.H)) + 1j * rng.normal(size=len(frf.H)))
        e = rational_fit(Frf(frf.frequency_hz, frf.H + noise, frf.motion), 100.0, 0.003).estimate
        z.append((e.ratio - 0.003) / e.standard_error)
    assert np.std(z) == pytest.approx(1, abs=0.25)
    assert abs(np.mean(z)) < 0.35


def test_rational_fit_refuses_noise_and_short_windows():
    rng = np.random.default_rng(0)
    f = np.arange(50, 150, 0.125)
    noise = Frf(f, rng.normal(size=len(f)) + 1j * rng.normal(size=len(f)), "velocity")
    assert isinstance(rational_fit(noise, 100.0, 0.002), Refusal)
    short = truncated([(100.0, 0.01, 1.0)], 8.0).between(99.7, 100.3)
    assert "lines about the mode" in rational_fit(short, 100.0, 0.01).why


def test_lscf_finds_stable_modes_and_refuses_where_there_is_none():
    rng = np.random.default_rng(0)
    frf = truncated([(100.0, 0.003, 1.0), (110.0, 0.005, 0.7)], 8.0)
    noise = 1e-3 * np.abs(frf.H).max() * (rng.normal(size=len(frf.H)) + 1j * rng.normal(size=len(frf.H)))
    frf = Frf(frf.frequency_hz, frf.H + noise, frf.motion)
    poles = lscf_poles([frf.between(90, 120)])
    for f, zeta in ((100.0, 0.003), (110.0, 0.005)):
        found = lscf(poles, f, 0.0, 1.0)
        assert isinstance(found, DampingEstimate)
        assert found.ratio == pytest.approx(zeta, rel=5e-2)
    assert isinstance(lscf(poles, 95.0, 0.0, 0.1), Refusal)
