"""The panes of the sweep's page, each alone: what of some points they draw."""

from types import SimpleNamespace

import numpy as np
import pytest
from sessions import block, point

from gui.pages.sweep.chooser import Chooser
from gui.pages.sweep.curve import Curve, CurveStretch
from gui.pages.sweep.drift import DriftPane
from gui.pages.sweep.nyquist import NyquistPane
from gui.pages.sweep.pane_scheduler import PaneScheduler
from gui.pages.sweep.panes import CHOSEN, Key, Pointed, align, span
from gui.pages.sweep.points import Group, PointsMeasured
from gui.pages.sweep.quality import QualityPane
from gui.pages.sweep.record import RecordPane
from gui.pages.sweep.resonances import ResonancePanes
from gui.pages.sweep.response import ResponsePane
from gui.pages.sweep.samples import SamplesPane
from gui.pages.sweep.seen import PaneContents, Predicted
from gui.pages.sweep.segments import SegmentStatus
from gui.pages.sweep.step import StepPane
from gui.plots import Axis
from gui.state.step import Step
from instrument.session.contents import TimedPoint
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.raw import AcquisitionBegan, Held, StepBegan

SETTINGS = SweepSettings()
TIMED = [
    TimedPoint(point(k, f, temperature_c=21.0 + k, settle_s=0.1 * k), 60.0 * k)
    for k, f in enumerate((18.0, 20.0, 22.0), start=1)
]
SEEN = PaneContents(PointsMeasured.of(TIMED, SETTINGS), regions=((1, 15.0, 25.0), (2, 90.0, 110.0)))


def test_a_click_on_a_point_names_it_among_all_points(made):
    plot, heard = made(Pointed(Axis("Frequency", "Hz"), Axis("|v/a|"))), []
    plot.chosen.connect(heard.append)
    plot.show_points(Group("good", "data", "o", np.array([4, 7])), np.array([1.0, 2.0]), np.array([1.0, 2.0]))
    plot.picked.emit("good", 1)
    plot.picked.emit("something else", 0)
    assert heard == [7]


def test_the_point_looked_at_has_a_ring_until_another_is(made):
    plot = made(Pointed(Axis("Re"), Axis("Im")))
    plot.point_out(1.0, 2.0)
    assert CHOSEN in plot.names
    plot.point_out(None, None)
    assert CHOSEN not in plot.names


def test_plots_above_each_other_begin_at_the_same_place(made):
    plots = [made(Pointed(Axis("t", "s"), Axis(name))) for name in ("a", "b")]
    align(*plots)
    assert plots[0].getAxis("left").width() == plots[1].getAxis("left").width() > 0
    span(plots[0], np.array([2.0, 3.0, 4.0]))
    assert plots[0].viewRange()[0] == pytest.approx([1.96, 4.04])


def test_a_key_names_what_is_drawn(made):
    key = made(Key())
    key.show_groups([Group("with remarks", "fair", "s", np.array([0]))])
    assert "with&nbsp;remarks" in key.text()
    assert "\u25a0" in key.text()


def test_no_line_of_a_key_begins_between_a_sign_and_its_name(made):
    key = made(Key())
    key.show_key([("foreseen", "faint", "- -")])
    assert key.text().partition("</span>")[0].endswith(">\u2011&nbsp;\u2011")
    assert key.text().endswith("</span>&nbsp;foreseen")


def test_panes_are_drawn_in_turn_those_behind_the_last_first(made, qtbot):
    page = made(Key())
    panes, drawn = [made(Key()) for _ in range(3)], []
    scheduler = PaneScheduler(page, lambda: panes, drawn.append)
    scheduler.mark(*panes)
    scheduler.go_on()
    assert drawn == []  # nobody sees the page
    page.show()
    scheduler.go_on()
    scheduler.mark(panes[0])
    qtbot.waitUntil(lambda: len(drawn) == 4)
    assert drawn == [panes[0], panes[1], panes[2], panes[0]]


