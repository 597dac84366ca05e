"""What the name of a stated number says: its kind, of which one it is, along which axis."""

import pytest

from fitting.stated.number_names import NumberName, kind_of, number_name
from fitting.stated.tolerances import NUMBERS


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("length", NumberName("length")),
        ("pickup_y", NumberName("pickup", along="y")),
        ("damping_12", NumberName("damping", 12)),
        ("place_2_x", NumberName("place", 2, "x")),
        ("resonance_3 [2]", NumberName("resonance", 3)),
        ("substrate_young_y", NumberName("substrate_young_y")),
        # Of a beam, whose masses are weighed together.
        ("mass", NumberName("mass")),
        # As files of older versions call it.
        ("patch_1_x0", NumberName("patch")),
    ],
)
def test_a_name_is_a_kind_and_which_of_them(name, expected):
    assert number_name(name) == expected


@pytest.mark.parametrize("name", NUMBERS)
def test_every_kind_is_told_by_its_name(name):
    if name != "damping":
        assert kind_of(name) == name


@pytest.mark.parametrize(
    "name", ["", "damping", "damping_x", "damping_0", "damping_00", "damping_1_x", "elasticity", "_x"]
)
def test_what_no_number_is_called_is_refused(name):
    with pytest.raises(ValueError, match="no stated number is called"):
        number_name(name)


def test_items_and_axes_are_counted_from_none_and_missing_ones_are_refused():
    which = number_name("place_2_y")
    assert (which.item, which.axis, which.number.unit) == (1, 1, "m")
    for name in ("length", "mass_0"):
        with pytest.raises(LookupError, match="of which"):
            _ = number_name(name).item
    with pytest.raises(LookupError, match="which axis"):
        _ = number_name("mass_1").axis
