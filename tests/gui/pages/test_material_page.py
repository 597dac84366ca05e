import threading

import numpy as np
import pytest
from diagnosed_session import diagnosed_session
from diagnosis_cases import diagnosis
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent
from result_cases import identification
from sessions import configuration

from fitting.numerics.chances import Z_95
from gui.actions.controller import AppController
from gui.pages.material import MaterialPage, comparison
from gui.pages.material.compared import PAPER
from gui.pages.material.numbers import headline, parameters
from gui.pages.material.tables import Correlations
from gui.state import SessionState
from instrument.results.session_result import recorded_result
from instrument.results.typeset import typeset
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile
from instrument.stream.raw import FitFailed, FitStarted

pytestmark = pytest.mark.pages("run", "material")

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture(scope="module")
def diagnosed_path(tmp_path_factory, cache_of_this_run):
    return diagnosed_session(tmp_path_factory.mktemp("diagnosed"))


def shown(qtbot, window, path):
    """The page, of a session at its end."""
    (page,) = (p for p in window.pages if isinstance(p, MaterialPage))
    window.tabs.setCurrentWidget(page)
    if window.controller.recorded is None:
        window.open(path)
        qtbot.waitUntil(lambda: window.controller.recorded is not None)
        window.turn()
    return page


@pytest.fixture
def page(qtbot, window, diagnosed_path):
    return shown(qtbot, window, diagnosed_path)


@pytest.fixture
def looked_at(qtbot, kept_window, diagnosed_path):
    """In the window of the whole module, for tests that leave it as it was."""
    return shown(qtbot, kept_window, diagnosed_path)


def fit_of(page):
    return page.controller.state.contents.fit.result


def diagnosis_of(page):
    return page.controller.state.contents.diagnosis.result


def drop(widget, path):
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    buttons, keys = LEFT, Qt.KeyboardModifier.NoModifier
    widget.dropEvent(QDropEvent(QPointF(5, 5), Qt.DropAction.CopyAction, data, buttons, keys))


def test_the_law_to_sign_stands_beside_the_one_before_the_diagnosis_and_earlier_fits(looked_at):
    page = looked_at
    assert page.plots.names == (
        "earlier fits (1)",
        "before the diagnosis",
        "result: with added_mass",
    )


def test_its_words_are_those_of_every_command(looked_at, diagnosed_path):
    page = looked_at
    with SessionFile(diagnosed_path) as file:
        words = recorded_result(contents_of(file, with_hits=False)).words
    assert page.said.text() == typeset(words)


def test_curves_and_bands_are_those_of_the_law_to_sign(looked_at):
    page = looked_at
    law = diagnosis_of(page).after.law
    G = 1e-6 * np.array([row.storage_modulus_pa for row in law])
    error = 1e-6 * np.array([row.storage_modulus_standard_error_pa for row in law])
    columns = page.plots.storage.columns()
    axis = "Storage modulus G' (MPa)"
    assert columns[f"result: with added_mass: {axis}"] == pytest.approx(G)
    assert columns[f"result: with added_mass, band high: {axis}"] == pytest.approx(G + error)


def test_the_width_of_the_bands_is_chosen(qtbot, page):
    eta = np.array([row.loss_factor for row in diagnosis_of(page).after.law])
    error = np.array([row.loss_factor_standard_error for row in diagnosis_of(page).after.law])
    qtbot.keyClick(page.plots.bands, Qt.Key.Key_Down)
    low = page.plots.loss.columns()["result: with added_mass, band low: Loss factor η"]
    assert low == pytest.approx(eta - Z_95 * error)


def test_numbers_stand_at_the_references_and_the_resonances(looked_at):
    page = looked_at
    assert page.places.texts(0)[-2:] != page.places.texts(0)[:2]
    assert {"20", "100"} < set(page.places.texts(0))
    assert "peak of segment 1" in page.places.texts(1)
    row = page.places.texts(0).index("100")
    at_100 = next(r for r in diagnosis_of(page).after.law if r.frequency_hz == 100.0)
    assert float(page.places.cell(row, 2).text.split(" ± ")[0]) == pytest.approx(
        1e-6 * at_100.storage_modulus_pa, rel=1e-2
    )


