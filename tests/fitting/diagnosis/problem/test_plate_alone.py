"""What is a plate's own."""

from dataclasses import replace

from shear_pair_cases import pair
from supported_plate import supported

from fitting.diagnosis.problem.plate_alone import plate_alone
from fitting.laws.constant import ConstantModulus

PLATE = supported(ConstantModulus(1e6, 0.5), (8, 6))


def test_a_plate_is_the_same_wherever_it_is_driven_and_read():
    elsewhere = replace(PLATE, force_m=None, pickup_m=(0.1, 0.1), further_pickups_m=((0.2, 0.2),))
    assert plate_alone(elsewhere) == plate_alone(PLATE)
    assert plate_alone(replace(PLATE, length_m=0.31)) != plate_alone(PLATE)


def test_another_structure_is_left_as_it_is():
    specimen = pair(0.2)
    assert plate_alone(specimen) is specimen
