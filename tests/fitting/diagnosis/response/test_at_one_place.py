"""How what is read goes with the core's modulus where the base moves and turns."""

import numpy as np

from fitting.diagnosis.response.at_one_place import At, OfPlate


def test_what_is_read_of_a_turning_base_goes_with_the_modulus_too():
    one, none = np.ones(2, complex), np.zeros(2, complex)
    plate = OfPlate(one, one, 2 * one, one, None, None, None, turned_slope=5 * one)
    pitch = np.array([0.0, 0.4 + 0j])
    at = At(one, one, 3 * one, pitch, none, plate)
    np.testing.assert_allclose(at.per_G, [3 * 2, 3 * (2 + 0.4 * 5)])
