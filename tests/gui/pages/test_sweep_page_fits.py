"""Beside the points of a sweep: what a fit, a diagnosis, what is stated and another session say of it."""

from types import SimpleNamespace

import numpy as np
import pytest
from diagnosed_session import diagnosed_session
from diagnosis_cases import diagnosis
from sweep_views import looked_at as looked_at
from sweep_views import page as page
from sweep_views import shown

from gui.actions.rediagnosis import DiagnosisAsked, ShownDiagnosis
from gui.pages.sweep.drawing import FORESEEN
from gui.pages.sweep.fit_words import said_of_model

pytestmark = pytest.mark.pages("run", "sweep")

PATIENCE_MS = 240_000


def test_the_fitted_model_goes_through_the_points(qtbot, page):
    """The curve of another process meets what the fit itself predicted at the points."""
    qtbot.waitUntil(lambda: page.model.curve is not None, timeout=PATIENCE_MS)
    assert page.model.failure == ""
    seen = page.seen
    taken = seen.predicted.index
    assert len(taken) == len(seen.points)
    for stretch in page.model.curve.stretches:
        mine = [k for k in taken if seen.points.segment[k] == stretch.segment and not seen.points.sentinel[k]]
        f = seen.points.frequency_hz[mine]
        at = [int(np.argmin(np.abs(stretch.frequency_hz - x))) for x in f]
        np.testing.assert_allclose(stretch.frequency_hz[at], f, rtol=1e-12)
        size = np.abs(stretch.over_base_s[at]) * seen.points.level_m_s2[mine]
        np.testing.assert_allclose(size, [seen.predicted.of(k) for k in mine], rtol=1e-5)
        assert (stretch.amplitude_std_s < 0.05 * np.abs(stretch.over_base_s)).all()
    qtbot.waitUntil(lambda: "model, fit 1, ±2 s.e." in page.response.amplitude.names)
    page.tabs.setCurrentWidget(page.nyquist)
    assert "model, fit 1" in page.nyquist.plot.names


def test_until_there_is_a_curve_the_fits_own_predictions_are_drawn(page):
    page.model.rest()
    page.seen = page.seen.but(curve=None)
    page._draw_all()
    name = "model at the points, fit 1"
    assert name in page.response.amplitude.names
    _, y = shown(page.response.amplitude, name)
    assert np.isfinite(y).sum() == 27


def test_a_page_that_is_left_computes_nothing(qtbot, opened, page):
    qtbot.waitUntil(lambda: page.model.command.running, timeout=PATIENCE_MS)
    opened.show_page("run")
    assert not page.model.busy
    opened.show_page("sweep")
    assert page.model.busy


def test_the_foreseen_curve_is_what_predict_says_of_the_stated_specimen(qtbot, page):
    qtbot.waitUntil(lambda: page.foreseen.curve is not None, timeout=PATIENCE_MS)
    assert page.foreseen.failure == ""
    assert all(np.isnan(s.amplitude_std_s).all() for s in page.foreseen.curve.stretches)
    qtbot.waitUntil(lambda: FORESEEN in page.response.amplitude.names)


def test_another_sessions_sweep_is_laid_beside_this_one_and_taken_away(qtbot, opened, page, session_path):
    opened.controller.compare(session_path)
    qtbot.waitUntil(lambda: bool(page.seen.beside), timeout=PATIENCE_MS)
    name = session_path.name
    x, y = shown(page.response.amplitude, name)
    p = page.seen.points
    steps = ~p.sentinel
    np.testing.assert_allclose(np.sort(x), np.sort(p.frequency_hz[steps]))
    np.testing.assert_allclose(np.sort(y), np.sort(1e3 * np.abs(p.over_base_s[steps])), rtol=1e-9)
    page.response.others.setChecked(False)
    assert name not in page.response.amplitude.names


def test_a_fit_that_lacks_what_the_diagnosis_found_is_said_to_be_before_it(qtbot, window, tmp_path):
    window.open(diagnosed_session(tmp_path))
    qtbot.waitUntil(lambda: window.controller.recorded is not None)
    window.show_page("sweep")
    page = window.pages[1]
    qtbot.waitUntil(lambda: "rms" in page.response.model.text(), timeout=PATIENCE_MS)
    assert "% before the diagnosis" in page.response.model.text()
    # Beside its line too: the points lie elsewhere.
    assert page.seen.fit_name.endswith(", before the diagnosis")


def test_what_a_diagnosis_says_with_its_effects_is_drawn_while_it_is_shown_of_this_session(kept, looked_at):
    page, rediagnosis = looked_at, kept.controller.rediagnosis
    name, before = "with added_mass, at points", diagnosis().points[0]
    rows = [
        before.but(frequency_hz=t.point.frequency_hz, segment=t.point.segment) for t in page.seen.points.timed
    ]
    found = diagnosis().but(points=rows, points_set_aside=())
    assert name not in page.response.amplitude.names
    rediagnosis.show(ShownDiagnosis(found, "", DiagnosisAsked(kept.controller.session)))
    page.turns.at_once()
    f, _ = shown(page.response.amplitude, name)
    assert np.isfinite(f).sum() == 27
    page.response.apart.setChecked(True)
    assert "with&nbsp;added_mass" in page.response.resonances.key.text()
    page.response.apart.setChecked(False)
    rediagnosis.show(ShownDiagnosis(found, "", DiagnosisAsked(kept.controller.session.with_name("other.h5"))))
    page.turns.at_once()
    assert name not in page.response.amplitude.names
    rediagnosis.show(ShownDiagnosis(found, "", DiagnosisAsked(kept.controller.session)))
    rediagnosis.forget()
    page.turns.at_once()
    assert name not in page.response.amplitude.names


def test_a_fit_that_nothing_explains_says_so_wherever_it_is_drawn(qtbot, window, tmp_path):
    window.open(diagnosed_session(tmp_path, diagnosis(verdict="unknown")))
    qtbot.waitUntil(lambda: window.controller.recorded is not None)
    window.show_page("sweep")
    page = window.pages[1]
    qtbot.waitUntil(lambda: "verdict unknown" in page.response.model.text(), timeout=PATIENCE_MS)
    qtbot.waitUntil(lambda: page.model.curve is not None, timeout=PATIENCE_MS)
    page.chooser.choose(1)
    for plot in (page.response.amplitude, page.response.phase):
        qtbot.waitUntil(lambda plot=plot: any("fit 2, verdict unknown" in n for n in plot.names))


@pytest.mark.parametrize(("over", "said"), [(False, "no fit yet"), (True, "no fit")])
def test_a_run_that_is_over_has_no_fit_to_come(over, said):
    state = SimpleNamespace(
        contents=SimpleNamespace(fit=None), fit_running=None, run=SimpleNamespace(over=over)
    )
    assert said_of_model(state, SimpleNamespace(failure="", busy=False), 0, "") == said
