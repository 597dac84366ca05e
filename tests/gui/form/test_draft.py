import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gui.form.draft import Draft
from gui.form.drafts import Drafts
from gui.form.fields import Field, FormSection, form_of, law_fields, section_of
from instrument.errors import BadInput
from instrument.files.experiment_file import ExperimentDocument
from instrument.files.new_file import write_new
from instrument.files.rig_file import RigDocument
from instrument.files.specimen_file import SpecimenDocument
from instrument.files.toml import read_document
from instrument.simulated_case import case_file, write_case

MODELS = {"experiment": ExperimentDocument, "rig": RigDocument, "specimen": SpecimenDocument}
NUMBER = Field("level_g", "number")


def draft(name="experiment"):
    return Draft.of(case_file(f"{name}.toml"), MODELS[name])


def places(section: FormSection, at=()):
    """Of every field."""
    for field in section.fields:
        yield (*at, field.key), field
    for inner in section.sections:
        yield from places(inner, (*at, inner.key, *((0,) if inner.repeated else ())))


ALL = [(name, *found) for name, model in MODELS.items() for found in places(section_of(model))]


@pytest.mark.parametrize("name", MODELS)
def test_a_good_file_has_no_faults_and_is_kept_to_the_letter(name):
    assert draft(name).faults() == {}
    assert not draft(name).changed
    assert draft(name).text == case_file(f"{name}.toml").read_text()


def test_a_file_too_large_to_be_toml_is_refused_as_by_the_commands(tmp_path):
    path = tmp_path / "specimen.toml"
    path.write_text(case_file("specimen.toml").read_text() + "#" * 1_000_000)
    for read in (Draft.of, read_document):
        with pytest.raises(BadInput, match=r"bytes, expected at most 1000000"):
            read(path, SpecimenDocument)


def test_a_change_keeps_every_comment_and_the_way_numbers_are_written():
    edited = draft("specimen")
    edited.write(("core", "thickness_mm"), Field("thickness_mm", "number"), "0.50")
    before = case_file("specimen.toml").read_text().replace("thickness_mm = 0.5\n", "thickness_mm = 0.50\n")
    assert edited.text == before
    assert edited.shown(("core", "law", "tau_s"), "number") == "1.42e-4"


@given(
    st.lists(
        st.tuples(st.sampled_from(ALL), st.sampled_from(["", "0.3", "7", "x y", "1, 2, 3", "yes"])),
        max_size=6,
    )
)
def test_whatever_is_typed_the_file_says_what_the_form_shows(typed):
    drafts = {name: draft(name) for name in MODELS}
    for (name, place, field), text in typed:
        drafts[name].write(place, field, text)
    for edited in drafts.values():
        assert tomllib.loads(edited.text) == edited.plain()


@pytest.mark.parametrize(
    ("name", "place", "text", "said"),
    [
        ("experiment", ("sweep", "level_g"), "-1", "greater than or equal"),
        ("experiment", ("sweep", "level_g"), "much", "'much', expected a number"),
        ("experiment", ("specimen",), "", "missing"),
        ("experiment", ("sweep", "segments", 0), None, "expected either low_hz and high_hz, or mode"),
        ("rig", ("channels",), None, "given to both"),
        ("specimen", ("core", "law", "ginf_mpa"), "", "missing"),
        ("specimen", ("core", "law"), None, "give energy back"),
    ],
)
def test_a_fault_stands_at_its_place_in_words(name, place, text, said):
    edited = draft(name)
    if text is not None:
        field = next((f for n, p, f in ALL if (n, p) == (name, place)), NUMBER)
        edited.write(place, field, text)
    elif name == "rig":
        edited.write(("channels", "force", "input"), Field("input", "whole"), "1")
    elif name == "specimen":
        edited.write(("core", "law", "ginf_mpa"), NUMBER, "0.1")
    else:
        edited.write((*place, "low_hz"), NUMBER, "12")
    (found,) = edited.faults()
    assert found == place
    assert said in edited.faults()[place]


def test_a_table_of_a_law_that_is_not_there_stands_at_its_path(tmp_path):
    text = case_file("specimen.toml").read_text()
    before, _, rest = text.partition("[core.law]")
    after = rest[rest.index("\n[") :]
    path = tmp_path / "specimen.toml"
    path.write_text(f'{before}[core.law]\nkind = "table"\npath = "gone.csv"\n{after}')
    found = Draft.of(path, SpecimenDocument).faults()
    assert found[("core", "law", "path")].startswith("'gone.csv': no such file, expected a CSV")


def test_a_table_is_switched_off_and_on():
    edited = draft()
    edited.switch(("sweep", "sentinel"), off=True, as_false=True)
    assert edited.value(("sweep", "sentinel")) is False
    edited.switch(("sweep", "sentinel"), off=False, as_false=True)
    assert not edited.given(("sweep", "sentinel"))
    edited.switch(("hammer",), off=True, as_false=False)
    assert not edited.given(("hammer",))
    assert edited.faults() == {}


def test_segments_are_added_and_taken_away():
    edited = draft()
    edited.add_table(("sweep", "segments"))
    assert edited.value(("sweep", "segments", 3)) == edited.value(("sweep", "segments", 2))
    edited.remove(("sweep", "segments", 0))
    assert [s.get("mode") for s in edited.plain()["sweep"]["segments"]] == [3, None, None]


