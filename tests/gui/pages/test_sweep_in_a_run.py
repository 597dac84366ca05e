import numpy as np
import pytest
from session_cases import SyntheticSession, configuration
from sessions import point
from sweep_views import LEFT, fed, shown

from gui.actions.controller import AppController
from gui.pages.sweep import SweepPage
from gui.pages.sweep.curve import Curve, CurveStretch, grid
from gui.pages.sweep.drawing import FORESEEN
from gui.state import SessionState
from instrument.stream.derived import StepSettled
from instrument.stream.raw import FitFailed, FitStarted, SegmentBegan, SessionBegan

BEGAN = SessionBegan("2026-04-01T08:00:05+00:00", "0", {}, ())


@pytest.fixture
def alone(qtbot):
    """A page and a state to be filled by hand."""
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
    assert "%, 4.91" in page.step.facts["Level"].said
    assert page.step.facts["Drive"].said == "0.5 V of 5 V"
    # Curves follow words: they are drawn when the window has time.
    qtbot.waitUntil(lambda: len(shown(page.step.settling, "left")[0]) > 0)
    seconds, left = shown(page.step.settling, "left")
    event = index.events[settled]
    assert seconds[-1] == pytest.approx(event.seconds)
    assert left[-1] == pytest.approx(max(event.remaining_percent, 1e-4), rel=1e-6)
    _, velocity = shown(page.step.velocity, "velocity")
    assert np.abs(velocity).max() > 1


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


def test_a_first_fit_that_failed_is_no_longer_said_to_go_on(qtbot, alone):
    page, state = alone
    fed(page, state, [point(1, 18.0), FitStarted(1, 1)])
    qtbot.waitUntil(lambda: page.response.model.text() == "fitting ...")
    fed(page, state, [FitFailed(1, "no memory left")])
    qtbot.waitUntil(lambda: page.response.model.text() == "fit 1 failed: no memory left")
