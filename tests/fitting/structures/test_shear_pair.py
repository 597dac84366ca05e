from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shear_pair_cases import LAW, pair, transmissibility

from fitting.laws.constant import ConstantModulus
from fitting.structures.shear_pair import EDGE, disc, pad
from fitting.structures.small import displacement, nuisances_of, system_of
from fitting.structures.small_modes import small_modes, small_velocity
from fitting.structures.small_sum import rational_of


@settings(max_examples=40, deadline=None)
@given(
    mass=st.floats(0.01, 5.0),
    G=st.floats(1e5, 1e8),
    loss=st.floats(0.01, 1.5),
    f=st.floats(5.0, 2000.0),
)
def test_the_matrices_follow_the_wave_in_the_pad(mass, G, loss, f):
    p, modulus = pair(mass), np.array([G * (1 + 1j * loss)])
    omega = 2 * np.pi * np.array([f])
    if np.abs(omega[0] * np.sqrt(1100 / modulus[0]) * 6e-3) > 1.5:
        return
    T = 1 - omega**2 * displacement(system_of(p, p.parts()), omega, modulus)
    assert np.allclose(T, transmissibility(p, [f], modulus), rtol=1e-7)


def test_a_third_of_the_rubber_moves_with_the_mass():
    p = pair(0.2)
    (mode,) = small_modes(p, ConstantModulus(6e6, 0.3), 1)
    rubber = 1100 * p.discs * p.area_m2 * 6e-3
    expected = np.sqrt(6e6 * p.discs * p.area_m2 / 6e-3 / (0.2 + rubber / 3)) / (2 * np.pi)
    assert mode.frequency_hz == pytest.approx(expected, rel=1e-4)
    assert mode.loss_factor == pytest.approx(0.3, rel=1e-9)


def test_the_first_polynomial_is_the_massless_pad():
    P, dP, mean = pad(4)
    assert P[0, 0] == pytest.approx(1 / 3)
    assert dP[0, 0] == pytest.approx(1)
    assert mean[0] == pytest.approx(1 / 2)
    assert np.allclose(dP[0, 1:], 0)


def test_a_disc_s_area_and_gyration_are_an_annulus_s():
    area, gyration = disc(33.5e-3, 11.8e-3)
    assert area == pytest.approx(np.pi * (16.75**2 - 5.9**2) * 1e-6)
    # I = pi/4 (R^4 - r^4)
    assert gyration**2 * area == pytest.approx(np.pi / 4 * (16.75**4 - 5.9**4) * 1e-12)


def test_bending_softens_as_a_short_beam_of_rubber():
    p = pair(0.2, bending=True)
    # F t^3/(12 E I) beside F t/(G A), E = 3 G
    assert p.softer_by_bending == pytest.approx(6e-3**2 * p.area_m2 / (36 * p.area_m2 * p.gyration_m**2))
    stiff, soft = pair(0.2).coefficients({})[0], p.coefficients({})[0]
    assert (stiff / soft).real == pytest.approx(1 + p.softer_by_bending)


def test_the_rational_sum_is_the_full_solve():
    p, omega = pair(0.3), 2 * np.pi * np.geomspace(10, 2000, 50)
    system, G = system_of(p, p.parts()), LAW.modulus(omega)
    x = rational_of(system, omega, 1e6).displacement(G)
    assert np.allclose(x, displacement(system, omega, G), rtol=1e-10)


def test_predict_reads_the_mass_in_space():
    p, f = pair(0.3), np.array([20.0, 200.0, 900.0])
    G = LAW.modulus(2 * np.pi * f)
    expected = transmissibility(p, f, G) * 9.81 / (2j * np.pi * f)
    assert np.allclose(small_velocity(p, f), expected, rtol=1e-7)


def test_derivatives_to_stated_numbers_are_central_differences():
    p = pair(0.3)
    parts = p.parts()
    system, stated = system_of(p, parts), nuisances_of(p, parts, has_phase=True)
    omega = 2 * np.pi * np.array([60.0, 150.0, 700.0])
    G, z, h = LAW.modulus(omega), np.zeros(len(stated)), 1e-3

    def x(z):
        c = stated.change(system, z)
        A = (
            system.K_0
            + G[:, None, None] * (system.K_1 + c.K_1)
            - omega[:, None, None] ** 2 * (system.M + c.M)
        )
        load = np.broadcast_to((system.load + c.load).astype(complex)[:, None], (3, len(system.load), 1))
        return np.linalg.solve(A, load)[:, :, 0] @ system.observe

    A = system.K_0 + G[:, None, None] * system.K_1 - omega[:, None, None] ** 2 * system.M
    sides = np.stack([system.load, system.observe], axis=1).astype(complex)
    q, adjoint = np.moveaxis(np.linalg.solve(A, np.broadcast_to(sides, (3, *sides.shape))), 2, 0)
    found = stated.by_response(system, omega, G, q, adjoint, z)
    for k in range(len(stated)):
        step = h * (np.arange(len(stated)) == k)
        assert np.allclose(found[k], (x(step) - x(-step)) / (2 * h), rtol=1e-4, atol=1e-12)


def test_free_edges_take_their_share_and_follow_the_thickness():
    """6 mm thick, 10.85 mm wide: c t/(r_o - r_i); a thicker disc loses more."""
    plain, counted = pair(0.2), pair(0.2, edges=True)
    share = EDGE * 6e-3 / 10.85e-3
    by = {"core_thickness": 0.1}
    assert counted.coefficients({})[0] / plain.coefficients({})[0] == pytest.approx(1 - share)
    assert counted.coefficients(by)[0] / plain.coefficients(by)[0] == pytest.approx(1 - share * np.exp(0.1))
    assert replace(counted, gyration_m=None).coefficients({})[0] == plain.coefficients({})[0]