def test_the_segment_chosen_stays_chosen_while_it_is_there(made):
    chooser, heard = made(Chooser()), []
    chooser.chosen.connect(lambda: heard.append(chooser.segment))
    of = {n: SegmentStatus(n, "15 to 25 Hz", "done", "3 of 3", "1 g", 0) for n in (1, 2)}
    chooser.show_standings([of[1], of[2]])
    assert chooser.item(0).text() == "All segments\n2 of 2 done"
    chooser.choose(2)
    chooser.show_standings([of[2]])
    assert (chooser.segment, chooser.currentRow()) == (2, 1)
    chooser.show_standings([of[1]])
    assert heard == [2, None]


def test_without_a_sentinel_only_the_temperature_is_drawn(made):
    pane = made(DriftPane())
    pane.show_seen(SEEN, [])
    assert not pane.none.isHidden()
    assert pane.amplitude.isHidden()
    np.testing.assert_allclose(pane.temperature.curves["plate"], [[1.0, 2.0, 3.0], [22.0, 23.0, 24.0]])


def test_the_response_stands_in_its_plane(made):
    pane = made(NyquistPane())
    pane.show_seen(SEEN.but(chosen=1))
    x, y = pane.plot.curves["good"]
    np.testing.assert_allclose(x + 1j * y, SEEN.shown)
    assert CHOSEN in pane.plot.names


def test_the_time_each_point_took_to_settle_is_drawn(made):
    pane = made(QualityPane())
    pane.show_seen(SEEN, SETTINGS)
    f, seconds = pane.settling.curves["good"]
    np.testing.assert_allclose([f, seconds], [[18.0, 20.0, 22.0], [0.1, 0.2, 0.3]])
    assert any(name.startswith("tolerance") for name in pane.level.names)


def test_the_record_is_of_the_point_looked_at(made):
    pane, heard = made(RecordPane()), []
    pane.stepped.connect(heard.append)
    pane.show_seen(SEEN, SETTINGS)
    assert pane.lines == []
    pane.show_seen(SEEN.but(chosen=1), SETTINGS)
    assert "20 Hz" in pane.title.text()
    pane.on.click()
    pane.back.click()
    assert heard == [1, -1]


def test_each_resonance_has_a_pane_with_its_own_points(made):
    panes = made(ResonancePanes())
    panes.show_seen(SEEN)
    assert list(panes.plots) == [1, 2]
    assert list(panes.plots[1].curves["good"][0]) == [18.0, 20.0, 22.0]
    assert "good" not in panes.plots[2].names or not len(panes.plots[2].curves["good"][0])


def test_in_a_narrow_window_panes_are_as_wide_as_each_other_and_each_axis_has_its_numbers(made):
    panes = made(ResonancePanes())
    panes.resize(410, 300)
    panes.show()
    panes.show_seen(SEEN.but(regions=((1, 15.21, 25.35), (2, 89.59, 115.2), (3, 235.0, 295.0))))
    wide = [plot.width() for plot in panes.plots.values()]
    assert max(wide) - min(wide) <= 1
    assert len({plot.getAxis("bottom").labelText for plot in panes.plots.values()}) == 1
    axis = panes.plots[3].getAxis("bottom")
    laid_out = axis.mapRectFromParent(axis.geometry())
    assert axis.beyond_px > 0
    assert laid_out.width() + 2 * axis.beyond_px <= axis.boundingRect().width()


