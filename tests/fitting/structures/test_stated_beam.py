"""What is stated of a beam, and what follows of it without its theory."""

from dataclasses import replace

import pytest

from fitting.laws import LAWS
from fitting.stated.layers import Core, Face
from fitting.structures.stated_beam import StatedBeam

B, C = Face(1.5e-3, 69e9, 0.33, 2700.0), Face(0.5e-3, 210e9, 0.3, 7800.0)
CORE = Core(0.3e-3, 0.49, 1000.0, LAWS["fractional-zener"](5e5, 2e7, 1e-4, 0.6))
BEAM = StatedBeam(0.25, 0.02, "clamped-free", B, C, CORE, pickup_m=0.25, further_pickups_m=(0.1,))


@pytest.mark.parametrize(
    ("ends", "span_m", "copies", "held"),
    [
        ("clamped-free", 0.25, 1, 1),
        ("free-free", 0.25, 1, 0),
        ("clamped-clamped", 0.25, 1, 2),
        ("centre-driven", 0.125, 2, 1),
    ],
)
def test_a_beam_is_of_pieces_that_are_held(ends, span_m, copies, held):
    beam = replace(BEAM, boundary=ends)
    assert (beam.span_m, beam.copies, beam.held_ends) == (span_m, copies, held)
    assert (beam.held_width_m > 0) == (held > 0)


def test_poisson_s_ratio_is_that_of_the_stiffer_face_nearly():
    assert 0.3 < BEAM.poisson < 0.33
    assert replace(BEAM, constraining=None, core=None).poisson == 0.33


def test_what_moves_apart_is_weighed():
    """The heavier the other layers, the more of it the substrate does; of equal ones without a core half."""
    light = replace(CORE, density_kg_m3=1e-9)
    assert replace(BEAM, constraining=B, core=light).share == pytest.approx(0.5)
    assert replace(BEAM, both_sides=True).share > BEAM.share
    assert replace(BEAM, constraining=None).share == 0.0


def test_each_spot_is_a_beam_of_its_own():
    assert BEAM.pickups_m == (0.25, 0.1)
    assert BEAM.at_pickup(1).pickups_m == (0.1,)


def test_an_exact_beam_that_states_nothing_of_its_metal_is_as_stated_at_any_temperature():
    assert replace(BEAM, exact=True).at_temperature(40.0).temperature_c is None
    assert BEAM.at_temperature(40.0).temperature_c == 40.0


def test_a_force_leaves_the_ends_at_rest():
    assert replace(BEAM, reads="absolute", force_m=0.1).reads == "relative"
    assert replace(BEAM, force_m=0.1).drive_amplitude == 1.0


def test_what_is_offered_to_effects_is_said():
    assert {"base", "clamp", "one piece", "constraining", "whole"} == BEAM.offers
    assert "whole" not in replace(BEAM, both_sides=True).offers
    assert "two clamps" in replace(BEAM, boundary="clamped-clamped").offers
    assert "clamp" not in replace(BEAM, boundary="free-free").offers
