"""Plates of other sizes on the simulated rig: which of them can be built, and what may be hidden in them."""

import tomllib
from dataclasses import replace

import pytest

from drivers.simulated.plant.built import refuse_effects
from drivers.simulated.plant.effects import AddedMass, ClampFriction, Effects
from fitting.stated.layers import Glue
from fitting.stated.patches import Patch
from instrument.errors import BadInput
from instrument.files.new_file import write_new
from instrument.files.rig_file import RigDocument
from instrument.files.structure_file import read_structure
from instrument.simulated_case import case_file
from instrument.simulated_case.plate import plate_of, unlike_a_cantilever
from instrument.simulated_case.stated import refuse_simulation


@pytest.fixture
def plate(tmp_path):
    write_new("plate", tmp_path / "plate.toml")
    return read_structure(tmp_path / "plate.toml")


def test_a_cantilever_with_one_core_is_built_as_it_is_stated(plate):
    assert unlike_a_cantilever(plate) == ""
    built = plate_of(plate)
    assert (built.length_m, built.width_m) == (plate.length_m, plate.width_m)
    assert [s.thickness_m for s in built.sheets] == pytest.approx([1.9e-3, 5e-4, 3e-4])
    # Unit shear modulus: the law multiplies it.
    assert built.sheets[1].young_pa / (2 * (1 + built.sheets[1].poisson)) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"boundary": "free"}, "boundary free"),
        ({"core": None, "constraining": None}, "no constrained core"),
        ({"pickup_m": None}, "no [pickup]"),
        ({"patches": (Patch(0.0, 0.1, 0.0, 0.1),)}, "patches"),
        ({"both_sides": True}, "a treatment on both sides"),
        ({"force_m": (0.1, 0.1)}, "a force that drives it"),
    ],
)
def test_what_is_not_simulated_is_said(plate, change, said):
    assert unlike_a_cantilever(replace(plate, **change)) == said


def test_glue_is_not_simulated(plate):
    glued = replace(plate, core=replace(plate.core, glue=(Glue(5e-5, 4e8, 1100.0),)))
    assert unlike_a_cantilever(glued) == "glue"


def test_an_effect_that_it_cannot_have_is_refused(plate):
    refuse_effects("plate", Effects(added_mass=AddedMass(1e-3, 0.1, 0.1)))
    with pytest.raises(ValueError, match="clamp_friction: not on a plate from a file"):
        refuse_effects("plate", Effects(clamp_friction=ClampFriction(0.1)))


def test_a_rig_file_is_refused_for_a_plate_that_is_not_simulated(tmp_path):
    write_new("plate", tmp_path / "plate.toml")
    text = (tmp_path / "plate.toml").read_text()
    (tmp_path / "plate.toml").write_text(text.replace('"cantilever"', '"free"'))
    (tmp_path / "rig.toml").write_text(case_file("rig.toml").read_text() + 'specimen = "plate.toml"\n')
    document = RigDocument.model_validate(tomllib.loads((tmp_path / "rig.toml").read_text()))
    with pytest.raises(BadInput, match=r"plate\.toml has boundary free, expected a cantilever"):
        refuse_simulation(document, tmp_path / "rig.toml")


@pytest.mark.parametrize("kind", ["plate", "beam"])
def test_a_stated_mass_is_no_part_of_what_stands_on_the_rig(tmp_path, kind):
    write_new(kind, tmp_path / "it.toml")
    y = "y_mm = 60.0\n" if kind == "plate" else ""
    with (tmp_path / "it.toml").open("a") as file:
        file.write(f"\n[[mass]]\nmass_kg = 0.001\nx_mm = 60.0\n{y}")
    (tmp_path / "rig.toml").write_text(case_file("rig.toml").read_text() + 'specimen = "it.toml"\n')
    document = RigDocument.model_validate(tomllib.loads((tmp_path / "rig.toml").read_text()))
    with pytest.raises(BadInput, match=r"it\.toml has \[\[mass\]\].*effects\.added_mass puts one on"):
        refuse_simulation(document, tmp_path / "rig.toml")