def test_parameters_and_correlations_are_the_fits_own(looked_at):
    page = looked_at
    assert page.parameters.texts(0) == ["g0 / MPa", "ginf / MPa", "tau / s", "alpha"]
    found = page.correlations.table
    assert found.cell(0, 1).text == "+1.000"
    # Not of ginf, which ends at its limit in these points: on it or just before it.
    assert float(found.cell(2, 4).text) == pytest.approx(
        fit_of(page).correlations["tau_s"]["alpha"], abs=6e-4
    )
    assert found.cell(2, 4).fill == "data"
    # None of the columns is stretched over what the others leave.
    sizes = [found.horizontalHeader().sectionSize(k) for k in range(1, 5)]
    assert max(sizes) < 2 * min(sizes)


def test_a_note_on_the_law_before_the_diagnosis_says_so_and_names_no_keys(looked_at):
    notes = looked_at.notes.toPlainText()
    assert notes.startswith("Before the diagnosis: ")
    assert "_pa" not in notes


def test_a_law_that_nothing_explains_is_doubted_in_large_and_another_one_is_not(qtbot, window, tmp_path):
    window.open(diagnosed_session(tmp_path, diagnosis(verdict="unknown")))
    qtbot.waitUntil(lambda: window.controller.recorded is not None)
    window.show_page("material")
    page = next(page for page in window.pages if page.objectName() == "material")
    qtbot.waitUntil(page.doubt.isVisible)
    assert page.doubt.said == "Verdict unknown: no law here is to be relied on."
    assert page.plots.names[-1].endswith("(verdict unknown)")


def test_a_law_that_is_explained_is_not_doubted(looked_at):
    assert looked_at.doubt.isHidden()


def test_a_fit_without_a_diagnosis_says_what_it_is_made_of(qtbot, window, page, session_path):
    assert headline([page.controller.state.contents.fit], None).startswith(
        "fractional-zener law, fit 2 of 31 points, rms "
    )
    window.open(session_path)
    qtbot.waitUntil(lambda: page.said.text().endswith("not diagnosed"))
    assert page.plots.names[-1] == "identified"


def test_a_parameter_at_its_limit_or_loose_is_named(zn1):
    law = zn1.core.law
    values = dict(zip(law.names, law.values.tolist(), strict=True))
    values["ginf_pa"] = law.limits[1].upper
    errors = {"g0_pa": 1.0, "ginf_pa": None, "tau_s": 2 * values["tau_s"], "alpha": 0.001}
    correlations = {n: {m: float(n == m) for m in values} for n in values}
    correlations["g0_pa"]["alpha"] = -0.995
    fit = identification(parameters=values, standard_errors=errors, correlations=correlations)
    said = [row.remark for row in parameters(fit, law, fit.correlations)]
    assert said == ["fixed only together with alpha", "at its upper limit", "not fixed by these data", ""]


def test_a_negative_correlation_has_its_own_colour_and_one_at_a_limit_has_none(qtbot):
    table = Correlations()
    qtbot.addWidget(table)
    table.show_fit(
        identification(
            correlations={"g0_pa": {"g0_pa": 1.0, "tau_s": -0.5}, "tau_s": {"g0_pa": None, "tau_s": 1.0}}
        )
    )
    negative, none = table.table.cell(0, 2), table.table.cell(1, 1)
    assert (negative.text, negative.fill) == ("-0.500", "model")
    assert (none.text, none.fill) == ("–", None)


def test_nothing_is_said_of_no_fit():
    assert headline([], None) == ""
    assert headline([], 1) == "fit 1 is being computed"


@pytest.fixture
def running(qtbot):
    """A page of its own, and the state of a run in its sweep."""
    controller = AppController()
    page = MaterialPage(controller)
    qtbot.addWidget(page)
    page.show()
    state = SessionState(configuration())
    state.run.state = "sweep"
    yield page, state
    page.hide()
    controller.close()


