"""What somebody changes of the plate by hand: where the laser points, a known mass on it."""

import numpy as np
import pytest

from drivers.simulated.plant import grid
from drivers.simulated.plant.effects import AddedMass, ByHand, Effects, SpotOffset
from drivers.simulated.plant.model import shipped
from drivers.simulated.plant.sandwich import sandwich

SPOT_M, MASS = (0.25, 0.1), AddedMass(5e-3, 0.28, 0.1)


def test_another_spot_is_read_there_and_a_hidden_offset_stays():
    found = sandwich(Effects(spot_offset=SpotOffset(2e-3, 0.0)), by_hand=ByHand(spot_m=SPOT_M))
    n = len(found.structure.M)
    row = (grid.on_plate(SPOT_M[0] + 2e-3, SPOT_M[1]) @ shipped("sandwich")["w_top"])[:n]
    np.testing.assert_allclose(found.structure.readings[0], row)


def test_a_known_mass_is_as_a_hidden_one_and_comes_on_top_of_it():
    by_hand, hidden = sandwich(by_hand=ByHand(mass=MASS)), sandwich(Effects(added_mass=MASS))
    np.testing.assert_array_equal(by_hand.structure.M, hidden.structure.M)
    np.testing.assert_array_equal(by_hand.structure.loads, hidden.structure.loads)
    both = sandwich(Effects(added_mass=MASS), by_hand=ByHand(mass=MASS))
    twice = sandwich(Effects(added_mass=AddedMass(1e-2, MASS.x_m, MASS.y_m)))
    np.testing.assert_allclose(both.structure.M, twice.structure.M, atol=1e-12)


def test_a_spot_off_the_plate_is_refused():
    with pytest.raises(ValueError, match="off the plate"):
        sandwich(by_hand=ByHand(spot_m=(0.4, 0.1)))
