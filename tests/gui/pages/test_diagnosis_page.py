import pytest
from diagnosed_session import diagnosed_session
from diagnosis_cases import UNSEEN, diagnosis
from following_cases import BACKWARDS, SPOT
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from gui.actions.rediagnosis import DiagnosisAsked, ShownDiagnosis
from gui.pages.diagnosis import DiagnosisPage
from gui.pages.diagnosis.comparison import HeldOutBars
from gui.pages.diagnosis.next_table import NextTable
from gui.pages.diagnosis.unseen_table import UnseenTable
from gui.pages.material import MaterialPage
from instrument.facts.follow_up import FollowUp
from instrument.results.next_words import advice

pytestmark = pytest.mark.pages("run", "material", "diagnosis")

LEFT = Qt.MouseButton.LeftButton
LONG_MS = 300_000
RANKED = tuple(FollowUp.model_validate(o) for o in (SPOT, BACKWARDS))
AMBIGUOUS = diagnosis(verdict="ambiguous").but(
    next_measurement=advice(RANKED[0]), next_measurements=RANKED, unseen=UNSEEN
)


@pytest.fixture(scope="module")
def diagnosed_path(tmp_path_factory, cache_of_this_run):
    return diagnosed_session(tmp_path_factory.mktemp("diagnosed"), AMBIGUOUS)


def page_of(window, kind):
    (page,) = (p for p in window.pages if isinstance(p, kind))
    return page


def shown(qtbot, window, path):
    """The page, of a session at its end."""
    page = page_of(window, DiagnosisPage)
    window.tabs.setCurrentWidget(page)
    if window.controller.recorded is None or window.controller.recorded.path != path:
        window.open(path)
        qtbot.waitUntil(lambda: window.controller.recorded is not None)
        window.turn()
    return page


@pytest.fixture
def page(qtbot, window, diagnosed_path):
    return shown(qtbot, window, diagnosed_path)


@pytest.fixture
def looked_at(qtbot, kept_window, diagnosed_path):
    """In the window of the whole module, its first view open; for tests that look, and choose views."""
    page = shown(qtbot, kept_window, diagnosed_path)
    page.views.setCurrentIndex(0)
    return page


def select(qtbot, page, name):
    """Click on a candidate."""
    table = page.candidates.table
    index = table.model().index(table.texts(0).index(name), 0)
    table.scrollTo(index)
    qtbot.mouseClick(table.viewport(), LEFT, pos=table.visualRect(index).center())


def test_the_verdict_is_what_was_recorded(looked_at):
    page = looked_at
    assert page.finding.verdict.said.startswith("Ambiguous: added_mass (mass 8.00 ± 0.10 g")
    assert page.finding.origin.said == "recorded with the session"
    assert page.finding.next.text.startswith(f"Measure next. {AMBIGUOUS.next_measurement} Less likely than")
    assert page.finding.next.text.endswith("told apart too: gain_error.")
    assert "a mass of 8 g" in page.story.toPlainText()
    assert not page.empty.isVisible()


def test_what_could_be_measured_next_is_ranked_and_the_first_is_what_is_advised(looked_at):
    page = looked_at
    assert isinstance(page.next, NextTable)
    page.views.setCurrentWidget(page.next)
    assert page.next.table.texts(0) == [o["todo"] for o in (SPOT, BACKWARDS)]
    assert page.next.table.texts(4) == ["spot_offset and gain_error"] * 2
    assert "aim it elsewhere" in page.finding.next.text
    # Where the first of them is made is drawn below.
    (view,) = page.next.drawn.views
    assert [(m.name, m.x, m.y) for m in view.marks] == [("laser", *SPOT["spot_mm"])]
    assert page.next.drawn.isVisibleTo(page.next)
    assert page.next.table.cell(0, 0).tip == SPOT["why"]


def test_what_may_be_there_unseen_has_a_view_where_there_is_any(looked_at):
    page = looked_at
    assert isinstance(page.unseen, UnseenTable)
    page.views.setCurrentWidget(page.unseen)
    assert page.unseen.table.texts(0) == ["temperature_drift", "absolute_velocity"]
    assert page.unseen.table.texts(1) == ["warming 2.27 K", "-"]
    assert page.unseen.table.text.splitlines()[0].split("\t")[2:4] == ["chance / %", "G' by / %"]
    (said,) = page.unseen.findChildren(QLabel)
    assert "would not be seen if it were there" in said.text()


