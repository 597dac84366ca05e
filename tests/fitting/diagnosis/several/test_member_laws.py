"""Laws of several sweeps in one."""

import numpy as np
import pytest

from fitting.diagnosis.several.member_laws import by_all, law_at
from fitting.laws.constant import ConstantModulus
from fitting.temperature.one_law import OwnLaws

SOFT, HARD = ConstantModulus(1e6, 0.5), ConstantModulus(4e6, 0.2)
OMEGA = 2 * np.pi * np.array([10.0, 20.0, 40.0])


def test_each_sweep_has_its_own_law_and_all_have_one_modulus_in_a_row():
    both = OwnLaws((SOFT, HARD), (2, 1))
    assert law_at(both, 1).modulus(OMEGA) == pytest.approx(HARD.modulus(OMEGA))
    assert law_at(SOFT, 1) is SOFT
    assert both.modulus(OMEGA) == pytest.approx(np.append(SOFT.modulus(OMEGA[:2]), HARD.modulus(OMEGA[2:])))


def test_derivatives_of_one_sweep_are_none_to_the_other_s_parameters():
    both, dv = OwnLaws((SOFT, HARD), (2, 1)), np.array([[1.0 + 1j], [2.0]])
    assert by_all(both, 1, dv)[:, 0] == pytest.approx([0, 0, 1 + 1j, 2])
    assert by_all(SOFT, 1, dv) is dv
