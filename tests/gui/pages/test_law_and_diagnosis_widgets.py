"""The widgets that draw a law and a diagnosis, each alone."""

from pathlib import Path

import numpy as np
import pytest
from diagnosis_cases import diagnosis
from result_cases import identification

from fitting.numerics.chances import Z_95
from gui.actions.rediagnosis import AMBIGUOUS, DiagnosisAsked, ShownDiagnosis
from gui.pages.diagnosis.candidates import Candidates
from gui.pages.diagnosis.comparison import HeldOutBars, LawChange
from gui.pages.diagnosis.finding import Finding, headline
from gui.pages.diagnosis.ranking import ranked
from gui.pages.diagnosis.residual_plots import ResidualPlots
from gui.pages.diagnosis.stages import compared
from gui.pages.law.curve import LawCurve
from gui.pages.law.plots import LawLine, LawPlots
from gui.pages.material.page import diagnosed_lines, notes_of
from gui.widgets.elided import ElidedLabel


def test_the_shaded_band_is_as_wide_as_chosen(made):
    f = np.array([10.0, 20.0])
    curve = LawCurve(f, np.array([2.0, 3.0]), np.full(2, 0.1), np.array([0.5, 0.6]), np.full(2, np.nan))
    plots = made(LawPlots())
    plots.show_lines([LawLine("fit", curve, "data")])
    assert plots.names == ("fit",)
    np.testing.assert_allclose(plots.storage.curves["fit"], [f, [2.0, 3.0]])
    narrow = plots.storage.columns()
    plots.bands.setCurrentIndex(1)
    wide = plots.storage.columns()
    changed = [np.ptp([narrow[k], wide[k]], axis=0) for k in narrow if not np.array_equal(narrow[k], wide[k])]
    assert len(changed) == 2
    np.testing.assert_allclose(changed, 0.1 * (Z_95 - 1))
    plots.show_lines([])
    assert list(plots.storage.names) == []


def test_a_candidate_is_accepted_only_where_it_can_be_computed(made):
    table, heard = made(Candidates()), []
    table.recompute.connect(lambda: heard.append(table.decisions.accept_argument))
    found = diagnosis()
    table.show_candidates(found)
    table.table.selectRow([row.name for row in ranked(found)].index("added_mass"))
    table.accept.click()
    assert not table.decisions.any
    table.allow(True)
    table.accept.click()
    table.compute.click()
    assert heard == [("added_mass",)]
    table.clear()
    assert not table.compute.isEnabled()


def test_what_effects_change_is_said_in_numbers_and_doubted_where_nothing_fits(made):
    found = diagnosis()
    bars, change = made(HeldOutBars()), made(LawChange())
    bars.show_diagnosis(found)
    assert bars.table.model().rowCount() == len(compared(found))
    change.show_diagnosis(found)
    assert change.doubt.isHidden()
    assert change.plots.names == ("before", "after: with added_mass")
    assert change.table.model().columnCount() == 7
    unknown = diagnosis(verdict="unknown").but(equivalent={}, effects=(), after=found.before)
    change.show_diagnosis(unknown)
    assert change.doubt.text().endswith("No effect is accepted: there is one fit and one law.")
    assert change.doubt.text().startswith("Verdict unknown")
    assert change.plots.names == ("law (verdict unknown)",)
    assert "after" not in change.table.text
    assert "+0.00" not in change.table.text
    assert change.table.texts(0) == ["20", "100", "280"]
    assert change.table.model().columnCount() == 4
    bars.show_diagnosis(unknown)
    assert set(bars.table.texts(3)) == {"-"}
    assert "No effect is accepted" in bars.said.text()


def not_excluded():
    """An added mass that the data cannot tell from no effect, which is far likelier."""
    found = diagnosis(verdict="ambiguous")
    none = found.candidates[-1].but(probability=0.97)
    candidates = (*(c.but(probability=0.01) for c in found.candidates[:-1]), none)
    equivalent = {"added_mass": ("added_mass", "none")}
    return found.but(equivalent=equivalent, candidates=candidates, after=found.before)


