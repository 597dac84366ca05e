import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from session_cases import SyntheticSession, configuration
from sessions import point

from gui.controller import AppController
from gui.pages.sweep import SweepPage
from gui.pages.sweep.curve import Curve, CurveStretch, grid
from gui.pages.sweep.drawing import FORESEEN
from gui.state import SessionState
from instrument.stepped_sine.sine_fit import sine_fit
from instrument.stream.derived import StepSettled
from instrument.stream.raw import SegmentBegan, SessionBegan

LEFT = Qt.MouseButton.LeftButton
PATIENCE_MS = 60_000
BEGAN = SessionBegan("2026-04-01T08:00:05+00:00", "0", {}, ())


@pytest.fixture
def page(opened):
    """Of the session at its end."""
    opened.resize(1366, 768)
    opened.show_page("sweep")
    opened.pages[1].response.apart.setChecked(False)
    return opened.pages[1]


@pytest.fixture
def alone(qtbot):
    """A page and a picture to be filled by hand."""
    controller = AppController()
    page = SweepPage(controller)
    page.response.apart.setChecked(False)
    qtbot.addWidget(page)
    page.resize(1366, 500)
    page.show()
    state = SessionState(configuration())
    state.take(BEGAN)
    page.show_state(state)
    yield page, state
    page.hide()
    controller.close()


def click_segment(qtbot, page, row):
    where = page.chooser.visualItemRect(page.chooser.item(row)).center()
    qtbot.mouseClick(page.chooser.viewport(), LEFT, pos=where)


def click_point(qtbot, plot, x, y):
    """A real click on a place in the plot's own units."""
    at = plot.mapFromScene(plot.getViewBox().mapViewToScene(QPointF(x, y)))
    qtbot.mouseMove(plot.viewport(), at)
    qtbot.mouseClick(plot.viewport(), LEFT, pos=at)


def value(page, name):
    return next(line.value for line in page.record.lines if line.name == name)


def shown(plot, name):
    return plot.columns()[f"{name}: {plot.x.column}"], plot.columns()[f"{name}: {plot.y.column}"]


def fed(page, state, events):
    for event in events:
        state.take(event)
        page.show_state(state)


def test_without_a_session_it_says_what_will_appear(qtbot, window):
    window.show_page("sweep")
    assert "Open a session, or start a run" in window.pages[1]._layers.currentWidget().text()


def test_a_click_on_a_segment_shows_its_points(qtbot, page):
    click_segment(qtbot, page, 2)
    for plot in (page.response.amplitude, page.response.phase):
        f, _ = shown(plot, "good")
        np.testing.assert_allclose(f, np.linspace(108, 130, 9))
        assert plot.viewRange()[0] == pytest.approx([108 - 0.04 * 22, 130 + 0.04 * 22])
    click_segment(qtbot, page, 0)
    assert len(shown(page.response.amplitude, "good")[0]) == 3 * 9 - 1


def test_a_point_with_a_remark_looks_different(page):
    f, _ = shown(page.response.amplitude, "with remarks")
    assert f.tolist() == [19.0]


def test_the_amplitude_is_velocity_over_base(page):
    points = page.seen.points
    k = int(np.flatnonzero(points.frequency_hz == 20.5)[0])
    p = points.timed[k].point
    f, y = shown(page.response.amplitude, "good")
    assert y[f == 20.5] == pytest.approx(1e3 * abs(p.velocity_m_s / p.base_m_s2))
    page.response.quantity.setCurrentText("velocity at its level")
    assert page.response.amplitude.y.unit == "mm/s"
    f, y = shown(page.response.amplitude, "good")
    assert y[f == 20.5] == pytest.approx(1e3 * abs(p.velocity_m_s / p.base_m_s2) * p.level_m_s2)


@pytest.mark.parametrize("box", ["log_amplitude", "log_frequency"])
def test_axes_can_be_logarithmic(qtbot, page, box):
    box = getattr(page.response, box)
    qtbot.mouseClick(box, LEFT, pos=box.rect().center() - box.rect().center() / 1.3)
    assert box.isChecked()
    assert "log" in repr(page.seen.way)
    click_segment(qtbot, page, 1)
    low, high = page.response.amplitude.viewRange()[0]
    if page.response.log_frequency.isChecked():
        low, high = 10**low, 10**high
    assert 17 < low < 18 < 22 < high < 23


@pytest.mark.parametrize("plot", ["amplitude", "phase", "nyquist", "level"])
def test_a_click_on_a_point_shows_its_record(qtbot, page, plot):
    page.tabs.setCurrentWidget({"nyquist": page.nyquist, "level": page.quality}.get(plot, page.step))
    click_segment(qtbot, page, 3)
    plots = {
        "amplitude": page.response.amplitude,
        "phase": page.response.phase,
        "nyquist": page.nyquist.plot,
        "level": page.quality.level,
    }
    qtbot.wait(50)  # until the plot has its size
    x, y = shown(plots[plot], "good")
    click_point(qtbot, plots[plot], x[4], y[4])
    assert value(page, "Frequency") == "210 Hz"
    assert value(page, "Quality") == "good"
    assert page.record.title.text() == "<b>210 Hz</b>"


