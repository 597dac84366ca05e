"""Which files are of one mounting."""

from dataclasses import replace

import pytest

from fitting.diagnosis.several.mountings import mountings, of_mounting
from fitting.specimen import PlacedMass, PlateSpecimen
from fitting.stated.layers import Face

SHAKEN = PlateSpecimen(
    0.3, 0.2, "cantilever", Face(2e-3, 70e9, 0.3, 2700.0), pickup_m=(0.1, 0.1), reads="absolute"
)
STRUCK = replace(SHAKEN, force_m=(0.28, 0.1), pickup_m=(0.2, 0.15), tolerances={"force": 2e-3, "gain": 0.01})
HEAVIER = replace(SHAKEN, masses=(PlacedMass(5e-3, 0.3, 0.1),))
FREE = replace(STRUCK, boundary="free")


class Member:
    def __init__(self, specimen):
        self.nuisances = type("Stated", (), {"specimen": specimen})


@pytest.mark.parametrize(
    ("stated", "expected"),
    [
        ([SHAKEN, STRUCK], (0, 0)),
        ([STRUCK, SHAKEN], (1, 1)),
        # Clamped anew in between: the last clamp is the one it is struck in.
        ([SHAKEN, SHAKEN, STRUCK], (0, 1, 1)),
        ([SHAKEN, STRUCK, SHAKEN, STRUCK], (0, 0, 2, 2)),
        ([SHAKEN, FREE], (0, 1)),
        ([SHAKEN, HEAVIER, STRUCK], (0, 1, 0)),
        ([SHAKEN, replace(STRUCK, width_m=0.21)], (0, 1)),
    ],
)
def test_a_blow_leaves_the_plate_in_its_clamp(stated, expected):
    assert mountings([Member(s) for s in stated], tuple(range(len(stated)))) == expected


def test_what_is_struck_alone_is_mounted_once():
    assert mountings([Member(FREE), Member(FREE)], (0, 0)) == (0, 0)
    assert of_mounting([FREE, FREE], 1, 1) == 1
