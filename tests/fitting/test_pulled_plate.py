"""A plate that clamps on opposite edges pull along."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from pulled_bar import FACE, LENGTH_M, exact_hz

from fitting.dynamics.real_modes import real_modes
from fitting.effects import CATALOGUE
from fitting.effects.axial_stress import AxialStressEffect
from fitting.identification.adjusted import stated_number
from fitting.nuisances.nuisance import Nuisance
from fitting.plate.layers_array import layers_of, specimen_of
from fitting.plate.part_names import names_of
from fitting.plate.parts import coefficients
from fitting.plate.plate import Plate
from fitting.plate.plate_numbers import moved, plate_numbers
from fitting.specimen import PlateSpecimen
from fitting.stated.patches import Patch

STRIP = PlateSpecimen(
    LENGTH_M, 0.02, "clamped-free-clamped-free", replace(FACE, poisson=1e-9), elements=(60, 4)
)


@pytest.mark.parametrize("stress_mpa", [-8.0, 0.0, 20.0])
@pytest.mark.parametrize("along", ["x", "y"])
def test_a_strips_frequencies_are_those_of_a_bar_with_an_axial_force(along, stress_mpa):
    plate = STRIP
    if along == "y":
        sides = {"length_m": STRIP.width_m, "width_m": STRIP.length_m, "elements": STRIP.mesh[::-1]}
        plate = PlateSpecimen(**sides, boundary="free-clamped-free-clamped", substrate=STRIP.substrate)
    pulled = moved(plate, [f"axial_{along}"], [1e6 * stress_mpa])
    found = real_modes(Plate(pulled), 0.0, 2).omega / (2 * np.pi)
    assert found == pytest.approx(exact_hz(1e6 * stress_mpa, 2), rel=2e-4)


def test_clamps_on_opposite_edges_pull_and_others_do_not(zn1):
    assert zn1.axial_pa == (None, None)
    assert not any(kind == "axial" for _, kind in plate_numbers(zn1))
    framed = replace(zn1, boundary="clamped-clamped-clamped-clamped")
    assert framed.pulled_along == ("x", "y")
    assert [n for n in plate_numbers(framed) if n[1] == "axial"] == [
        ("axial_x", "axial"),
        ("axial_y", "axial"),
    ]
    # Let go it is still the plate that they pulled: the same parts.
    assert names_of(replace(framed, boundary="free")) == names_of(framed)
    corner = replace(zn1, boundary="clamped-clamped-free-free")
    assert corner.pulled_along == ()
    assert CATALOGUE["axial_stress"].standing_on(corner) is None
    x = Nuisance("axial_x", "axial", 2e6)
    assert stated_number(moved(framed, ["axial_x"], [3e6]), x) == (3e6, 1e-6, "MPa")


def test_what_is_kept_of_a_plate_has_its_stress(zn1):
    pulled = replace(zn1, boundary="clamped-free-clamped-free", axial_pa=(4e6, None))
    again = specimen_of(np.array([zn1.length_m, zn1.width_m, *zn1.mesh]), layers_of(pulled))
    assert again.axial_pa == (4e6, None)
    np.testing.assert_array_equal(coefficients(again, again).all, coefficients(pulled, pulled).all)
    assert specimen_of(np.array([0.2, 0.1, 8, 8]), layers_of(zn1)).axial_pa == (None, None)


def test_both_faces_are_pulled_or_under_patches_the_substrate(zn1):
    b, c = zn1.substrate.thickness_m, zn1.constraining.thickness_m
    assert zn1.pulled_thickness_m == b + c
    assert replace(zn1, both_sides=True).pulled_thickness_m == b + 2 * c
    assert replace(zn1, patches=(Patch(0.0, 0.1, 0.0, 0.1),)).pulled_thickness_m == b
    assert zn1.bare.pulled_thickness_m == b


@pytest.mark.parametrize(("form", "along"), [(AxialStressEffect(), "x"), (AxialStressEffect("y"), "y")])
def test_the_effect_changes_a_plate_to_one_that_states_as_much_more(zn1, form, along):
    framed = replace(zn1, boundary="clamped-clamped-clamped-clamped")
    count = sum(names_of(framed).counts.each)
    plate = SimpleNamespace(
        specimen=framed,
        coefficients=coefficients(framed, framed),
        parts=np.eye(count),
        load_part=np.ones(1),
    )
    found = form.change(plate, np.array([12.0]))
    stated = coefficients(moved(framed, [f"axial_{along}"], [12e6]), framed)
    more = stated.K_0 - plate.coefficients.K_0
    assert np.any(more)
    np.testing.assert_allclose(found.K, more @ np.eye(len(more), count))


def test_more_than_its_tolerance_is_an_effect_of_each_side():
    along_x, along_y = CATALOGUE["axial_stress"].standing_on(STRIP).variants()
    assert isinstance(along_x, AxialStressEffect)
    assert along_x.story({"stress_x": 12.0}) == "its clamps pull the plate along x with 12 MPa in its faces"
    assert "press the plate along y with 3 MPa" in along_y.story({"stress_y": -3.0})