def test_a_fit_that_failed_is_said_with_what_goes_on_until_the_next_begins(running):
    page, state = running

    def said(event):
        state.take(event)
        page.show_state(state)
        return page.said.text()

    assert said(FitStarted(3, 40)) == "fit 3 is being computed"
    failed = "fit 3 failed: no memory left; the sweep goes on, the next segment is fitted anew"
    assert said(FitFailed(3, "no memory left")) == failed
    assert state.fit_running is None
    assert said(FitStarted(4, 60)) == "fit 4 is being computed"


def test_a_fit_that_failed_is_said_beside_the_law_that_stands(page):
    state = page.controller.state
    before = page.said.text()
    state.take(FitStarted(3, 40))
    state.take(FitFailed(3, "no memory left"))
    page.show_state(state)
    assert page.said.text() == f"{before}; fit 3 failed: no memory left"


def test_the_papers_law_comes_and_goes(qtbot, looked_at):
    page = looked_at
    page.tabs.setCurrentWidget(page.comparison)
    qtbot.mouseClick(page.comparison.paper, LEFT)
    assert PAPER in page.plots.names
    assert PAPER in page.plots.storage.names
    qtbot.mouseClick(page.comparison.paper, LEFT)
    assert PAPER not in page.plots.storage.names


def test_another_session_is_dropped_drawn_and_removed(qtbot, page, session_path):
    page.tabs.setCurrentWidget(page.comparison)
    with qtbot.waitSignal(page.comparison.changed):
        drop(page.comparison, session_path)
    assert session_path.stem in page.plots.names
    table = page.comparison.table
    qtbot.mouseClick(table.viewport(), LEFT, pos=table.visualRect(table.model().index(0, 0)).center())
    qtbot.mouseClick(page.comparison.remove, LEFT)
    assert session_path.stem not in page.plots.names
    assert page.controller.recorded.path != session_path


def test_a_session_with_a_diagnosis_brings_both_laws(qtbot, page, diagnosed_path):
    with qtbot.waitSignal(page.comparison.changed):
        page.comparison.read(diagnosed_path)
    assert [law.name for law in page.comparison.laws] == [
        diagnosed_path.stem,
        f"{diagnosed_path.stem}, before",
    ]
    looks = {(line.role, line.dashed) for line in page.comparison.lines}
    assert len(looks) == 2


def test_a_bad_file_is_refused_in_a_line(qtbot, page, tmp_path):
    bad = tmp_path / "bad.h5"
    bad.write_bytes(b"nothing")
    with qtbot.waitSignal(page.controller.refused) as refused:
        drop(page.comparison, bad)
    assert "bad.h5" in refused.args[0]
    assert page.comparison.laws == []


def test_on_the_way_the_fit_of_the_moment_is_shown(qtbot, window, page):
    window.controller.recorded.jump(0.0)
    qtbot.waitUntil(lambda: page.plots.names == ())
    assert page.said.text() == "No fit yet: the first follows the first segment."
    assert page.places.row_count == 0


def test_without_a_session_other_laws_can_be_looked_at(qtbot, window, page):
    window.controller.leave()
    assert page.plots.names == ()
    page.tabs.setCurrentWidget(page.comparison)
    qtbot.mouseClick(page.comparison.paper, LEFT)
    assert page.plots.names == (PAPER,)


def test_a_table_is_copied_whole(qtbot, qapp, looked_at):
    page = looked_at
    qtbot.keyClick(page.places, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    lines = qapp.clipboard().text().splitlines()
    assert lines[0].split("\t")[:3] == ["f / Hz", "at", "G' / MPa"]
    assert len(lines) == page.places.row_count + 1


def test_a_session_still_being_read_is_let_go_of_with_the_window(page, window, session_path, monkeypatch):
    begun, let_go = threading.Event(), threading.Event()

    def read_slowly(path):
        begun.set()
        assert let_go.wait(10)
        return []

    monkeypatch.setattr(comparison, "recorded_laws", read_slowly)
    page.comparison.read(session_path)
    (reading,) = page.comparison.findChildren(comparison.BackgroundTask)
    assert begun.wait(10)
    cancel = reading.cancel
    monkeypatch.setattr(reading, "cancel", lambda: (cancel(), let_go.set()))
    window.close()
    assert reading.unwanted
    assert "work" not in {thread.name for thread in threading.enumerate()}
