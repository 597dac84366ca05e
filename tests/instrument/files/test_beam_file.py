"""What a beam's file may say of what drives it and where it is read."""

import pytest

from instrument.errors import BadInput
from instrument.files.beam_file import BeamDocument
from instrument.files.new_file import TEMPLATES
from instrument.files.structure_file import read_structure, read_structure_document

SANDWICH = """
[beam]
length_mm = 200.0
width_mm = 20.0
boundary = "{boundary}"
{more}
[substrate]
thickness_mm = 2.0
young_gpa = 70.0
poisson = 0.3
density_kg_m3 = 2700.0
[constraining]
thickness_mm = 0.5
young_gpa = 70.0
poisson = 0.3
density_kg_m3 = 2700.0
[core]
thickness_mm = 0.3
poisson = 0.49
density_kg_m3 = 1000.0
[core.law]
kind = "constant"
g_mpa = 1.0
loss_factor = 0.5
{tables}
"""
FORCE = '[excitation]\nkind = "force"\nx_mm = 20.0\n'


def written(tmp_path, tables, boundary="free-free", more=""):
    path = tmp_path / "beam.toml"
    path.write_text(SANDWICH.format(boundary=boundary, tables=tables, more=more))
    return path


def test_a_force_drives_a_free_beam_at_its_point(tmp_path):
    path = written(tmp_path, FORCE + "[pickup]\nx_mm = 150.0\n")
    beam = read_structure(path)
    assert (beam.drive, beam.force_m, beam.reads, beam.drive_amplitude) == ("force", 0.02, "relative", 1.0)
    document = read_structure_document(path)
    assert isinstance(document, BeamDocument)
    assert document.geometry["force_x_mm"] == 20.0


def test_several_spots_are_in_their_order(tmp_path):
    path = written(tmp_path, FORCE + "[[pickup]]\nx_mm = 0.0\n[[pickup]]\nx_mm = 150.0\n")
    beam = read_structure(path)
    assert beam.pickups_m == (0.0, 0.15)
    assert beam.at_pickup(1).pickup_m == 0.15
    assert beam.at_pickup(1).further_pickups_m == ()


def test_places_across_may_be_stated_as_of_a_plate_and_change_nothing(tmp_path):
    tables = FORCE + "[[mass]]\nmass_kg = 0.0015\nx_mm = 90.0\n[pickup]\nx_mm = 150.0\n"
    across = tables.replace("0\n", "0\ny_mm = 5.0\n")
    assert across.count("y_mm") == 3
    assert read_structure(written(tmp_path, across)) == read_structure(written(tmp_path, tables))


def test_a_clamp_that_holds_the_width_is_counted_where_the_file_says_so(tmp_path):
    path = written(tmp_path, "", "clamped-free", "held_width = true")
    assert read_structure(path).held_width


def test_a_layer_that_says_it_loses_nothing_is_not_one_that_says_nothing(tmp_path):
    path = written(tmp_path, "", "clamped-free")
    assert not read_structure(path).states_loss
    path.write_text(path.read_text().replace("[core]\n", "loss_factor = 0.0\n[core]\n"))
    assert read_structure(path).states_loss


def test_what_it_carries_is_stated_as_of_a_plate(tmp_path):
    mass = "[[mass]]\nmass_kg = 0.0015\nx_mm = 200.0\n"
    tolerances = "[tolerances]\nmass_percent = 1.0\nplace_mm = 0.2\n"
    beam = read_structure(written(tmp_path, mass + tolerances, "clamped-free"))
    assert [(m.mass_kg, m.x_m) for m in beam.masses] == [(0.0015, 0.2)]
    assert [beam.tolerance(name) for name in ("mass", "place")] == pytest.approx([0.01, 2e-4])


@pytest.mark.parametrize(
    ("tables", "boundary", "more", "said"),
    [
        ('[excitation]\nkind = "force"\n', "free-free", "", "expected x_mm of the point where it acts"),
        ("[excitation]\nx_mm = 20.0\n", "clamped-free", "", 'expected kind = "force"'),
        ("[excitation]\ny_mm = 5.0\n", "clamped-free", "", 'y_mm with kind = "base"'),
        (FORCE, "centre-driven", "", "the base drives its centre"),
        (FORCE.replace("20.0", "201.0"), "free-free", "", "excitation.x_mm = 201 is off the beam"),
        (FORCE + "y_mm = 21.0\n", "free-free", "", "excitation.y_mm = 21 is off the beam, expected 0 to 20"),
        (
            "[pickup]\nx_mm = 101.0\n",
            "centre-driven",
            "",
            "x_mm = 101 is off the beam, expected 0 to 100",
        ),
        ("[[pickup]]\nx_mm = 10.0\n[[pickup]]\nx_mm = 250.0\n", "clamped-free", "", "off the beam"),
        (FORCE + "[base]\nacceleration_m_s2 = 9.81\n", "clamped-free", "", "expected one of them"),
        ("", "free-free", "held_width = true", "expected a held end"),
        ("[[mass]]\nmass_kg = 1e-3\nx_mm = 50.0\n", "centre-driven", "", "would not move alike"),
        ("[[mass]]\nmass_kg = 1e-3\nx_mm = 250.0\n", "clamped-free", "", "mass.x_mm = 250 is off the beam"),
        (
            "[tolerances]\narea_percent = 1.0\n",
            "clamped-free",
            "",
            "area_percent: a beam has no such",
        ),
        (
            '[[pickup]]\nx_mm = 10.0\n[[pickup]]\nx_mm = 20.0\nreads = "absolute"\n',
            *("clamped-free", "", "pickups that read relative and absolute"),
        ),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(tmp_path, tables, boundary, more, said):
    with pytest.raises(BadInput, match=said.replace("(", r"\(")) as refused:
        read_structure(written(tmp_path, tables, boundary, more))
    assert "\n" not in str(refused.value)


def test_damping_by_modes_is_sent_to_the_metal_s_loss_factor(tmp_path):
    path = tmp_path / "beam.toml"
    path.write_text(TEMPLATES["beam"].read_text() + "\n[damping]\nmodal_percent = [0.1]\n")
    with pytest.raises(BadInput, match=r"beam\.toml: \[damping\], .* in \[substrate\], as loss_factor$"):
        read_structure(path)
