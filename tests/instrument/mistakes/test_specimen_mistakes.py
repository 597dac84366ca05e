"""Specimens that may have been meant."""

from dataclasses import replace

import beam_tables
import pytest
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


def test_layers_may_be_in_another_unit_too_or_one_ten_times_off(zn1):
    found = dict(specimen_mistakes(zn1))
    whole = found["all lengths and thicknesses are in inches, expected mm"]
    assert whole.length_m / zn1.length_m == pytest.approx(25.4)
    assert whole.pickup_m[0] / zn1.pickup_m[0] == pytest.approx(25.4)
    for name in ("substrate", "core", "constraining"):
        assert getattr(whole, name).thickness_m / getattr(zn1, name).thickness_m == pytest.approx(25.4)
    thinner = found["substrate.thickness_mm is ten times too large"]
    assert thinner.substrate.thickness_m == pytest.approx(zn1.substrate.thickness_m / 10)
    assert thinner.constraining == zn1.constraining
    assert "constraining.thickness_mm is ten times too small" in found
    beam = dict(specimen_mistakes(replace(beam_tables.BEAM, pickup_m=0.3)))
    all_in_cm = beam["all lengths and thicknesses are in cm, expected mm"]
    assert all_in_cm.substrate.thickness_m == pytest.approx(10 * beam_tables.BEAM.substrate.thickness_m)


def test_a_bare_plate_has_one_thickness(zn1):
    said = [words for words, _ in specimen_mistakes(zn1.bare)]
    assert "substrate.thickness_mm is ten times too small" in said
    assert not any("constraining" in words for words in said)


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
