import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fitting.laws.generalised_maxwell import GeneralisedMaxwell
from fitting.laws.ghm import GollaHughesMcTavish


def test_runs_from_g0_to_all_terms_together():
    law = GollaHughesMcTavish(0.3e6, (0.8, 6.0), (1.5, 0.9), (1e3, 2e4))
    np.testing.assert_allclose(law.modulus(np.array([1e-3, 1e10])).real, [0.3e6, 0.3e6 * 7.8], rtol=1e-4)
    assert law.names == ["g0_pa", "alpha_1", "alpha_2", "zeta_1", "zeta_2", "omega_1_rad_s", "omega_2_rad_s"]


def test_a_term_at_its_own_frequency_has_the_value_by_hand():
    # s = i omega_k: (-1 + 2 i zeta)/(2 i zeta) = 1 + i/(2 zeta).
    law = GollaHughesMcTavish(1e6, (2.0,), (0.8,), (1e3,))
    assert law.modulus(np.array([1e3]))[0] == pytest.approx(1e6 * (1 + 2 * (1 + 1j / 1.6)))


@given(st.floats(1.01, 50), st.floats(2, 1000))
def test_an_overdamped_term_is_two_relaxing_elements(zeta, f):
    # Poles at -omega (zeta -+ root), root = sqrt(zeta^2 - 1). One element's modulus is negative, which the
    # generalised Maxwell law refuses: the two are summed here.
    law, root = GollaHughesMcTavish(1e6, (3.0,), (zeta,), (1e4,)), np.sqrt(zeta**2 - 1)
    slow, fast = (zeta - root) * 1e4, (zeta + root) * 1e4
    s = 2j * np.pi * f
    # s (s + 2 zeta omega)/((s + slow)(s + fast)) in partial fractions, slow + fast = 2 zeta omega
    relaxed = (fast * s / (s + slow) - slow * s / (s + fast)) / (fast - slow)
    assert law.modulus(np.array([2 * np.pi * f]))[0] == pytest.approx(1e6 * (1 + 3 * relaxed), rel=1e-9)


def test_strong_damping_is_a_maxwell_element():
    law = GollaHughesMcTavish(1e6, (3.0,), (50.0,), (1e5,))
    maxwell = GeneralisedMaxwell(1e6, (3e6,), (2 * 50.0 / 1e5,))
    omega = 2 * np.pi * np.geomspace(2, 1000, 30)
    np.testing.assert_allclose(law.modulus(omega), maxwell.modulus(omega), rtol=3e-4)


@given(
    st.floats(0.01, 100), st.floats(0.05, 40), st.floats(0.01, 100), st.floats(0.05, 40), st.floats(1, 1e5)
)
def test_positive_terms_lose_energy_at_every_frequency(a_1, z_1, a_2, z_2, omega):
    law = GollaHughesMcTavish(1e6, (a_1, a_2), (z_1, z_2), (1e3, 5e3))
    assert law.modulus(np.array([omega]))[0].imag >= 0


@given(st.floats(0.05, 0.49), st.floats(0.01, 100))
def test_a_term_that_takes_the_stiffness_away_is_objected_to(zeta, alpha):
    # The least of a term's real part is 1 - 1/(4 zeta (1 - zeta)).
    least = 1 + alpha * (1 - 1 / (4 * zeta * (1 - zeta)))
    law = GollaHughesMcTavish(1e6, (alpha,), (zeta,), (1e3,))
    lowest = law.modulus(1e3 * np.linspace(0, 1.5, 3001)).real.min()
    assert lowest >= 1e6 * least * (1 - 1e-9) - 1e-3
    if abs(least) > 1e-6:
        assert bool(law.objections()) == (least < 0)


def test_critically_damped_terms_are_not_objected_to():
    assert not GollaHughesMcTavish(1e6, (100.0, 1.0), (1.0, 0.5), (1e3, 2e3)).objections()