def test_candidates_are_ranked_with_their_group(looked_at):
    page = looked_at
    table = page.candidates.table
    assert table.texts(0)[:4] == ["added_mass", "spot_offset", "added_mass + spot_offset", "none"]
    assert table.texts(1)[:2] == ["found", "not told apart"]
    assert "added_mass, spot_offset" in page.candidates.groups.text()
    assert [table.cell(k, 2).share for k in range(4)] == pytest.approx([1.0, 0.99125, 0.985, 0.0])


def test_before_and_after_stand_on_the_same_axes(qtbot, looked_at):
    page = looked_at
    qtbot.waitUntil(lambda: page.residual.drawn)
    for number in (1, 2, 3):
        before, after = (page.residual.plots[number, stage] for stage in ("before", "after"))
        assert before.viewRange()[0] == after.viewRange()[0]
        assert before.viewRange()[1] == pytest.approx([-11.2, 11.2])
        assert after.viewRange()[1][1] < 5.0
        assert before.columns()[f"real part: Segment {number} (%)"] == pytest.approx(10.0)
        assert {"noise 1"} < set(after.names)


def test_whichever_is_zoomed_the_other_follows(qtbot, window, page):
    qtbot.waitUntil(lambda: page.residual.drawn)
    before, after = (page.residual.plots[2, stage] for stage in ("before", "after"))
    after.setRange(xRange=(90, 95), yRange=(-1, 2), padding=0)
    assert before.viewRange() == [pytest.approx([90, 95]), pytest.approx([-11.2, 11.2])]
    window.resize(1000, 900)
    window.resize(1366, 768)
    qtbot.waitUntil(lambda: before.viewRange()[0] == after.viewRange()[0])
    assert after.viewRange()[1] == pytest.approx([-1, 2])


def test_quantity_and_segment_are_chosen_by_key(qtbot, page):
    qtbot.keyClick(page.residual.quantity, Qt.Key.Key_End)
    assert page.residual.quantity.currentText() == "whitened"
    qtbot.keyClick(page.residual.segment, Qt.Key.Key_Down)
    seen = [(1, "before"), (1, "after")]
    plots = page.residual.plots
    qtbot.waitUntil(lambda: [key for key, plot in plots.items() if plot.isVisible()] == seen)
    qtbot.waitUntil(lambda: page.residual.plots[1, "before"].y.unit == "")


def test_a_pane_without_room_for_words_has_its_quantity_and_unit(qtbot, looked_at):
    residual = looked_at.residual
    residual.quantity.setCurrentIndex(0)
    qtbot.waitUntil(lambda: residual.drawn)
    for (number, _), plot in residual.plots.items():
        assert plot.y.titles[:2] == (f"Segment {number} / %", f"R{'₀₁₂₃'[number]} / %")
        assert f"R{'₀₁₂₃'[number]}: residual of segment {number}" in plot.toolTip()


def test_the_error_is_shown_beside_noise(looked_at):
    page = looked_at
    page.views.setCurrentWidget(page.held_out)
    first = [page.held_out.table.cell(0, k).text for k in range(5)]
    assert first == ["segment 1, predicted from the others", "% rms", "11.2", "0.224", "0.1"]
    assert "no other segment can foretell" not in page.held_out.said.text()


def test_why_an_error_on_data_held_out_is_missing_is_said_below_it(qtbot, monkeypatch):
    monkeypatch.setattr("instrument.results.foretelling.is_foretold", lambda *_: False)
    bars = HeldOutBars()
    qtbot.addWidget(bars)
    bars.show_diagnosis(diagnosis())
    assert "no other segment can foretell." in bars.said.text()


def test_the_law_is_shown_before_and_after(looked_at):
    page = looked_at
    page.views.setCurrentWidget(page.law)
    assert page.law.plots.names == ("before", "after: with added_mass or spot_offset")
    assert page.law.table.texts(0) == ["20", "100", "280"]


