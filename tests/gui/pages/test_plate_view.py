"""The drawing of the plate on the page Run."""

import pytest

from gui.form.draft import Draft
from gui.form.drafts import Drafts
from gui.pages.run.plate_view import PlateView
from instrument.files.experiment_file import ExperimentDocument
from instrument.files.specimen_file import SpecimenDocument, read_specimen
from instrument.simulated_case import case_file

PATCH = "\n[[patch]]\nfrom_x_mm = 100.0\nto_x_mm = 200.0\nfrom_y_mm = 20.0\nto_y_mm = 120.0\n"


def test_patches_are_drawn_where_they_are(qtbot, tmp_path):
    path = tmp_path / "specimen.toml"
    path.write_text(case_file("specimen.toml").read_text() + PATCH)
    experiment = Draft.of(case_file("experiment.toml"), ExperimentDocument)
    view = PlateView()
    qtbot.addWidget(view)
    view.resize(600, 420)
    view.show_drafts(Drafts(experiment, None, Draft.of(path, SpecimenDocument)))
    assert view.patches_mm == ((100.0, 200.0, 20.0, 120.0),)
    picture = view.grab().toImage()

    def colour(x_mm, y_mm):
        at = view.to_screen((x_mm, y_mm))
        return picture.pixelColor(int(at.x()), int(at.y())).getRgb()

    inside, outside = [(105, 25), (195, 25), (105, 115)], [(95, 25), (205, 115), (105, 130)]
    assert len({colour(*p) for p in inside}) == len({colour(*p) for p in outside}) == 1
    assert colour(*inside[0]) != colour(*outside[0])


def test_a_plate_without_patches_has_none_drawn(qtbot):
    view = PlateView()
    qtbot.addWidget(view)
    experiment = Draft.of(case_file("experiment.toml"), ExperimentDocument)
    view.show_drafts(Drafts(experiment, None, Draft.of(case_file("specimen.toml"), SpecimenDocument)))
    assert view.patches_mm is None
    assert view.size_mm == pytest.approx((300.2, 199.9))


@pytest.mark.parametrize("at_mm", [(285.0, 180.0), (15.0, 20.0), (150.0, 199.0), (150.0, 1.0), (299.0, 1.0)])
def test_the_words_of_a_mark_stay_on_a_sketch_of_the_plate(qtbot, at_mm):
    view = PlateView()
    qtbot.addWidget(view)
    view.setFixedSize(260, 180)
    view.show_place(read_specimen(case_file("specimen.toml")), at_mm, "hit")
    assert_words_lie_on_the_plate(view, at_mm)


def test_the_words_of_a_mark_that_can_be_dragged_cross_no_edge_of_the_plate(qtbot):
    view = PlateView()
    qtbot.addWidget(view)
    view.resize(600, 420)
    experiment = Draft.of(case_file("experiment.toml"), ExperimentDocument)
    view.show_drafts(Drafts(experiment, None, Draft.of(case_file("specimen.toml"), SpecimenDocument)))
    for mark in view.marks:
        assert_words_lie_on_the_plate(view, mark.at_mm)


def assert_words_lie_on_the_plate(view, at_mm):
    words = f"hit {at_mm[0]:g}, {at_mm[1]:g}"
    begin, metrics = view.words_begin(view.to_screen(at_mm), words), view.fontMetrics()
    low, high = view.to_screen((0.0, 0.0)), view.to_screen(view.size_mm)
    assert low.x() <= begin.x() <= high.x() - metrics.horizontalAdvance(words)
    assert high.y() <= begin.y() - metrics.ascent()
    assert begin.y() <= low.y()
