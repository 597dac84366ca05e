"""Sketches to scale: the numbers of the specimen, in mm."""

from dataclasses import replace

import pytest

from fitting.specimen import PlacedMass
from instrument.files.new_file import TEMPLATES
from instrument.files.structure_file import read_structure
from instrument.results.sketch import Mark, sketch_of
from instrument.results.sketch_figure import sketch_figure


def read(kind):
    return read_structure(TEMPLATES[kind])


def kinds(view, kind):
    return [b for b in view.boxes if b.kind == kind]


def test_a_beam_is_as_long_as_stated_and_its_section_has_its_layers():
    side, section = sketch_of(read("beam"))
    assert max(b.x + b.width for b in side.boxes) == pytest.approx(200.0)
    (clamp,) = kinds(side, "held")
    assert clamp.x + clamp.width == pytest.approx(0.0)
    assert (side.marks[0].x, side.marks[0].y) == pytest.approx((150.0, 4.5))
    assert [b.height for b in section.boxes] == pytest.approx([2.0, 0.5, 2.0])
    assert {b.width for b in section.boxes} == {10.0}


def test_ends_and_sides_are_drawn_as_they_are():
    beam = read("beam")
    assert len(kinds(sketch_of(replace(beam, boundary="clamped-clamped"))[0], "held")) == 2
    assert not kinds(sketch_of(replace(beam, boundary="free-free"))[0], "held")
    centre = sketch_of(replace(beam, boundary="centre-driven", both_sides=True))
    assert min(b.x for b in centre[0].boxes) == pytest.approx(-100.0)
    assert [b.height for b in centre[1].boxes] == pytest.approx([2.0, 0.5, 2.0, 0.5, 2.0])


def test_a_pairs_discs_are_to_scale_holes_and_all():
    (view,) = sketch_of(read("shear-pair"))
    discs = kinds(view, "core")
    assert len(discs) == 4
    assert {round(b.height, 9) for b in discs} == {10.0}
    assert {b.width for b in discs} == {6.0}
    (one,) = sketch_of(replace(read("shear-pair"), discs=1, gyration_m=None))
    assert len(kinds(one, "core")) == len(kinds(one, "held")) == 1


def test_a_plates_edges_patches_and_points_are_drawn():
    plate = replace(
        read("plate"), boundary="clamped-free-simply-supported-free", masses=(PlacedMass(5e-3, 0.1, 0.05),)
    )
    (view,) = sketch_of(plate, (Mark(1.0, 2.0, "hit", "hit"),))
    assert len(kinds(view, "held")) == len(kinds(view, "support")) == 1
    assert [m.name for m in view.marks] == ["spot", "5 g", "hit"]
    figure = sketch_figure((view,))
    assert figure.axes[0].get_aspect() == 1.0
    written = {text.get_text() for text in figure.axes[0].texts}
    size = {f"{1e3 * plate.length_m:g} mm", f"{1e3 * plate.width_m:g} mm"}
    assert written == {f"spot {view.marks[0].x:g}, {view.marks[0].y:g}", "5 g 100, 50", "hit 1, 2"} | size


def test_a_beam_that_a_force_drives_has_its_points_and_no_base_that_moves():
    beam = replace(read("beam"), force_m=0.02, pickup_m=0.09, further_pickups_m=(0.15,))
    side, _ = sketch_of(beam)
    assert [(m.name, round(m.x)) for m in side.marks] == [("spot 0", 90), ("spot 1", 150), ("force", 20)]
    assert not side.arrows
    assert sketch_of(read("beam"))[0].arrows