@pytest.mark.long
def test_an_effect_accepted_by_hand_is_fitted_and_the_material_follows(qtbot, window, page, diagnosed_path):
    select(qtbot, page, "spot_offset")
    qtbot.mouseClick(page.candidates.accept, LEFT)
    assert "accepted by hand" in page.candidates.table.texts(1)
    with qtbot.waitSignal(window.controller.rediagnosis.progressed, timeout=LONG_MS):
        qtbot.mouseClick(page.candidates.compute, LEFT)
        assert page.working.cancel.isVisible()
    qtbot.waitUntil(lambda: not window.controller.rediagnosis.running, timeout=LONG_MS)
    assert page.finding.verdict.said.startswith("By hand: spot_offset (dx ")
    assert page.finding.origin.said == "● by hand, not recorded"
    assert page.candidates.table.texts(0)[0] == "added_mass"
    material = page_of(window, MaterialPage)
    window.tabs.setCurrentWidget(material)
    assert "result: with spot_offset, by hand (in doubt)" in material.plots.names
    assert "spot_offset, your word, would leave such data once in" in material.doubt.said
    assert "not recorded" in material.origin.said
    window.tabs.setCurrentWidget(page)
    qtbot.mouseClick(page.back, LEFT)
    assert page.finding.verdict.said.startswith("Ambiguous: added_mass")
    assert not page.candidates.decisions.any
    window.tabs.setCurrentWidget(material)
    assert "result: with added_mass (ambiguous)" in material.plots.names
    assert material.origin.said == ""


def test_no_effect_by_hand_is_not_called_noise(window, page):
    nothing = diagnosis(verdict="none").but(effects=(), equivalent={}, by_hand=True)
    rediagnosis = window.controller.rediagnosis
    rediagnosis.found = ShownDiagnosis(
        nothing, "by hand", DiagnosisAsked(window.controller.recorded.path, accept=())
    )
    rediagnosis.changed.emit()
    assert page.finding.verdict.said == "By hand: no effect accepted"
    assert page.residual.segment.count() == 4
    material = page_of(window, MaterialPage)
    window.tabs.setCurrentWidget(material)
    assert material.plots.names == ("earlier fits (1)", "result, by hand")
    assert "verdict: by your word: no effect accepted" in material.said.text()


def test_what_is_computed_can_be_cancelled(qtbot, window, page):
    select(qtbot, page, "added_mass")
    qtbot.mouseClick(page.candidates.decline, LEFT)
    assert page.candidates.compute.text() == "Recompute: search again without added_mass and what contains it"
    qtbot.mouseClick(page.candidates.compute, LEFT)
    assert window.controller.rediagnosis.running
    qtbot.mouseClick(page.working.cancel, LEFT)
    assert not window.controller.rediagnosis.running
    assert page.finding.origin.said == "recorded with the session"
    assert page.candidates.compute.isEnabled()


def test_an_effect_these_data_cannot_have_is_refused_in_a_line(qtbot, window, page):
    select(qtbot, page, "absolute_velocity")
    qtbot.mouseClick(page.candidates.accept, LEFT)
    with qtbot.waitSignal(window.controller.refused, timeout=LONG_MS) as refused:
        qtbot.mouseClick(page.candidates.compute, LEFT)
    assert "absolute_velocity" in refused.args[0]
    assert page.finding.origin.said == "recorded with the session"


def test_before_its_end_a_session_has_no_diagnosis(qtbot, window, page):
    window.controller.recorded.jump(0.0)
    qtbot.waitUntil(lambda: not page.body.isVisible())
    assert "No diagnosis yet" in page.finding.verdict.said
    assert page.empty.isVisible()


def test_a_session_without_a_diagnosis_offers_one(qtbot, window, session_path):
    page = shown(qtbot, window, session_path)
    assert page.finding.verdict.said == "This session holds no diagnosis"
    assert not page.body.isVisible()
    qtbot.mouseClick(page.diagnose, LEFT)
    assert window.controller.rediagnosis.running
    qtbot.mouseClick(page.working.cancel, LEFT)
    assert page.diagnose.isVisible()


def test_why_none_was_possible_is_said(qtbot, window, tmp_path):
    page = shown(qtbot, window, diagnosed_session(tmp_path, message="too few points"))
    assert page.finding.verdict.said == "No diagnosis was possible: too few points"


