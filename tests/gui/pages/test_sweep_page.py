import numpy as np
import pytest
from PySide6.QtCore import Qt
from sweep_views import LEFT, click_point, click_segment, shown, value
from sweep_views import looked_at as looked_at
from sweep_views import page as page

from gui.style.theme import DARK, LIGHT
from instrument.stepped_sine.sine_fit import sine_fit

pytestmark = pytest.mark.pages("run", "sweep")

PATIENCE_MS = 240_000


def test_without_a_session_it_says_what_will_appear(qtbot, window):
    window.show_page("sweep")
    assert "Open a session, or start a run" in window.pages[1]._layers.currentWidget().text()


def test_a_click_on_a_segment_shows_its_points(qtbot, looked_at):
    page = looked_at
    click_segment(qtbot, page, 2)
    for plot in (page.response.amplitude, page.response.phase):
        f, _ = shown(plot, "good")
        np.testing.assert_allclose(f, np.linspace(108, 130, 9))
        assert plot.viewRange()[0] == pytest.approx([108 - 0.04 * 22, 130 + 0.04 * 22])
    click_segment(qtbot, page, 0)
    assert len(shown(page.response.amplitude, "good")[0]) == 3 * 9 - 1


def test_a_point_with_a_remark_looks_different(looked_at):
    page = looked_at
    f, _ = shown(page.response.amplitude, "with remarks")
    assert f.tolist() == [19.0]


def test_the_amplitude_is_velocity_over_base(looked_at):
    page = looked_at
    points = page.seen.points
    k = int(np.flatnonzero(points.frequency_hz == 20.5)[0])
    p = points.timed[k].point
    f, y = shown(page.response.amplitude, "good")
    assert y[f == 20.5] == pytest.approx(1e3 * abs(p.velocity_m_s / p.base_m_s2))
    page.response.quantity.setCurrentText("velocity at its level")
    assert page.response.amplitude.y.unit == "mm/s"
    f, y = shown(page.response.amplitude, "good")
    assert y[f == 20.5] == pytest.approx(1e3 * abs(p.velocity_m_s / p.base_m_s2) * p.level_m_s2)


def test_in_g_response_levels_and_record_are_shown_in_g(kept, looked_at):
    page = looked_at
    page.choose(0)
    _, before = shown(page.response.amplitude, "good")
    assert value(page, "Level asked for") == "4.905 m/s\u00b2"
    kept.show_acceleration_in("g")
    try:
        assert page.response.amplitude.y.unit == "(mm/s)/g"
        np.testing.assert_allclose(shown(page.response.amplitude, "good")[1], 9.80665 * before)
        assert value(page, "Level asked for") == "0.5002 g"
        assert "0.5 g" in page.chooser.item(1).text()
        assert kept.settings.acceleration == "g"
    finally:
        kept.show_acceleration_in("m/s2")
    np.testing.assert_allclose(shown(page.response.amplitude, "good")[1], before)


def test_the_key_of_the_step_follows_the_mode(qtbot, kept, looked_at):
    page = looked_at
    kept.appearance.choose("dark")
    qtbot.waitUntil(lambda: DARK.data in page.step.key.text())
    kept.appearance.choose("light")
    qtbot.waitUntil(lambda: LIGHT.data in page.step.key.text())


@pytest.mark.parametrize("box", ["log_amplitude", "log_frequency"])
def test_axes_can_be_logarithmic(qtbot, looked_at, box):
    page = looked_at
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
def test_a_click_on_a_point_shows_its_record(qtbot, looked_at, plot):
    page = looked_at
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


def test_the_samples_of_the_point_are_read_from_the_file(qtbot, looked_at):
    page = looked_at
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


@pytest.mark.parametrize(("running", "most"), [(True, 1), (False, 3)])
def test_in_a_run_a_page_that_is_shown_again_is_drawn_pane_by_pane(
    kept, looked_at, monkeypatch, running, most
):
    page = looked_at
    drawn, draw = [], page.turns._draw
    kept.show_page("run")
    with monkeypatch.context() as patched:
        patched.setattr(type(kept.controller), "running", property(lambda controller: running))
        patched.setattr(page.turns, "_draw", lambda pane: (drawn.append(pane), draw(pane)))
        page._mark_all()
        page._version = -1
        kept.show_page("sweep")
        first = len(drawn)
    assert 1 <= first <= most
    assert (first == 3) == (not running)


def test_drift_of_the_sentinel(looked_at):
    page = looked_at
    page.tabs.setCurrentWidget(page.drift)
    _, percent = shown(page.drift.amplitude, "sentinel")
    assert percent[0] == 0
    assert len(percent) == 4
    assert page.drift.temperature.isVisible()


def test_colours_follow_the_window(qtbot, kept, looked_at):
    page = looked_at
    page.tabs.setCurrentWidget(page.quality)
    before = page.quality.channels.text()
    row = page.chooser.item(1)
    assert row.foreground().color().lightness() < 100
    kept.appearance.choose("dark")
    qtbot.waitUntil(lambda: page.quality.channels.text() != before)
    assert row.foreground().color().lightness() > 150
    kept.appearance.choose("light")
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


def test_a_sweep_over_a_force_is_not_drawn_but_can_be_diagnosed(qtbot, window, tmp_path):
    path = tmp_path / "struck.csv"
    head = "frequency_hz,velocity_re_m_s,velocity_im_m_s,force_re_n,force_im_n\n"
    path.write_text(head + "".join(f"{f},0.1,0.02,1.0,0.0\n" for f in range(15, 25)))
    window.show_page("sweep")
    window.open(path)
    qtbot.waitUntil(lambda: "over a force, so not drawn" in window.notice.text)
    assert window.pages[1]._layers.currentIndex() == 0
    assert list(window.controller.beside) == [path]


def test_back_in_time_there_are_fewer_points(qtbot, kept, looked_at):
    page = looked_at
    feed = kept.controller.recorded
    page.walk(1)
    feed.jump(0.7 * feed.length_s)
    qtbot.waitUntil(lambda: 0 < len(page.seen.points) < 30)
    assert page.seen.curve is None
    feed.jump(feed.length_s)
    qtbot.waitUntil(lambda: len(page.seen.points) == 31)


# A pane for each resonance


def test_each_resonance_has_a_pane_with_its_own_points(looked_at):
    page = looked_at
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


def test_the_heading_of_a_pane_shows_that_resonance_alone(qtbot, looked_at):
    page = looked_at
    page.response.apart.setChecked(True)
    heading = page.response.resonances._headings[2]
    qtbot.mouseClick(heading, LEFT)
    assert page.chooser.segment == 2
    assert page.response.amplitude.isVisible()
