"""Where fits of several temperatures begin: laws by their curves alone."""

import numpy as np
import pytest
from temperature_cases import LAW, REFERENCE, T

from fitting.laws.bent_law import BentLaw
from fitting.temperature.one_law import OneLaw
from fitting.temperature.shifted_law import ShiftedLaw
from fitting.temperature.shifts import Shift
from fitting.temperature.start import laws_near, start_of

BANDS = [(14.0, 300.0)] * len(T)
SHIFT = Shift("arrhenius", T, REFERENCE)
ENERGY = np.array([1.2e5])
LOG_A = SHIFT.log_shift(ENERGY)
ONE = OneLaw(LAW, SHIFT, tuple(SHIFT.positive(ENERGY).tolist()), (7,) * len(T))


def test_curves_of_one_material_are_laid_over_each_other():
    laws = [ShiftedLaw(LAW, float(np.exp(s)), 1.0) for s in LOG_A]
    omega = 2 * np.pi * np.geomspace(*BANDS[0], 9)
    begun = laws_near(ONE, [LAW] * len(T), BANDS)
    law, log_a = start_of(begun, BANDS, T, REFERENCE)
    np.testing.assert_allclose(log_a, LOG_A, atol=0.15)
    np.testing.assert_allclose(law.modulus(omega), laws[list(T).index(REFERENCE)].modulus(omega), rtol=0.03)


@pytest.mark.parametrize("off", [1.0, 30.0])
def test_a_law_of_each_temperature_near_one_law_has_its_own_form_unbent(off):
    form = BentLaw.over(LAW.with_values(LAW.values * np.array([1.0, off, 1.0, 1.0])), np.array(BANDS[0]))
    form = form.with_values(np.append(form.plain.values, np.full(form.bend_count, 1.5)))
    omega = 2 * np.pi * np.geomspace(*BANDS[0], 9)
    for k, law in enumerate(laws_near(ONE, [form] * len(T), BANDS)):
        assert isinstance(law, BentLaw)
        assert set(law.bend) == {1.0}
        np.testing.assert_allclose(law.modulus(omega), ONE.at(k).modulus(omega), rtol=0.01)