def test_other_data_can_be_diagnosed_without_a_session(qtbot, window, tmp_path):
    page = page_of(window, DiagnosisPage)
    window.tabs.setCurrentWidget(page)
    assert not page.others.isVisible()
    sweep = tmp_path / "sweep.csv"
    rows = "".join(f"{f},{0.01 * f},0.002\n" for f in range(15, 25))
    sweep.write_text("frequency_hz,velocity_re_m_s,velocity_im_m_s\n" + rows)
    window.open(sweep)
    qtbot.waitUntil(page.others.isVisible)
    assert [action.text() for action in page.others.menu().actions()] == ["sweep.csv..."]
    with qtbot.waitSignal(window.controller.refused, timeout=LONG_MS) as refused:
        window.controller.rediagnosis.start(DiagnosisAsked(sweep, tmp_path / "none.toml"))
    assert "none.toml" in refused.args[0]


def test_a_sweep_without_a_session_says_what_is_next(qtbot, window, tmp_path):
    page = page_of(window, DiagnosisPage)
    window.tabs.setCurrentWidget(page)
    window.open(written(tmp_path / "sweep.csv"))
    qtbot.waitUntil(page.others.isVisible)
    assert page.finding.verdict.said == "No diagnosis of sweep.csv yet"
    assert "Next: Diagnose other data" in page.empty.text()


def test_data_written_anew_have_no_diagnosis_any_more(qtbot, window, page, tmp_path):
    controller, path = window.controller, written(tmp_path / "sweep.csv")
    window.open(path)
    qtbot.waitUntil(lambda: path in controller.beside)
    asked = DiagnosisAsked(path, tmp_path / "specimen.toml")
    controller.rediagnosis.start(asked)
    controller.rediagnosis.show(ShownDiagnosis(diagnosis(), "made here of sweep.csv", asked))
    window.open(path)
    qtbot.waitUntil(lambda: not controller.data_beside.reading)
    assert controller.rediagnosis.found is not None
    written(path, points=12)
    window.open(path)
    qtbot.waitUntil(lambda: not controller.data_beside.reading)
    assert controller.rediagnosis.found is None


def test_material_of_other_data_has_nothing_of_the_session(window, page, tmp_path):
    asked = DiagnosisAsked(tmp_path / "other.csv", tmp_path / "specimen.toml")
    shown = ShownDiagnosis(diagnosis(), "made here of other.csv, not recorded", asked)
    window.controller.rediagnosis.show(shown)
    material = page_of(window, MaterialPage)
    window.tabs.setCurrentWidget(material)
    assert material.plots.names == ("before the diagnosis", "result: with added_mass")
    assert not [text for text in material.places.texts(1) if "peak" in text]
    assert material.notes.toPlainText() == "The points carry no time."
    assert material.correlations.table.model().rowCount() == 0


def test_tables_of_modes_leave_no_residual_of_other_data(page):
    page.views.setCurrentWidget(page.residual)
    assert not page.residual.nothing.isVisible()
    page.residual.show_diagnosis(diagnosis().but(points=(), modes=()))
    assert page.residual.nothing.isVisible()
    assert not [plot for plot in page.residual.plots.values() if plot.isVisible()]
    assert "in frequency" in page.residual._after.text()


def written(path, points=10):
    rows = "".join(f"{f},{0.01 * f},0.002\n" for f in range(15, 15 + points))
    path.write_text("frequency_hz,velocity_re_m_s,velocity_im_m_s\n" + rows)
    return path


def test_closing_ends_what_is_computed(qtbot, window, page):
    window.controller.rediagnosis.start(DiagnosisAsked(window.controller.recorded.path))
    window.close()
    assert not window.controller.rediagnosis.running


def test_another_session_lets_go_of_what_was_made_here(qtbot, window, page, session_path):
    window.controller.rediagnosis.start(
        DiagnosisAsked(window.controller.recorded.path, accept=("spot_offset",))
    )
    before = window.controller.feed
    window.open(session_path)
    qtbot.waitUntil(lambda: window.controller.feed is not before)
    assert not window.controller.rediagnosis.running
    assert page.finding.verdict.said == "This session holds no diagnosis"


def test_colours_follow_the_theme(qtbot, kept_window, looked_at):
    page, window = looked_at, kept_window
    light = page.finding.verdict.text()
    window.appearance.choose("dark")
    qtbot.waitUntil(lambda: page.finding.verdict.text() != light)
    window.appearance.choose("light")
    qtbot.waitUntil(lambda: page.finding.verdict.text() == light)
