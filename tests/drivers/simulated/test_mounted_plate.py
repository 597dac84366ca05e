from drivers.simulated.mounted_plate import CanBeChanged, CanBeHit, CanBePlaced, CanBeStruck
from drivers.simulated.plates import DampedPlate, OnShaker, SimulatedBarePlate


def test_each_plate_lets_be_done_to_it_what_is_done_at_a_real_rig():
    every = (CanBeChanged, CanBeStruck, CanBePlaced, CanBeHit)
    assert [issubclass(DampedPlate, one) for one in every] == [True, True, False, True]
    assert [issubclass(SimulatedBarePlate, one) for one in every] == [False, False, True, True]
    assert not any(issubclass(OnShaker, one) for one in every)
