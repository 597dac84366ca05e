"""What a stiff core asks of a plate's model, by the law it states."""

from dataclasses import replace

from fitting.discrepancy.stiff_core import for_its_core
from fitting.laws.constant import ConstantModulus


def test_a_stiff_core_has_sheared_faces_and_smaller_elements(zn1):
    stiff = for_its_core(zn1.with_law(ConstantModulus(1e9, 0.1)))
    assert stiff.faces_shear
    assert stiff.mesh[0] > zn1.mesh[0]
    assert for_its_core(replace(stiff, elements=(12, 8))).mesh == (12, 8)


def test_a_soft_core_and_none_ask_for_nothing(zn1):
    assert for_its_core(zn1) == zn1
    assert for_its_core(zn1.bare) == zn1.bare
