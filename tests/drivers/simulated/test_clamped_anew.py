"""The simulated plate, clamped once more."""

import pytest

from drivers.simulated.plant.effects import ClampCompliance, Effects
from drivers.simulated.plates import DampedPlate

HZ = 20.0


def reads(plate):
    return plate.plant.steady_state(HZ)["spot_velocity"]


def test_a_clamp_that_gives_is_another_one_each_time_and_the_same_in_every_run():
    one, other = (DampedPlate(Effects(clamp_compliance=ClampCompliance(2e13, 2e13))) for _ in range(2))
    seen = [reads(one)]
    for _ in range(2):
        one.clamp()
        seen.append(reads(one))
    assert min(abs(a / b - 1) for k, a in enumerate(seen) for b in seen[:k]) > 1e-3
    other.clamp()
    assert reads(other) == pytest.approx(seen[1], rel=1e-12)


def test_a_rigid_clamp_is_as_rigid_as_before():
    plate = DampedPlate(Effects())
    before = reads(plate)
    plate.clamp()
    assert reads(plate) == pytest.approx(before, rel=1e-12)
