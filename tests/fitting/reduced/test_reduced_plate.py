from dataclasses import replace

import numpy as np
import pytest

from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.direct import displacement_direct
from fitting.errors import OutsideModel
from fitting.laws.constant import ConstantModulus
from fitting.plate.plate import Plate
from fitting.reduced.domain import Domain, domain_of, highest_frequency_hz
from fitting.reduced.rational import rational_sweep
from fitting.reduced.reduced_plate import LARGEST_BASIS, MOST_FOLLOWING, reduce_plate


def random_points(count, seed):
    rng = np.random.default_rng(seed)
    omega = 2 * np.pi * rng.uniform(5, 600, count)
    size = np.exp(rng.uniform(np.log(1e4), np.log(2e7), count))
    return omega, size * np.exp(1j * np.arctan(rng.uniform(0, 2, count)))


@pytest.fixture(scope="module")
def reduced(zn1_models):
    return zn1_models.reduced


def test_rational_sum_agrees_with_direct_solves_at_random_points(reduced, zn1_models):
    omega, G = random_points(10, seed=7)
    x = displacement_direct(zn1_models.plate, zn1_models.damping, omega, G)
    found = rational_sweep(reduced, omega).displacement(G)
    assert np.max(np.abs(found / x - 1)) < 1e-6
    assert len(reduced.M) <= LARGEST_BASIS + MOST_FOLLOWING
    # the certificate covers what was seen, down to the direct solves' own rounding
    assert np.all(np.abs(found / x - 1) < 3 * reduced.estimated_error(omega, G) + 1e-9)


def test_certificate_holds_over_the_domain_and_breaks_beyond_it(reduced):
    omega, G = random_points(400, seed=3)
    assert reduced.estimated_error(omega, G).max() < 1e-5
    far = np.array([2 * np.pi * 3000.0])
    assert reduced.estimated_error(far, np.array([1e6 + 0j]))[0] > 1e-3


def test_rational_sum_is_the_reduced_plate(reduced):
    omega, G = random_points(50, seed=1)
    rational = rational_sweep(reduced, omega)
    np.testing.assert_allclose(rational.displacement(G), reduced.displacement(omega, G), rtol=1e-9)
    both = rational.displacement(np.array([G, 2 * G]))
    np.testing.assert_allclose(both[1], reduced.displacement(omega, 2 * G), rtol=1e-9)


def test_derivative_of_the_rational_sum_agrees_with_central_differences(reduced):
    omega, G = random_points(50, seed=2)
    rational = rational_sweep(reduced, omega)
    x, dx = rational.with_derivative(G)
    h = 1e-5 * G
    difference = (rational.displacement(G + h) - rational.displacement(G - h)) / (2 * h)
    assert np.max(np.abs(dx - difference) * np.abs(G) / np.abs(x)) < 1e-6 * np.max(np.abs(dx * G / x))


def test_raising_all_frequencies_moves_the_response_along_the_axis(reduced):
    # x(omega; all stiffness (1 + 2 s)) = x(omega/(1 + s)) / (1 + s)^2, but for the viscous damping
    omega, G = 2 * np.pi * np.array([60.0, 130.0]), np.array([0.3, 0.5]) * 1e6 * (1 + 0.8j)
    s = 1e-4
    moved = reduced.displacement(omega / (1 + s), G) / (1 + s) ** 2
    still = reduced.displacement(omega, G)
    np.testing.assert_allclose(reduced.answers(omega, G).by_frequency(), (moved - still) / s, rtol=2e-2)


def test_bare_plate_reduces_too(zn1):
    bare = replace(zn1.bare, elements=(16, 10))
    plate = Plate(bare)
    damping = viscous_damping(plate)
    reduced = reduce_plate(plate, damping, domain_of(bare, np.array([10.0, 100.0])))
    omega = 2 * np.pi * np.array([12.0, 17.7, 90.0, 400.0])
    zero = np.zeros(4, dtype=complex)
    np.testing.assert_allclose(
        reduced.displacement(omega, zero), displacement_direct(plate, damping, omega, zero), rtol=1e-6
    )


def test_layer_loss_factors_reach_the_reduced_plate(coarse):
    lossy = replace(coarse, substrate=replace(coarse.substrate, loss_factor=0.02), modal_ratios=())
    plate = Plate(lossy)
    damping = viscous_damping(plate)
    reduced = reduce_plate(plate, damping, domain_of(lossy, np.array([10.0, 100.0])))
    omega, G = random_points(5, seed=4)
    np.testing.assert_allclose(
        rational_sweep(reduced, omega).displacement(G),
        displacement_direct(plate, damping, omega, G),
        rtol=1e-5,
    )


def test_domain_stretches_to_stiff_cores_and_high_frequencies(zn1):
    stiff = zn1.with_law(ConstantModulus(200e6, 3.0))
    domain = domain_of(stiff, np.array([2.0, 1234.0]))
    assert domain.omega == pytest.approx((2 * np.pi * 1, 2 * np.pi * 1300))
    assert domain.modulus[1] >= 600e6
    assert domain.loss >= 3
    assert domain_of(zn1, np.array([10.0, 300.0])) == Domain(
        (2 * np.pi * 5, 2 * np.pi * 600), (1e4, 2e7), 2.0
    )


def test_frequency_beyond_the_mesh_is_refused(zn1):
    limit = highest_frequency_hz(zn1)
    assert 5e3 < limit < 2e4
    # the paper's own mesh carries its figure to 600 Hz
    assert highest_frequency_hz(replace(zn1, elements=(10, 10))) > 600
    with pytest.raises(OutsideModel, match="mesh"):
        domain_of(zn1, np.array([10.0, 1.1 * limit]))


def test_lossless_plate_without_damping_reduces(zn1):
    bare = replace(zn1.bare, elements=(16, 10), modal_ratios=())
    plate = Plate(bare)
    none = viscous_damping(plate)
    reduced = reduce_plate(plate, none, domain_of(bare, np.array([10.0, 100.0])))
    omega, zero = 2 * np.pi * np.array([15.0, 20.0, 100.0, 280.0]), np.zeros(4, dtype=complex)
    exact = displacement_direct(plate, none, omega, zero)
    np.testing.assert_allclose(reduced.displacement(omega, zero), exact, rtol=1e-5)
    np.testing.assert_allclose(rational_sweep(reduced, omega).displacement(zero), exact, rtol=1e-5)
