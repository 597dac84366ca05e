"""The drawing of beams and shear pairs, of a file being written and of a session."""

from dataclasses import replace

import pytest

from gui.form.draft import Draft
from gui.form.drafts import Drafts
from gui.pages.run.structure_view import Drawing, StructureView
from instrument.files.experiment_file import ExperimentDocument
from instrument.files.new_file import write_new
from instrument.files.structure_file import read_structure
from instrument.results.sketch import sketch_of
from instrument.simulated_case import case_file


@pytest.fixture
def drawing(qtbot):
    shown = Drawing()
    qtbot.addWidget(shown)
    shown.resize(500, 400)
    return shown


def drafts(path):
    experiment = Draft.of(case_file("experiment.toml"), ExperimentDocument)
    return Drafts(experiment, None, Draft.of_specimen(path))


@pytest.mark.parametrize(("kind", "views"), [("beam", 2), ("shear-pair", 1)])
def test_a_file_is_drawn_as_it_is_typed(drawing, tmp_path, kind, views):
    path = write_new(kind, tmp_path / "s.toml")
    files = drafts(path)
    assert files.specimen.faults() == {}
    drawing.show_drafts(files)
    assert drawing.currentWidget() is drawing.structure
    assert len(drawing.structure.views) == views
    core = next(b for b in drawing.structure.views[-1].boxes if b.kind == "core")
    before = drawing.grab().toImage()
    place = ("core", "thickness_mm") if kind == "beam" else ("shear-pair", "thickness_mm")
    thick = files.specimen.value(place)
    files.specimen._set(place, 2 * thick)
    drawing.show_drafts(files)
    twice = next(b for b in drawing.structure.views[-1].boxes if b.kind == "core")
    assert max(twice.width / core.width, twice.height / core.height) == pytest.approx(2.0)
    assert drawing.grab().toImage() != before


def test_a_plate_keeps_its_marks_to_drag(drawing):
    drawing.show_drafts(drafts(case_file("specimen.toml")))
    assert drawing.currentWidget() is drawing.plate
    assert drawing.plate.marks[0].name == "spot"


def test_a_sessions_plate_is_drawn_too_and_nothing_can_be_dragged(drawing):
    drawing.show_specimen(read_structure(case_file("specimen.toml")))
    assert drawing.currentWidget() is drawing.structure
    assert "300.2 x 199.9 mm" in drawing.structure.views[0].title


def test_a_title_longer_than_the_drawing_is_wide_is_written_to_its_end(qtbot):
    shown = StructureView()
    qtbot.addWidget(shown)
    shown.resize(400, 200)
    (view,) = sketch_of(read_structure(case_file("specimen.toml")))
    pictures = []
    for end in ("between them", "not elsewhere"):
        shown.show_views([replace(view, title=f"Point the laser at (150, 24) mm and {40 * 'sweep '}{end}")])
        pictures.append(shown.grab().toImage())
    assert pictures[0] != pictures[1]