def test_what_is_less_likely_than_no_effect_is_not_drawn_as_found(made):
    found, change = not_excluded(), made(LawChange())
    change.show_diagnosis(found)
    assert change.plots.names == ("law",)
    assert "likeliest" in change.doubt.text()
    assert "found" not in [row.standing for row in ranked(found)]
    shown = ShownDiagnosis(found, "recorded")
    assert [line.name for line in diagnosed_lines(shown)] == [f"result ({AMBIGUOUS})"]


def test_a_note_that_fit_and_diagnosis_have_in_common_is_said_once():
    found = not_excluded().but(warnings=("a remark on the file",))
    fit = identification(warnings=("a remark on the file", "one on the fit"))
    said = notes_of(fit, ShownDiagnosis(found, "recorded"))
    assert said == ["one on the fit", "a remark on the file"]


def test_the_residual_of_every_segment_is_drawn_before_and_after(made, qtbot):
    plots = made(ResidualPlots())
    plots.show_diagnosis(diagnosis())
    qtbot.waitUntil(lambda: plots.drawn)
    assert set(plots.plots) == {(n, stage) for n in (1, 2, 3) for stage in ("before", "after")}
    before, after = plots.plots[1, "before"], plots.plots[1, "after"]
    before.setXRange(17.0, 19.0, padding=0)
    assert after.viewRange()[0] == before.viewRange()[0] == pytest.approx([17.0, 19.0])


def test_what_the_grey_band_is_stands_in_whole_on_a_laptops_screen(made, qtbot):
    plots = made(ResidualPlots())
    plots.resize(735, 440)
    plots.show()
    plots.show_diagnosis(diagnosis())
    qtbot.waitUntil(lambda: plots.drawn)
    (grey,) = plots.findChildren(ElidedLabel)
    assert grey.text() == grey.said


def test_what_is_accepted_as_nothing_has_no_residual_after_it(made, qtbot):
    plots, found = made(ResidualPlots()), diagnosis()
    plots.show_diagnosis(found)
    qtbot.waitUntil(lambda: plots.drawn)
    plots.show_diagnosis(found.but(verdict="none", equivalent={}, effects=(), after=found.before))
    qtbot.waitUntil(lambda: plots.drawn)
    assert all(plot.isHidden() == (stage == "after") for (_, stage), plot in plots.plots.items())
    assert plots._after.isHidden()
    assert "no effect is accepted" in plots._before.text()
    plots.show_diagnosis(found)
    qtbot.waitUntil(lambda: plots.drawn)
    assert not any(plot.isHidden() for plot in plots.plots.values())


def test_data_without_phase_leave_the_quantity_chosen_to_those_after_them(made, qtbot):
    plots, found = made(ResidualPlots()), diagnosis()
    plots.show_diagnosis(found)
    for chosen in ("real and imaginary", "imaginary part"):
        plots.quantity.setCurrentText(chosen)
        plots.quantity.textActivated.emit(chosen)
        plots.show_diagnosis(found.but(points=()))
        assert plots.quantity.currentText() == "amplitude"
        plots.show_diagnosis(found)
        assert plots.quantity.currentText() == chosen


def test_a_law_that_others_explain_as_well_says_so_in_the_legend():
    found = diagnosis(verdict="ambiguous")
    (_, line) = diagnosed_lines(ShownDiagnosis(found, "recorded"))
    assert line.name.startswith("result: with ")
    assert line.name.endswith(f"({AMBIGUOUS})")
    (_, line) = diagnosed_lines(ShownDiagnosis(diagnosis(verdict="effect"), "recorded"))
    assert AMBIGUOUS not in line.name
    by_hand = DiagnosisAsked(Path("one.h5"), accept=("added_mass",))
    (_, line) = diagnosed_lines(ShownDiagnosis(found, "made here", by_hand))
    assert AMBIGUOUS not in line.name


def test_a_persons_word_is_not_said_to_be_the_datas(made):
    shown = ShownDiagnosis(diagnosis(), "recorded")
    asked = ShownDiagnosis(diagnosis(), "made here", DiagnosisAsked(Path("one.h5"), accept=("added_mass",)))
    assert headline(asked).startswith("By hand: ")
    assert not headline(shown).startswith("By hand")
    finding = made(Finding())
    finding.show_diagnosis(asked)
    assert finding.verdict.said == headline(asked)
    assert finding.origin.said == "● made here"
    finding.show_none("no diagnosis")
    assert (finding.verdict.said, finding.next.text) == ("no diagnosis", "")