def test_what_a_file_does_not_say_yes_to_is_a_no():
    plate = next(s for s in section_of(SpecimenDocument).sections if s.key == "plate")
    assert next(f.default for f in plate.fields if f.key == "both_sides") == "no"


def test_each_law_asks_for_its_own():
    assert [f.key for f in law_fields("fractional-zener")] == ["g0_mpa", "ginf_mpa", "tau_s", "alpha"]
    assert law_fields("isd112") == law_fields("nonsense") == ()


def test_saves_to_its_own_files_and_refuses_to_overwrite_another_hand(tmp_path):
    drafts = Drafts.of(write_case(tmp_path))
    drafts.experiment.write(("sweep", "level_g"), NUMBER, "0.5")
    assert drafts.changed
    drafts.save()
    assert not drafts.changed
    assert Drafts.of(tmp_path / "experiment.toml").experiment.value(("sweep", "level_g")) == 0.5
    (tmp_path / "experiment.toml").write_text("title = 'by hand'\n")
    drafts.experiment.write(("sweep", "level_g"), NUMBER, "0.7")
    with pytest.raises(BadInput, match="another program"):
        drafts.save()


def test_saved_elsewhere_the_files_stand_beside_each_other(tmp_path):
    (tmp_path / "there").mkdir()
    drafts = Drafts.of(write_case(tmp_path))
    drafts.save_as(tmp_path / "there" / "mine.toml")
    again = Drafts.of(tmp_path / "there" / "mine.toml")
    assert again.fault_count == 0
    assert again.rig.path.parent == tmp_path / "there"
    (tmp_path / "there" / "rig.toml").write_text("name = 'another'\n")
    with pytest.raises(BadInput, match="already"):
        Drafts.of(tmp_path / "experiment.toml").save_as(tmp_path / "there" / "yours.toml")


def test_a_named_file_that_is_missing_is_a_problem_not_the_end(tmp_path):
    path = write_case(tmp_path)
    (tmp_path / "rig.toml").unlink()
    drafts = Drafts.of(path)
    assert "rig.toml" in drafts.problems[0]
    assert list(drafts.all) == ["experiment", "specimen"]


def test_what_is_no_toml_is_refused_in_one_line(tmp_path):
    bad = tmp_path / "bad.toml"
    bad.write_text("a = = 1")
    with pytest.raises(BadInput, match="not TOML"):
        Drafts.of(bad)


def test_what_is_no_toml_is_told_as_the_commands_tell_it(tmp_path):
    bad = tmp_path / "bad.toml"
    bad.write_text("[plate]\nlength_mm = 200,5\n")
    with pytest.raises(BadInput) as by_command:
        read_document(bad, MODELS["specimen"])
    with pytest.raises(BadInput) as by_form:
        Draft.of(bad, MODELS["specimen"])
    assert "decimal" in str(by_form.value)
    assert str(by_form.value) == str(by_command.value)


def test_of_several_spots_the_form_shows_and_writes_the_first(tmp_path):
    text = case_file("specimen.toml").read_text()
    start = text.index("[pickup]")
    several = text[:start] + text[start:].replace("[pickup]", "[[pickup]]", 1)
    several += "\n[[pickup]]\nx_mm = 200.0\ny_mm = 50.0\n"
    edited = Draft(tmp_path / "plate.toml", MODELS["specimen"], several)
    assert edited.faults() == {}
    edited.write(("pickup", "x_mm"), Field("x_mm", "number"), "61.0")
    assert edited.shown(("pickup", "x_mm"), "number") == "61.0"
    assert [p["x_mm"] for p in edited.plain()["pickup"]] == [61.0, 200.0]


@pytest.mark.parametrize(
    ("kind", "has", "has_not"),
    [
        ("plate", {"substrate_young_percent": "1", "patch_mm": "0.5", "delay_us": "2"}, "area_percent"),
        ("beam", {"length_mm": "0.3", "mass_percent": "2"}, "patch_mm"),
        ("shear-pair", {"mass_percent": "0.2", "area_percent": "1"}, "substrate_young_percent"),
    ],
)
def test_tolerances_are_those_of_the_specimen_with_what_counts_where_one_is_left_out(
    tmp_path, kind, has, has_not
):
    found = Draft.of_specimen(write_new(kind, tmp_path / "specimen.toml"))
    (tolerances,) = (s for s in form_of(found.model).sections if s.key == "tolerances")
    fields = {field.key: field for field in tolerances.fields}
    assert {key: fields[key].default for key in has} == has
    assert has_not not in fields
    assert "exact" in fields
    # Every key that the form asks for is one that the file may have.
    for key in fields:
        if key != "exact":
            found.write(("tolerances", key), fields[key], "0.1")
    assert found.faults() == {}


def test_a_decimal_comma_is_said_to_be_one():
    changed = draft("specimen")
    changed.write(("core", "thickness_mm"), NUMBER, "0,5")
    assert changed.faults()[("core", "thickness_mm")] == "'0,5': the decimal sign is a point, 0.5"
