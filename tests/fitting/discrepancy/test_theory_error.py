from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from fitting.discrepancy.exact_layers import ElasticLayer, exact_lambda
from fitting.discrepancy.layer_theory import layerwise_lambda, wavenumber
from fitting.discrepancy.theory_error import (
    FREQUENCY_LIMIT,
    LOSS_LIMIT,
    check_theory,
    held_stack,
    stack,
    theory_error,
)
from fitting.dynamics.complex_modes import complex_modes
from fitting.errors import OutsideModel
from fitting.laws.constant import ConstantModulus
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face

BAND = np.array([20.0, 55.0, 100.0, 180.0, 280.0])


def plate_wave(specimen, m, n):
    return np.hypot(m * np.pi / specimen.length_m, n * np.pi / specimen.width_m)


def frequency_and_loss(value):
    return np.sqrt(value.real) / (2 * np.pi), value.imag / value.real


def traction(layers, k, value):
    """Determinant of the traction on the upper face, that on the lower being none: by transfer matrices.

    State (W, U, tau, sigma), each divided by the power of kappa it has in a thin plate.
    """
    h = sum(layer.thickness_m for layer in layers)
    kappa2, unit = (k * h) ** 2, 1e10
    through = np.eye(4)
    for layer in layers:
        G, nu = layer.shear_pa / unit, layer.poisson
        C_33, C_13 = 2 * G * (1 - nu) / (1 - 2 * nu), 2 * G * nu / (1 - 2 * nu)
        a, plane = C_13 / C_33, 2 * G / (1 - nu)
        inertia = layer.density_kg_m3 * value / kappa2**2 * h**2 / unit
        A = [
            [0, -kappa2 * a, 0, kappa2**2 / C_33],
            [1, 0, kappa2 / G, 0],
            [0, plane - kappa2 * inertia, 0, kappa2 * a],
            [-inertia, 0, -1, 0],
        ]
        through = expm(np.array(A) * layer.thickness_m / h) @ through
    return np.linalg.det(through[2:, :2])


def root_near(layers, k, value):
    """omega^2 of the exact theory by the secant rule on `traction`."""
    x, y = value * 1.0001, value * 0.9999
    at_x = traction(layers, k, x)
    for _ in range(20):
        at_y = traction(layers, k, y)
        if at_y == at_x:
            break
        x, y, at_x = y, y - at_y * (y - x) / (at_y - at_x), at_y
        if abs(y / x - 1) < 1e-12:
            break
    return y


def random_specimen(random):
    """Soft and stiff, thin and thick cores between thin and thick faces."""

    def log(low, high):
        return float(np.exp(random.uniform(np.log(low), np.log(high))))

    b, c = (
        Face(log(*t), log(3e9, 2.1e11), random.uniform(0.2, 0.4), log(1200, 7900), log(1e-4, 1e-2))
        for t in ((0.5e-3, 1e-2), (0.1e-3, 1e-2))
    )
    law = ConstantModulus(log(1e4, 1e9), log(0.02, 1.5))
    core = Core(log(0.05e-3, 1e-2), random.uniform(0.3, 0.495), log(50, 2000), law)
    return PlateSpecimen(log(0.1, 0.6), log(0.1, 0.6), "simply-supported", b, c, core)


def modulus(specimen):
    return complex(specimen.core.law.modulus(np.array([1.0]))[0])


def test_exact_plate_agrees_with_transfer_matrices(zn1):
    for G in (1e4 * (1 + 1j), 0.5e6 * (1 + 0.8j), 1e9 * (1 + 0.1j)):
        for thickness in (0.05e-3, 0.5e-3, 5e-3):
            layers = stack(replace(zn1, core=replace(zn1.core, thickness_m=thickness)), G)
            for k in (2.0, 20.0, 100.0):
                value = exact_lambda(layers, k)[0]
                assert root_near(layers, k, value) == pytest.approx(
                    value, rel=1e-6 if k * thickness > 0.2 else 1e-9
                )


def test_exact_single_layer_is_an_antisymmetric_lamb_wave():
    # Rayleigh and Lamb: tan(q h/2)/tan(p h/2) = -(q^2 - k^2)^2/(4 k^2 p q).
    h, G, nu, rho = 0.01, 26.5e9, 0.3, 2700.0
    k = np.array([20.0, 100.0, 300.0])
    value = exact_lambda((ElasticLayer(h, G, nu, rho),), k).real.astype(complex)
    p = np.sqrt(value * rho * (1 - 2 * nu) / (2 * G * (1 - nu)) - k**2)
    q = np.sqrt(value * rho / G - k**2)
    left = np.tan(q * h / 2) / np.tan(p * h / 2)
    np.testing.assert_allclose(left, -((q**2 - k**2) ** 2) / (4 * k**2 * p * q), rtol=1e-7)


def test_exact_plate_needs_no_higher_order(zn1):
    k = np.array([0.5, 5.0, 50.0])
    for G in (1e4 + 1e4j, 1e6 + 1e6j):
        layers = stack(replace(zn1, core=replace(zn1.core, thickness_m=5e-3)), G)
        np.testing.assert_allclose(exact_lambda(layers, k), exact_lambda(layers, k, 14), rtol=1e-6)


