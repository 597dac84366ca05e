import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fitting.laws.adf import AnelasticDisplacementFields
from fitting.laws.generalised_maxwell import GeneralisedMaxwell

positive = st.floats(1e-2, 1e2)
rates = st.floats(1.0, 1e6)


@given(positive, positive, rates, rates)
def test_it_is_the_generalised_maxwell_series(delta_1, delta_2, omega_1, omega_2):
    law = AnelasticDisplacementFields(0.3e6, (delta_1, delta_2), (omega_1, omega_2))
    series = GeneralisedMaxwell(0.3e6, (0.3e6 * delta_1, 0.3e6 * delta_2), (1 / omega_1, 1 / omega_2))
    omega = np.geomspace(0.1, 1e7, 40)
    np.testing.assert_allclose(law.modulus(omega), series.modulus(omega), rtol=1e-12)


def test_a_field_at_its_own_rate_is_half_relaxed():
    law = AnelasticDisplacementFields(1e6, (2.0,), (500.0,))
    assert law.modulus(np.array([500.0]))[0] == pytest.approx(1e6 * (1 + 2 * (1 + 1j) / 2))
    assert law.names == ["g0_pa", "delta_1", "omega_1_rad_s"]
