"""The simulated damped plate, held to be struck and driven again."""

import numpy as np
import pytest

from drivers.simulated.drive import DrivePiece
from drivers.simulated.plant.bare import bare_structure
from drivers.simulated.plant.effects import Effects
from drivers.simulated.plates import DampedPlate, HammerInHand

HIT, READ = (0.285, 0.18), (0.015, 0.02)
STEP_S = 1 / 8192


def hang(effects, law, hit_m, read_m):
    """Any structure will do: what is asked is when it is heard."""
    return bare_structure(effects, hit_m, read_m, 0.0)


@pytest.fixture
def plate():
    return DampedPlate(Effects(), hang=hang, hand=HammerInHand(0, 1))


def reads(plate, output="velocity", first_s=0.0):
    return np.abs(plate.at(output, first_s, STEP_S, 4096)).max()


@pytest.mark.parametrize("free", [True, False])
def test_a_blow_is_felt_and_the_base_rests(plate, free):
    plate.strike(HIT, READ if free else None, free=free)
    assert reads(plate) == 0.0
    plate.hit(0.0)
    assert 60.0 < reads(plate, "force") < 120.0
    assert reads(plate) > 0.01
    assert reads(plate, "base_acceleration") == reads(plate, "base_velocity") == 0.0


def test_driven_in_its_clamp_it_is_struck_no_more(plate):
    plate.strike(HIT, None, free=False)
    plate.hit(0.0)
    plate.drive(DrivePiece(0.0, 40.0, 1.0, 0.0, 0.0))
    assert reads(plate, "base_acceleration") > 0.0
    with pytest.raises(ValueError, match="nobody said where to hit"):
        plate.hit(0.0)


def test_hung_free_it_is_not_driven_until_it_is_clamped(plate):
    plate.strike(HIT, READ, free=True)
    plate.drive(DrivePiece(0.0, 40.0, 1.0, 0.0, 0.0))
    assert reads(plate, "base_acceleration") == 0.0
    plate.clamp()
    plate.drive(DrivePiece(0.0, 40.0, 1.0, 0.0, 0.0))
    assert reads(plate, "base_acceleration") > 0.0


def test_blows_land_beside_their_mark_and_the_same_in_every_run():
    places = [[HammerInHand(0, 3).lands_at(HIT)] for _ in range(2)]
    assert places[0] == places[1]
    hand = HammerInHand(0, 3)
    off = np.array([hand.lands_at(HIT) for _ in range(400)]) - HIT
    np.testing.assert_allclose(off.std(axis=0), 1e-3, rtol=0.15)


def test_what_cannot_be_hung_says_so():
    with pytest.raises(ValueError, match="cannot be hung free here"):
        DampedPlate(Effects()).strike(HIT, READ, free=True)
