import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fitting.errors import OutsideModel
from fitting.laws import LAWS
from fitting.laws.adf import AnelasticDisplacementFields
from fitting.laws.constant import ConstantModulus
from fitting.laws.fractional_zener import FractionalZener
from fitting.laws.generalised_maxwell import GeneralisedMaxwell
from fitting.laws.ghm import GollaHughesMcTavish
from fitting.laws.isd112 import Isd112
from fitting.laws.smooth import Smooth
from fitting.laws.table import Tabulated

EXAMPLES = [
    FractionalZener(0.27e6, 4.1e6, 1.21e-4, 0.83),
    ConstantModulus(0.9e6, 0.5),
    GeneralisedMaxwell(0.2e6, (0.3e6, 1.2e6), (2e-3, 1e-4)),
    GollaHughesMcTavish(0.3e6, (0.8, 6.0), (1.5, 0.9), (1e3, 2e4)),
    AnelasticDisplacementFields(0.3e6, (0.8, 6.0), (4e2, 8e3)),
    Smooth((14.0, 50.0, 120.0, 300.0), (0.3e6, 0.4e6, 0.6e6, 1e6), (0.25, 0.5, 0.8, 0.9)),
    Isd112(),
    Tabulated((5.0, 20.0, 90.0, 400.0), (0.3e6, 0.4e6, 0.6e6, 1e6), (0.25, 0.5, 0.8, 0.9)),
]
frequencies = st.floats(2, 1000)


def test_every_law_has_an_example_here():
    assert {law.kind for law in EXAMPLES} == set(LAWS)


@pytest.mark.parametrize("law", EXAMPLES, ids=lambda law: law.kind)
@given(f=frequencies)
def test_derivatives_agree_with_central_differences(law, f):
    omega, h = np.array([2 * np.pi * f]), 1e-5
    jacobian = law.jacobian(omega)
    assert jacobian.shape == (len(law.names), 1)
    for k, p in enumerate(law.values):
        step = np.zeros(len(law.values))
        step[k] = p * h
        difference = law.with_values(law.values + step).modulus(omega) - law.with_values(
            law.values - step
        ).modulus(omega)
        # 1e-6 of the modulus for a parameter changed by its own size
        assert abs(jacobian[k, 0] * p - difference[0] / (2 * h)) < 1e-6 * abs(law.modulus(omega)[0])


@pytest.mark.parametrize("law", EXAMPLES, ids=lambda law: law.kind)
@given(f=frequencies)
def test_laws_are_passive(law, f):
    G, eta = law.storage_and_loss(np.array([2 * np.pi * f]))
    assert G[0] > 0
    assert eta[0] >= 0


@pytest.mark.parametrize("law", EXAMPLES, ids=lambda law: law.kind)
def test_values_make_the_same_law_again(law):
    assert law.with_values(law.values) == law
    if law.names:
        assert law.with_logs(np.log(law.values)).values == pytest.approx(law.values)


def test_fractional_zener_runs_from_g0_to_ginf():
    law = FractionalZener(0.3e6, 5e6, 1e-4, 0.8)
    G = law.modulus(np.array([1e-6, 1e14]))
    np.testing.assert_allclose(G.real, [0.3e6, 5e6], rtol=1e-3)


def test_fractional_zener_of_order_one_is_the_standard_linear_solid():
    law = FractionalZener(0.3e6, 5e6, 1e-4, 1.0)
    solid = GeneralisedMaxwell(0.3e6, (4.7e6,), (1e-4,))
    omega = np.geomspace(1, 1e6, 20)
    np.testing.assert_allclose(law.modulus(omega), solid.modulus(omega), rtol=1e-12)


def test_fractional_zener_loss_peaks_between_its_moduli_with_the_known_height():
    # At omega tau = 1: G = (G0 + Ginf z)/(1 + z) with z = e^{i alpha pi/2}.
    law = FractionalZener(1e6, 3e6, 1e-3, 0.5)
    z = np.exp(0.25j * np.pi)
    assert law.modulus(np.array([1e3]))[0] == pytest.approx((1e6 + 3e6 * z) / (1 + z))


def test_generalised_maxwell_runs_from_long_time_to_sum():
    law = GeneralisedMaxwell(0.2e6, (0.3e6, 1.2e6), (2e-3, 1e-4))
    np.testing.assert_allclose(law.modulus(np.array([1e-6, 1e12])).real, [0.2e6, 1.7e6], rtol=1e-6)
    assert law.names == ["g_inf_pa", "g_1_pa", "g_2_pa", "tau_1_s", "tau_2_s"]


def test_isd112_gives_the_printed_values():
    # Eq. (19) evaluated by hand at 100 Hz: s = 0.06634.
    G, eta = Isd112().storage_and_loss(np.array([2 * np.pi * 100]))
    assert G[0] == pytest.approx((2.783 - 1.023 / 0.43136) * 1e6)
    assert eta[0] == pytest.approx(1.683 + 0.001468 / 0.06634 - 0.5274 / 0.06634**0.25)


def test_isd112_refuses_where_its_print_makes_energy():
    with pytest.raises(OutsideModel, match="1 Hz or more"):
        Isd112().modulus(np.array([2 * np.pi * 0.5]))


@pytest.mark.parametrize(
    "make",
    [
        lambda: FractionalZener(-1.0, 5e6, 1e-4, 0.8),
        lambda: FractionalZener(0.3e6, 5e6, 1e-4, 1.5),
        lambda: FractionalZener(0.3e6, 5e6, 0.0, 0.5),
        lambda: ConstantModulus(1e6, -0.1),
        lambda: ConstantModulus(float("nan"), 0.1),
        lambda: GeneralisedMaxwell(0.2e6, (0.3e6,), (2e-3, 1e-4)),
        lambda: GeneralisedMaxwell(0.2e6, (), ()),
        lambda: GollaHughesMcTavish(0.3e6, (1.0, 2.0), (1.0,), (1e3, 1e4)),
        lambda: GollaHughesMcTavish(0.3e6, (), (), ()),
        lambda: GollaHughesMcTavish(0.3e6, (-1.0,), (1.0,), (1e3,)),
        lambda: GollaHughesMcTavish(0.3e6, (1.0,), (0.0,), (1e3,)),
        lambda: AnelasticDisplacementFields(0.3e6, (1.0, 2.0), (1e3,)),
        lambda: AnelasticDisplacementFields(0.3e6, (), ()),
        lambda: AnelasticDisplacementFields(0.3e6, (-1.0,), (1e3,)),
    ],
)
def test_unphysical_parameters_are_refused(make):
    with pytest.raises(OutsideModel, match="expected"):
        make()


def test_lossless_core_is_allowed():
    assert ConstantModulus(0.5e6, 0.0).modulus(np.array([1.0]))[0] == 0.5e6


def test_modulus_falling_with_frequency_is_objected_to():
    assert FractionalZener(2e6, 1e6, 1e-4, 0.8).objections()
    assert not EXAMPLES[0].objections()