def test_layerwise_plate_has_the_published_modes(johnson_kienholz):
    k = np.array([plate_wave(johnson_kienholz, *mode) for mode in ((1, 1), (2, 1), (1, 2), (2, 2), (3, 1))])
    f, eta = frequency_and_loss(layerwise_lambda(johnson_kienholz, k, modulus(johnson_kienholz)))
    np.testing.assert_allclose(f, [60.237, 115.229, 130.433, 178.474, 195.437], rtol=3e-5)
    np.testing.assert_allclose(eta, [0.19013, 0.20344, 0.19920, 0.18062, 0.17369], atol=1e-5)


def test_layerwise_plate_is_the_limit_of_its_elements(johnson_kienholz):
    # Unlike faces, so that nothing cancels by symmetry.
    jk = replace(johnson_kienholz, constraining=replace(johnson_kienholz.constraining, thickness_m=0.3e-3))
    exact = layerwise_lambda(jk, plate_wave(jk, 1, 1), modulus(jk))[0]
    off = []
    for n in (8, 16):
        mode = complex_modes(Plate(replace(jk, elements=(n, n))), jk.core.law, 1)[0]
        off.append(mode.eigenvalue / exact - 1)
    assert abs((4 * off[1] - off[0]) / 3) < 2e-4
    assert abs(off[0] / off[1]) == pytest.approx(4, rel=0.1)


def test_wavenumber_is_where_the_plate_resonates(zn1):
    omega = 2 * np.pi * BAND
    G = zn1.core.law.modulus(omega)
    value = layerwise_lambda(zn1, wavenumber(zn1, omega, G), G)
    np.testing.assert_allclose(np.sqrt(value.real), omega, rtol=1e-9)


def test_exact_theory_with_all_assumptions_held_is_the_layerwise_one(zn1):
    k, G = np.array([5.0, 15.0, 40.0]), 0.5e6 * (1 + 0.8j)
    held = exact_lambda(held_stack(zn1, G), k)
    np.testing.assert_allclose(layerwise_lambda(zn1, k, G), held, rtol=2e-5)


def test_published_plate_is_well_within_its_theory(zn1):
    error = check_theory(zn1, zn1.core.law, BAND)
    np.testing.assert_allclose(
        error.frequency_error, [2.404e-5, 6.676e-5, 1.2327e-4, 2.2479e-4, 3.5246e-4], rtol=1e-3
    )
    np.testing.assert_allclose(
        error.loss_factor_error, [2.521e-5, 5.099e-5, 7.452e-5, 1.0416e-4, 1.2759e-4], rtol=1e-3
    )
    np.testing.assert_allclose(error.delta.real, -error.frequency_error, rtol=1e-2)
    assert error.worst_assumption.name == "faces stiff in shear"


def test_bare_plate_is_checked_too(zn1):
    error = check_theory(zn1.bare, None, BAND)
    assert np.all(error.loss_factor_error == 0)
    assert error.frequency_error[-1] == pytest.approx(3.88e-4, rel=1e-2)
    with pytest.raises(OutsideModel, match="resonance"):
        check_theory(zn1.bare, None, [6000.0])


@pytest.mark.parametrize(
    ("thickness_mm", "off"), [(0.5, "47.9 % below"), (5.0, "95.1 % below")], ids=["soft", "soft and thick"]
)
def test_soft_core_is_refused(zn1, thickness_mm, off):
    soft = replace(zn1, core=replace(zn1.core, thickness_m=thickness_mm * 1e-3))
    with pytest.raises(OutsideModel, match=rf"280 Hz: .* {off} .*limit 5 %.* faces no longer move together"):
        check_theory(soft, ConstantModulus(1e4, 0.8), BAND)


def test_thick_face_is_refused_for_its_shear(zn1):
    thick = replace(zn1, substrate=replace(zn1.substrate, thickness_m=0.03))
    with pytest.raises(
        OutsideModel, match=r"resonance .* above .*limit 0.5 %.* faces shear .* thinner faces"
    ):
        check_theory(thick, zn1.core.law, BAND)


def test_what_is_accepted_is_within_its_limits():
    random = np.random.default_rng(20)
    accepted = refused = 0
    for _ in range(200):
        s = random_specimen(random)
        G, k = modulus(s), plate_wave(s, *random.integers(1, 6, 2))
        layerwise = layerwise_lambda(s, k, G)[0]
        f, eta = frequency_and_loss(layerwise)
        error = theory_error(s, f, G)
        layers = stack(s, G)
        exact = root_near(layers, k, exact_lambda(layers, k)[0])
        f_exact, eta_exact = frequency_and_loss(exact)
        within = abs(f / f_exact - 1) < FREQUENCY_LIMIT and abs(eta / eta_exact - 1) < LOSS_LIMIT
        assert error.acceptable == within
        if not within:
            refused += 1
            continue
        accepted += 1
    assert min(accepted, refused) > 40
