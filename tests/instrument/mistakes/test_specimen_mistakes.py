"""Specimens that may have been meant."""

from dataclasses import replace

import beam_tables
import shear_pair_cases

from instrument.mistakes.specimen_mistakes import specimen_mistakes


def test_a_plate_may_be_read_from_elsewhere_or_be_in_another_unit(zn1):
    found = dict(specimen_mistakes(zn1))
    assert found["pickup.x_mm is from the free end, expected from the clamp"].pickup_m[0] == (
        zn1.length_m - zn1.pickup_m[0]
    )
    assert found["length, width and pickup are in cm, expected mm"].width_m == 10 * zn1.width_m
    exchanged = found["plate.length_mm and plate.width_mm are exchanged"]
    assert (exchanged.length_m, exchanged.width_m) == (zn1.width_m, zn1.length_m)
    thin = found["the thicknesses of core and constraining layer are exchanged"]
    assert thin.core.thickness_m == zn1.constraining.thickness_m


def test_a_plate_whose_sides_seem_exchanged_may_be_held_at_another_edge(zn1):
    instead = ", or plate.boundary is meant to be 'cantilever'"
    at = min(zn1.length_m, zn1.width_m) / 3
    held = replace(zn1, boundary="free-clamped-free-free", pickup_m=(at, at))
    assert f"plate.length_mm and plate.width_mm are exchanged{instead}" in dict(specimen_mistakes(held))
    # Read elsewhere in x and y, it is the edge alone only where the pickup goes along.
    held = replace(held, pickup_m=(at, 2 * at))
    found = dict(specimen_mistakes(held))
    assert "plate.length_mm and plate.width_mm are exchanged" in found
    assert f"length and width are exchanged, and the pickup's with them{instead}" in found
    assert not any("boundary" in words for words, _ in specimen_mistakes(replace(held, boundary="free")))


def test_a_beam_may_be_read_and_struck_from_the_other_end():
    beam = replace(beam_tables.BEAM, pickup_m=0.3, force_m=0.05)
    found = dict(specimen_mistakes(beam))
    both = found["pickup and excitation are from the free end, expected from the clamped one"]
    assert (both.pickup_m, both.force_m) == (beam.span_m - 0.3, beam.span_m - 0.05)
    assert found["pickup.x_mm and excitation.x_mm are exchanged"].pickup_m == 0.05


def test_a_pair_has_no_places():
    assert not list(specimen_mistakes(shear_pair_cases.pair(0.5)))
