"""Where a proposed measurement is made, drawn."""

from dataclasses import replace

from following_cases import BACKWARDS, SPOT

from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Face
from fitting.structures import ShearPair
from instrument.facts.follow_up import FollowUp
from instrument.results.offer_sketch import offer_view

PLATE = PlateSpecimen(0.3, 0.2, "cantilever", Face(2e-3, 70e9, 0.3, 2700.0), pickup_m=(0.1, 0.1))
NOWHERE = FollowUp.model_validate(BACKWARDS)
AIMED = FollowUp.model_validate(SPOT)
FREE = AIMED.but(
    kind="damped_struck", held="free", struck_mm=(285.0, 180.0), spot_mm=(15.0, 20.0), todo="Hang it."
)


def test_a_plate_that_hangs_free_has_no_clamp_and_says_where_it_is_hit_and_read():
    view = offer_view(PLATE, [NOWHERE, FREE])
    assert [(m.name, m.x, m.y) for m in view.marks] == [("laser", 15.0, 20.0), ("hit", 285.0, 180.0)]
    assert [b.kind for b in view.boxes] == ["bare"]
    assert view.title == "Seen from above, hung free, the edge that was clamped on the left: Hang it."


def test_struck_in_its_clamp_the_laser_stays_where_it_is():
    view = offer_view(PLATE, [FREE.but(held="clamped", spot_mm=None)])
    assert [(m.name, m.x) for m in view.marks] == [("spot", 100.0), ("hit", 285.0)]
    assert "held" in {b.kind for b in view.boxes}


def test_the_first_that_says_a_place_is_drawn():
    heavier = AIMED.but(kind="added_mass", spot_mm=None, mass_kg=5e-3, mass_at_mm=(280.0, 100.0))
    assert [m.name for m in offer_view(PLATE, [heavier, AIMED]).marks] == ["spot", "5 g"]
    assert [m.name for m in offer_view(PLATE, [AIMED, heavier]).marks] == ["laser"]
    assert offer_view(PLATE, [NOWHERE]) is None
    pair = object.__new__(ShearPair)
    assert offer_view(pair, [AIMED]) is None
    assert offer_view(replace(PLATE, pickup_m=None), []) is None
