"""Several files in the window: real files, real commands, as a person presses."""

import json

import pytest
from pair_files import two_masses
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog
from rivals import all_but
from together_views import chosen as chosen
from together_views import page as page

from gui.actions.rediagnosis import DiagnosisAsked, ShownDiagnosis
from gui.pages.material import MaterialPage
from gui.pages.together.fit_plot import FitPlot
from gui.pages.together.fits import fitted_files
from gui.pages.together.saving import Saving
from gui.pages.together.tables import CandidatesTable, LeftTable, NumbersTable
from instrument.cli.main import run
from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.identification import IdentificationResult

pytestmark = pytest.mark.pages("run", "material", "diagnosis", "together")

LEFT = Qt.MouseButton.LeftButton
ADDED_KG = 0.1


@pytest.fixture(scope="module")
def masses(tmp_path_factory):
    """The heavy one carries what nobody stated."""
    folder = tmp_path_factory.mktemp("masses")
    light, _ = two_masses(folder)
    _, heavy = two_masses(tmp_path_factory.mktemp("heavier"), more_kg=ADDED_KG)
    return [light, heavy]


def arguments(masses):
    return [*map(str, masses), *(w for p in masses for w in ("--specimen", str(p.with_suffix(".toml"))))]


@pytest.fixture(scope="module")
def results(masses, tmp_path_factory, cache_of_this_run):
    """What the commands find, among few rivals: the whole catalogue takes seconds."""
    to = tmp_path_factory.mktemp("results")
    without = [
        f"--without={n}" for n in sorted(all_but("added_mass", "gain_error", "temperature_difference"))
    ]
    run(["identify", *arguments(masses), "--json", str(to / "identified.json")])
    run(["diagnose", *arguments(masses), *without, "--json", str(to / "diagnosed.json")])
    kinds = {"identified": IdentificationResult, "diagnosed": DiagnosisResult}
    return {
        name: kind.model_validate(json.loads((to / f"{name}.json").read_text()))
        for name, kind in kinds.items()
    }


@pytest.fixture
def diagnosed(chosen, results):
    """As after both commands; that they run is looked at elsewhere."""
    together = chosen.together
    first, *further = together.files
    asked = DiagnosisAsked(first.data, first.specimen, further=tuple(further))
    together.identified = results["identified"]
    chosen.controller.rediagnosis.show(ShownDiagnosis(results["diagnosed"], "made here of 2 files", asked))
    return chosen


def test_identified_by_the_button_it_shows_points_lines_and_the_law(qtbot, chosen, results):
    qtbot.mouseClick(chosen.identify, LEFT)
    assert chosen.working.bar.isVisible()
    assert chosen.working.cancel.isVisible()
    assert not chosen.chosen.isEnabled()
    qtbot.waitUntil(lambda: not chosen.together.running)
    assert chosen.together.identified.untimed == results["identified"].untimed
    assert set(chosen.fit.plot.names) == {
        "1 light.csv",
        "1 light.csv, fitted",
        "2 heavy.csv",
        "2 heavy.csv, fitted",
    }
    assert chosen.fit.plot.y.title == "Velocity / m/s"
    assert chosen.law.text().startswith("fractional-zener law of 2 files, 48 points")
    qtbot.mouseClick(chosen.material, LEFT)
    material = chosen.window().tabs.currentWidget()
    assert isinstance(material, MaterialPage)
    assert material.plots.names == ("identified, 2 files (in doubt)",)
    assert "may be biased beyond its band" in material.doubt.said
    assert chosen.doubt.said == material.doubt.said
    assert "identified here of 2 files" in material.origin.said


def test_why_there_is_no_result_stays_on_the_page(page, masses):
    page.together.add(masses)
    page.together._command.failed.emit("heavy.csv: the file is empty")
    assert not page.doubt.isHidden()
    assert page.doubt.said == "No result: heavy.csv: the file is empty"
    page.together.remove(1)
    assert page.doubt.isHidden()


def test_one_file_alone_is_identified_too(qtbot, page, masses):
    page.together.add(masses[:1])
    qtbot.waitUntil(lambda: "..." not in page.chosen.table.texts(3))
    qtbot.mouseClick(page.identify, LEFT)
    qtbot.waitUntil(lambda: not page.together.running)
    assert page.law.text().startswith("fractional-zener law of 1 file, 24 points")
    assert set(page.fit.plot.names) == {"1 light.csv", "1 light.csv, fitted"}


def test_a_plate_s_file_alone_has_its_name_in_the_legend(qtbot, page, masses, results):
    page.together.add(masses[:1])
    qtbot.waitUntil(lambda: "..." not in page.chosen.table.texts(3))
    found = results["identified"]
    # A plate's result says no names where there is but one.
    own = [p.but(file=None) for p in found.points if p.file == 1]
    page.together.identified = found.but(files=None, points=own)
    page.together.changed.emit()
    assert set(page.fit.plot.names) == {"1 light.csv", "1 light.csv, fitted"}


def test_a_file_that_is_written_anew_has_no_results_any_more(qtbot, chosen, results):
    together, said = chosen.together, []
    together.failed.connect(said.append)
    together.identified, together.leads = results["identified"], True
    together.look_again()
    assert together.identified is not None
    (heavy,) = (one for one in together.files if one.data.name == "heavy.csv")
    content = heavy.data.read_text()
    try:
        heavy.data.write_text("\n".join(content.splitlines()[:-4]) + "\n")
        together.add([heavy.data])
        assert together.identified is None
        assert not together.leads
        assert said == ["heavy.csv: written anew, what was found before is let go of"]
        qtbot.waitUntil(lambda: "20 points" in chosen.chosen.table.texts(3)[1])
    finally:
        heavy.data.write_text(content)