def test_arrows_walk_from_point_to_point(qtbot, page):
    click_segment(qtbot, page, 2)
    for _ in range(3):
        qtbot.keyClick(page.chooser, Qt.Key.Key_Right)
    assert value(page, "Frequency") == "113.5 Hz"
    qtbot.keyClick(page.chooser, Qt.Key.Key_Left)
    assert value(page, "Frequency") == "110.75 Hz"
    qtbot.mouseClick(page.record.on, LEFT)
    assert value(page, "Frequency") == "113.5 Hz"
    f, _ = shown(page.response.amplitude, "point looked at")
    assert f.tolist() == [113.5]


def test_the_samples_of_the_point_are_read_from_the_file(qtbot, page):
    click_segment(qtbot, page, 1)
    page.walk(1)
    page.tabs.setCurrentWidget(page.samples)
    qtbot.waitUntil(lambda: "calibration not taken off" in page.samples.said.text(), timeout=PATIENCE_MS)
    p = page.seen.points.timed[page.seen.chosen].point
    t, base = shown(page.samples.base, "base acceleration")
    phasor = sine_fit(base[None, :], p.sample, 1 / (t[1] - t[0]), p.frequency_hz).phasor[0]
    assert phasor == pytest.approx(p.base_m_s2, rel=1e-6)


def test_reading_ends_with_the_page(qtbot, opened, page):
    page.walk(1)
    page.tabs.setCurrentWidget(page.samples)
    assert page.samples.dwells.busy
    opened.show_page("run")
    assert not page.samples.dwells.busy
    opened.show_page("sweep")
    qtbot.waitUntil(lambda: "calibration not taken off" in page.samples.said.text(), timeout=PATIENCE_MS)


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
    qtbot.waitUntil(lambda: page.model._command is not None, timeout=PATIENCE_MS)
    opened.show_page("run")
    assert not page.model.busy
    opened.show_page("sweep")
    assert page.model.busy


@pytest.mark.parametrize(("running", "most"), [(True, 1), (False, 3)])
def test_in_a_run_a_page_that_is_shown_again_is_drawn_pane_by_pane(opened, page, monkeypatch, running, most):
    drawn, draw = [], page.turns._draw
    opened.show_page("run")
    with monkeypatch.context() as patched:
        patched.setattr(type(opened.controller), "running", property(lambda controller: running))
        patched.setattr(page.turns, "_draw", lambda pane: (drawn.append(pane), draw(pane)))
        page._mark_all()
        page._version = -1
        opened.show_page("sweep")
        first = len(drawn)
    assert 1 <= first <= most
    assert (first == 3) == (not running)


def test_drift_of_the_sentinel(page):
    page.tabs.setCurrentWidget(page.drift)
    _, percent = shown(page.drift.amplitude, "sentinel")
    assert percent[0] == 0
    assert len(percent) == 4
    assert page.drift.temperature.isVisible()


# A run


def test_it_follows_the_run_until_somebody_else_is_chosen(qtbot, alone):
    page, state = alone
    fed(page, state, [SegmentBegan(1, 1, 18.0, 22.0, 9)])
    assert page.chooser.segment == 1
    fed(page, state, [point(1, 18.0), SegmentBegan(2, 1, 108.0, 130.0, 9)])
    assert page.chooser.segment == 2
    qtbot.mouseClick(page.follow, LEFT, pos=page.follow.rect().topLeft() + page.follow.rect().center() / 8)
    assert not page.follow.isChecked()
    fed(page, state, [SegmentBegan(3, 1, 190.0, 230.0, 9)])
    assert page.chooser.segment == 2


def test_the_whole_region_is_in_view_from_its_first_point(qtbot, alone):
    page, state = alone
    fed(page, state, [SegmentBegan(1, 1, 18.0, 22.0, 9), point(1, 18.0)])
    qtbot.waitUntil(lambda: "good" in page.response.amplitude.names)
    low, high = page.response.amplitude.viewRange()[0]
    assert low < 18 < 22 < high
    fed(page, state, [point(2, 18.5)])
    qtbot.waitUntil(lambda: len(shown(page.response.amplitude, "good")[0]) == 2)


def test_points_of_every_pass_and_quality_are_in_the_legend(qtbot, alone):
    page, state = alone
    bad = {"control_error_percent": 2.0}
    fed(page, state, [point(1, 18.0), point(2, 19.0, sweep=2), point(3, 20.0, **bad)])
    wanted = {"good, pass 1", "good, pass 2", "out of limits"}
    qtbot.waitUntil(lambda: wanted <= set(page.response.amplitude.names))
    page.tabs.setCurrentWidget(page.quality)
    assert "out of limits" in page.quality.qualities.text().replace("&nbsp;", " ")


