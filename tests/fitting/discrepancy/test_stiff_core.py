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


def test_faces_thick_beside_the_plate_have_wider_elements(zn1):
    small = replace(zn1, length_m=0.06, width_m=0.04)
    assert for_its_core(small).mesh == (21, 14)
    assert for_its_core(replace(small, elements=(39, 26))).mesh == (39, 26)
    stiff = for_its_core(small.with_law(ConstantModulus(1e9, 0.1)))
    assert stiff.faces_shear
    assert stiff.mesh == (31, 21)