def test_what_is_identified_while_another_session_is_opened_does_not_take_its_place(qtbot, chosen):
    together = chosen.together
    together.identify()
    together.let_go()
    qtbot.waitUntil(lambda: together.identified is not None)
    assert not together.leads
    assert together.shown is None


def test_where_nothing_is_left_unexplained_it_says_so(diagnosed):
    diagnosed.views.setCurrentWidget(diagnosed.left_view)
    assert diagnosed.left.texts(0) == []
    assert diagnosed.left_said.isVisible()
    assert diagnosed.left_said.text().startswith("Nothing: ")


def test_a_computation_cancelled_leaves_the_page_as_it_was(qtbot, chosen):
    qtbot.mouseClick(chosen.identify, LEFT)
    qtbot.mouseClick(chosen.working.cancel, LEFT)
    assert not chosen.working.bar.isVisible()
    assert chosen.identify.isEnabled()
    assert chosen.empty.isVisible()


def test_a_diagnosis_says_of_which_file_an_effect_is(diagnosed, results):
    found = results["diagnosed"]
    assert diagnosed.finding.verdict.said
    owned = [e for e in found.effects if e.parameters["file"].value == 2]
    assert owned, "a mass that nobody stated is on the second file"
    assert "heavy.csv" in diagnosed.finding.story.text()
    assert diagnosed.chosen.table.cell(1, 0).edge == "data"
    assert diagnosed.chosen.table.cell(0, 0).edge is None
    assert isinstance(diagnosed.candidates, CandidatesTable)
    assert diagnosed.candidates.texts(0)[0] == found.candidates[0].name
    assert diagnosed.candidates.texts(1)[0] == "2 heavy.csv"
    assert diagnosed.finding.next.text.endswith(found.next_measurement)


def test_numbers_notes_and_what_is_left_follow_the_fit_chosen(diagnosed, results):
    assert isinstance(diagnosed.numbers, NumbersTable)
    assert isinstance(diagnosed.left, LeftTable)
    assert diagnosed.stage.currentData() == "after"
    after = diagnosed.numbers.texts(3)
    left_after = diagnosed.left.row_count
    diagnosed.stage.setCurrentIndex(0)
    assert diagnosed.numbers.texts(3) != after
    assert diagnosed.left.row_count >= left_after
    assert set(diagnosed.numbers.texts(1)) == {"all", "1 light.csv", "2 heavy.csv"}
    for text in results["diagnosed"].warnings:
        assert text[:20].lower() in diagnosed.notes.toPlainText().lower()


def test_the_diagnosis_page_has_all_of_it(qtbot, diagnosed, results):
    qtbot.mouseClick(diagnosed.diagnosis, LEFT)
    there = diagnosed.window().tabs.currentWidget()
    assert there.title == "Diagnosis"
    assert there.candidates.table.texts(0)[0] == results["diagnosed"].candidates[0].name
    assert "2 files" in there.finding.origin.said
    # Numbers of segments go on from file to file: whose a residual is, is said.
    qtbot.waitUntil(lambda: there.residual.drawn)
    assert {plot.y.label for plot in there.residual.plots.values()} == {"File 1", "File 2"}


def test_a_session_opened_is_shown_and_what_was_found_is_had_back(qtbot, diagnosed, session_path):
    window = diagnosed.window()
    window.open(session_path)
    qtbot.waitUntil(lambda: window.controller.recorded is not None)
    window.show_page("material")
    material = window.tabs.currentWidget()
    assert "files" not in "".join(material.plots.names)
    window.show_page("together")
    assert diagnosed.together.identified is not None
    qtbot.mouseClick(diagnosed.material, LEFT)
    assert "diagnosis made here of 2 files" in material.origin.said


def test_one_file_by_itself_and_the_difference_are_drawn(made, results):
    plot = made(FitPlot())
    plot.show_files(fitted_files(results["identified"]), of_modes=False)
    plot.file.setCurrentIndex(2)
    assert plot.plot.names == ("2 heavy.csv", "2 heavy.csv, fitted")
    plot.quantity.setCurrentIndex(1)
    assert plot.plot.names == ("2 heavy.csv",)
    assert plot.plot.y.title == "Difference / %"
    plot.show_files(fitted_files(results["identified"]), of_modes=True)
    plot.quantity.setCurrentIndex(0)
    assert plot.file.currentText() == "2 heavy.csv"
    assert plot.plot.y.title == "Loss factor"


def test_what_is_saved_is_what_the_commands_write(qtbot, diagnosed, results, tmp_path, monkeypatch):
    with qtbot.waitSignal(diagnosed.saving.done):
        diagnosed.saving.save(results["identified"], tmp_path / "found")
    said = json.loads((tmp_path / "found.json").read_text())
    assert said == results["identified"].as_json()
    assert (tmp_path / "found.json").read_text() == json.dumps(said, indent=1) + "\n"
    for ask in (diagnosed.saving.identification, diagnosed.saving.diagnosis):
        ask()
    asked = [d.windowTitle() for d in diagnosed.findChildren(QFileDialog)]
    assert asked == ["Save the identification", "Save the diagnosis"]


def test_no_file_that_was_fitted_is_written_over(qtbot, diagnosed, masses, results, tmp_path):
    assert isinstance(diagnosed.saving, Saving)
    link = tmp_path / "same.json"
    link.symlink_to(masses[0])
    before = masses[0].read_bytes()
    with qtbot.waitSignal(diagnosed.saving.failed) as told:
        diagnosed.saving.save(results["identified"], link)
    assert "expected another name" in told.args[0]
    assert masses[0].read_bytes() == before