def test_the_model_of_one_spot_is_not_drawn_through_the_points_of_another(made):
    """A curve of 1 s at the file's spot; the fit says 2 m/s of what was read elsewhere, at its points."""
    there = {"pickup": 1, "spot_mm": (150.1, 23.99), "mounting": 1, "sweep": 2}
    here = [point(k, f) for k, f in enumerate((18.0, 20.0, 22.0), start=1)]
    away = [point(k + 9, f, **there) for k, f in enumerate((18.0, 20.0, 22.0))]
    alone = [point(k + 19, f, segment=2, **there) for k, f in enumerate((95.0, 105.0))]
    every = [*here, *away, *alone]
    curves = []
    for number, low, high in SEEN.regions:
        f, none = np.linspace(low, high, 5), np.full(5, np.nan)
        curves.append(CurveStretch(number, f, np.ones(5, complex), none, none))
    seen = SEEN.but(
        points=PointsMeasured.of([TimedPoint(p, 1.0 * p.step) for p in every], SETTINGS),
        curve=Curve(tuple(curves)),
        predicted=Predicted(np.arange(8), np.array([7.0] * 3 + [2.0] * 5)),
        fit=3,
    )
    own = "model, fit 3, ±2 s.e., spot of the specimen file, first clamping"
    other = "model at the points, fit 3, spot 150.1, 24 mm, clamped anew"
    pane = made(ResponsePane())
    pane.show_seen(seen.but(segment=1))
    assert {own, other, "good, pass 2, spot 150.1, 24 mm, clamped anew"} <= set(pane.amplitude.names)
    np.testing.assert_allclose(pane.amplitude.curves[own][1], 1e3)
    f, size = pane.amplitude.curves[other]
    assert list(f) == [18.0, 20.0, 22.0]
    np.testing.assert_allclose(size, 1e3 * 2.0 / 9.81)
    assert own in pane.phase.names
    pane.show_seen(seen.but(segment=2))
    assert own not in pane.amplitude.names
    assert own not in pane.phase.names
    assert other in pane.amplitude.names
    plane = made(NyquistPane())
    plane.show_seen(seen.but(segment=2))
    assert not any(name.startswith("model") for name in plane.plot.names)


def test_what_the_response_is_shown_as_is_what_was_chosen(made):
    pane = made(ResponsePane())
    assert (pane.way.quantity, pane.way.log_frequency) == ("ratio", False)
    pane.quantity.setCurrentText("velocity at its level")
    pane.log_frequency.setChecked(True)
    assert (pane.way.quantity, pane.way.log_frequency) == ("velocity", True)


def test_samples_are_shown_once_there_is_a_file_of_them(made):
    pane = made(SamplesPane())
    pane.show_seen(SEEN.but(chosen=1), None)
    later = pane.said.text()
    pane.show_seen(SEEN, None)
    assert later != pane.said.text()
    assert not pane.dwells.busy


def test_what_is_long_of_a_step_has_a_row_of_its_own(made):
    pane = made(StepPane())
    pane.resize(290, 400)
    pane._whole.show()
    pane.facts["Transient"].say("<0.001 % of 0.1, noise 0.53")
    pane.facts["Level"].say("+0.00 %, 9.81 of 9.81 m/s\u00b2")
    pane.facts["Light"].say("0.80 (least 0.1)")
    pane.facts["Range"].say("50mm/s/V")
    pane.show()
    assert not [label.said for label in pane.facts.values() if label.text() != label.said]


def test_without_a_step_its_pane_says_what_will_be_there(made):
    pane = made(StepPane())
    assert not pane.none.isHidden()
    assert {label.said for label in pane.facts.values()} == {"\u2013"}


class Units:
    """Volts as they come."""

    def motion(self, volts, scale_m_s_v):
        return volts


def roles(pane):
    """Of the traces."""
    return [pane.base._curves["base acceleration"].role, pane.velocity._curves["velocity"].role]


def test_a_step_that_was_held_is_drawn_as_past_and_has_no_level(made):
    pane = made(StepPane())
    pane.show()
    acquired = AcquisitionBegan(1, "sweep", 8192.0, ("base", "velocity"))
    step = Step(StepBegan(1, "step", 1, 1, 2048.0, 9.81, 0.1, 0.1), acquired, Units())
    state = SimpleNamespace(step=step, limits=SETTINGS, range=None, signal_level=None)
    step.take(block(0), None)
    pane.show_step(state)
    assert roles(pane) == ["second", "data"]
    assert pane.velocity.x.label == "Time before the latest sample"
    step.take(Held(), None)
    pane.show_step(state)
    assert roles(pane) == ["faint", "faint"]
    assert pane.velocity.x.label == "Time before the hold"
    assert not pane.base.x.titled
    assert pane.facts["Level"].said == "none while held, of 9.81 m/s\u00b2"
    assert pane.facts["Transient"].said == "\u2013"