def test_a_step_is_followed_to_its_rest(qtbot, alone):
    page, _ = alone
    index = SyntheticSession(configuration())
    index.begin()
    index.sweep((1,), steps=1)
    settled = max(k for k, e in enumerate(index.events) if isinstance(e, StepSettled))
    state = SessionState(index.configuration)
    fed(page, state, index.events[: settled + 1])
    page.tabs.setCurrentWidget(page.step)
    qtbot.waitUntil(lambda: "dwelling" in page.step.words.text())
    assert page.step.facts["Level"].text().startswith("4.91")
    assert page.step.facts["Drive"].text() == "0.5 V of 5 V"
    seconds, left = shown(page.step.settling, "left")
    event = index.events[settled]
    assert seconds[-1] == pytest.approx(event.seconds)
    assert left[-1] == pytest.approx(max(event.remaining_percent, 1e-4), rel=1e-6)
    _, velocity = shown(page.step.velocity, "velocity")
    assert np.abs(velocity).max() > 1


def test_colours_follow_the_window(qtbot, opened, page):
    page.tabs.setCurrentWidget(page.quality)
    before = page.quality.channels.text()
    row = page.chooser.item(1)
    assert row.foreground().color().lightness() < 100
    opened.appearance.choose("dark")
    qtbot.waitUntil(lambda: page.quality.channels.text() != before)
    assert row.foreground().color().lightness() > 150
    opened.appearance.choose("light")
    qtbot.waitUntil(lambda: page.quality.channels.text() == before)


def test_a_sweep_of_another_file_is_drawn_even_without_a_session(qtbot, window, tmp_path):
    path = tmp_path / "other.csv"
    path.write_text(
        "frequency_hz,velocity_re_m_s,velocity_im_m_s\n" + "".join(f"{f},0.1,0.02\n" for f in range(15, 25))
    )
    window.show_page("sweep")
    page = window.pages[1]
    window.open(path)
    qtbot.waitUntil(lambda: "other.csv" in page.response.amplitude.names)
    assert page._layers.currentIndex() == 1


def test_back_in_time_there_are_fewer_points(qtbot, opened, page):
    feed = opened.controller.recorded
    page.walk(1)
    feed.jump(0.7 * feed.length_s)
    qtbot.waitUntil(lambda: 0 < len(page.seen.points) < 30)
    assert page.seen.curve is None
    feed.jump(feed.length_s)
    qtbot.waitUntil(lambda: len(page.seen.points) == 31)


# A pane for each resonance


def test_each_resonance_has_a_pane_with_its_own_points(opened, page):
    page.response.apart.setChecked(True)
    panes = page.response.resonances
    assert panes.isVisible()
    assert list(panes.plots) == [number for number, _, _ in page.seen.regions] == [1, 2, 3]
    p = page.seen.points
    for number, low, high in page.seen.regions:
        x, y = shown(panes.plots[number], "good")
        mine = (p.segment == number) & ~p.sentinel & (p.quality == 0)
        np.testing.assert_array_equal(x, p.frequency_hz[mine])
        np.testing.assert_allclose(y, 1e3 * np.abs(p.over_base_s[mine]))
        left, right = panes.plots[number].viewRange()[0]
        assert left < low < high < right


def test_the_heading_of_a_pane_shows_that_resonance_alone(qtbot, page):
    page.response.apart.setChecked(True)
    heading = page.response.resonances._headings[2]
    qtbot.mouseClick(heading, LEFT)
    assert page.chooser.segment == 2
    assert page.response.amplitude.isVisible()


def foreseen_of(page, regions):
    """A curve as `predict` would give it, of 1 (mm/s)/(m/s^2)."""
    stretches = []
    for (number, _, _), f in zip(regions, grid(regions), strict=True):
        none = np.full(len(f), np.nan)
        stretches.append(CurveStretch(number, f, np.full(len(f), 1e-3 + 0j), none, none))
    return Curve(tuple(stretches))


def test_what_is_foreseen_stands_in_every_pane_before_anything_is_measured(qtbot, alone, monkeypatch):
    page, state = alone
    page.response.apart.setChecked(True)
    monkeypatch.setattr(page.foreseen, "_start", lambda: None)
    regions = ((1, 18.0, 22.0), (2, 108.0, 130.0))
    state.foresee(regions)
    page.show_state(state)
    assert page.seen.regions[:2] == regions
    assert page.foreseen.busy
    page.foreseen.curve = foreseen_of(page, list(page.seen.regions))
    page.foreseen.rest()
    page.foreseen.changed.emit()
    panes = page.response.resonances.plots
    qtbot.waitUntil(lambda: all(FORESEEN in panes[number].names for number, _, _ in regions))
    for number, _, _ in regions:
        _, y = shown(page.response.resonances.plots[number], FORESEEN)
        np.testing.assert_allclose(y, 1.0)
    assert FORESEEN.split(",")[0] in page.response.resonances.key.text()


@pytest.mark.long
def test_the_foreseen_curve_is_what_predict_says_of_the_stated_specimen(qtbot, page):
    qtbot.waitUntil(lambda: page.foreseen.curve is not None, timeout=PATIENCE_MS)
    assert page.foreseen.failure == ""
    assert all(np.isnan(s.amplitude_std_s).all() for s in page.foreseen.curve.stretches)
    assert FORESEEN in page.response.amplitude.names


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
