"""A reading and a force where stated numbers put them."""

from types import SimpleNamespace

import numpy as np
import pytest

from fitting.nuisances.placed import PlacedPoints
from fitting.nuisances.spots import StatedSpots

PLACES = {"pickup_x": 0, "force_y": 1, "length": 2}
SIGMA = np.array([2e-3, 1e-3, 3e-3])
PICKUP, FORCE = (0.2, 0.05), (0.1, 0.08)
Z = np.array([0.7, -0.4, 1.1])


class Curved:
    """Two motions, x^2 y and x y^2."""

    pickup_row = np.array([0.2**2 * 0.05, 0.2 * 0.05**2])
    observe = np.zeros(2)

    def row(self, x, y, dx=0, dy=0):
        if dx:
            return np.array([2 * x * y, y**2])
        return np.array([x**2, 2 * x * y]) if dy else np.array([x**2 * y, x * y**2])


def spots(zn1, **stated):
    return StatedSpots(PlacedPoints(zn1, zn1, PLACES, SIGMA), stated, stated)


@pytest.mark.parametrize(("spot", "at"), [("pickup", PICKUP), ("force", FORCE)])
def test_derivatives_are_those_of_the_row(zn1, spot, at):
    plate, its, h = Curved(), spots(zn1, pickup=PICKUP, force=FORCE), 1e-3
    change = its.row_change if spot == "pickup" else its.force_change
    by = its.rows_by(spot, plate, Z)
    assert set(by) == {PLACES[f"{spot}_{'x' if spot == 'pickup' else 'y'}"], PLACES["length"]}
    for k, slope in by.items():
        step = h * np.eye(3)[k]
        difference = (change(plate, Z + step) - change(plate, Z - step)) / (2 * h)
        np.testing.assert_allclose(slope, difference, rtol=1e-5)


def test_as_stated_nothing_changes(zn1):
    plate, its, none = Curved(), spots(zn1, pickup=PICKUP, force=FORCE), np.zeros(3)
    np.testing.assert_allclose(its.row(plate, none), plate.row(*PICKUP))
    np.testing.assert_allclose(its.row_change(plate, none), 0.0, atol=1e-12)
    np.testing.assert_allclose(its.force_change(plate, none), 0.0, atol=1e-12)


def test_what_no_force_drives_has_no_load_of_one(zn1):
    its = spots(zn1, pickup=PICKUP)
    assert its.force_change(Curved(), Z) == 0.0
    assert its.rows_by("force", Curved(), Z) == {}


def test_what_is_read_nowhere_keeps_its_row(zn1):
    plate = SimpleNamespace(observe=np.ones(2))
    np.testing.assert_array_equal(spots(zn1).row_change(plate, Z), np.zeros(2))
