"""What the page of the sweep draws, as numbers."""

from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
from session_cases import SyntheticSession, configuration
from sessions import point

from fitting.data.aside import LOST, reasons
from gui.pages.sweep.curve import CurveStretch, grid, joined, regions_of
from gui.pages.sweep.drifted import drifted
from gui.pages.sweep.following import Following, latest_cycles, words
from gui.pages.sweep.overlay import besides
from gui.pages.sweep.points import PointsMeasured
from gui.pages.sweep.record_lines import record_lines
from gui.pages.sweep.seen import PaneContents, Way
from gui.pages.sweep.segments import standings
from gui.state import SessionState
from instrument.interchange.found import Found
from instrument.results.set_aside import NAME
from instrument.session.contents import SegmentRun, TimedPoint
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import SentinelCompared, StepSettled
from instrument.stream.event import Positive
from instrument.stream.raw import SegmentBegan, SegmentEnded, SessionBegan, SessionEnded

SETTINGS = SweepSettings()
WEAK, RESTLESS = ("weak light: signal level 0.05",), ("not settled: 0.3 % left, limit 0.1 %",)


def timed(*points):
    return [TimedPoint(p, 10.0 * k) for k, p in enumerate(points)]


def of(*points):
    return PointsMeasured.of(timed(*points), SETTINGS)


def groups(points):
    return {g.name: list(g.index) for g in points.groups(np.ones(len(points), dtype=bool))}


@pytest.fixture(scope="module")
def index():
    """A sweep of two segments, the second broken off."""
    index = SyntheticSession(configuration())
    index.begin()
    index.calibrate()
    index.sweep((1, 2), steps=4)
    return index


@pytest.fixture(scope="module")
def state(index):
    state = SessionState(index.configuration)
    for event in index.events:
        state.take(event)
    return state


# Points


def test_points_are_told_apart_by_quality_and_purpose():
    found = groups(
        of(
            point(1),
            point(2, remarks=WEAK),
            point(3, remarks=RESTLESS),
            point(4, control_error_percent=-1.2),
            point(5, purpose="sentinel"),
        )
    )
    assert found == {"good": [0], "with remarks": [1], "out of limits": [2, 3], "sentinel": [4]}


def test_passes_and_levels_have_names_and_looks_of_their_own():
    points = of(point(1), point(2, sweep=2), point(3, sweep=2, level_m_s2=19.62))
    drawn = points.groups(np.ones(3, dtype=bool))
    assert [g.name for g in drawn] == [
        "good, pass 1, 9.81 m/s²",
        "good, pass 2, 9.81 m/s²",
        "good, pass 2, 19.6 m/s²",
    ]
    assert len({(g.role, g.symbol) for g in drawn}) == 3


def test_points_that_come_later_are_added_to_those_there_are():
    all_of_them = timed(*(point(k, 20.0 + k) for k in range(5)))
    some = PointsMeasured.of(all_of_them[:2], SETTINGS)
    more = some.up_to(all_of_them, SETTINGS)
    np.testing.assert_array_equal(more.table, PointsMeasured.of(all_of_them, SETTINGS).table)
    assert more.up_to(all_of_them, SETTINGS) is more
    others = timed(*(point(k, 40.0 + k) for k in range(5)))
    np.testing.assert_array_equal(more.up_to(others, SETTINGS).frequency_hz, 40.0 + np.arange(5))


def test_phase_has_no_jumps_inside_a_segment_whatever_the_order():
    turn = np.radians([170.0, 190.0, 210.0])
    v = np.exp(1j * turn)
    order = [2, 0, 1]
    points = of(
        *(
            point(
                k, 20.0 + k, base_accel_re_m_s2=1.0, base_accel_im_m_s2=0.0,
                velocity_re_m_s=v[k].real, velocity_im_m_s=v[k].imag,
            )
            for k in order
        )
    )  # fmt: skip
    np.testing.assert_allclose(points.phase_deg, np.degrees(turn)[order])


def test_a_sentinel_elsewhere_is_no_part_of_a_segments_view():
    points = of(
        point(1, 110.0),
        point(2, 112.0),
        point(3, 20.0, purpose="sentinel"),
        point(4, 111.0, purpose="sentinel"),
    )
    seen = PaneContents(points, segment=1, regions=((1, 108.0, 130.0),))
    assert seen.wanted.tolist() == [True, True, False, True]
    assert PaneContents(points).wanted.all()


def test_one_walks_along_the_frequency_and_stops_at_the_ends():
    seen = PaneContents(
        of(point(1, 30.0), point(2, 10.0), point(3, 20.0), point(4, 5.0, segment=2)), segment=1
    )
    assert seen.neighbour(1) == 1
    assert seen.but(chosen=1).neighbour(1) == 2
    assert seen.but(chosen=0).neighbour(1) == 0
    assert seen.but(chosen=1).neighbour(-1) == 1
    assert PaneContents(of()).neighbour(1) is None


def test_velocity_is_the_response_times_the_level_commanded():
    seen = PaneContents(of(point(1)), way=Way("velocity"))
    assert seen.shown[0] == pytest.approx(1e3 * 9.81 * (0.05 - 0.02j) / (9.8 + 0.1j))


# The model


def test_the_model_has_as_many_turns_as_the_points():
    f = np.linspace(19, 21, 5)
    points = of(*(point(k, x, velocity_re_m_s=-0.05, velocity_im_m_s=0.02) for k, x in enumerate(f)))
    response = points.over_base_s[0] * np.exp(-0.01j)
    stretch = CurveStretch(1, f, np.full(5, response), np.full(5, np.nan), np.full(5, np.nan))
    np.testing.assert_allclose(points.phase_deg - stretch.phase_deg(points), np.degrees(0.01))

    class Turned(PointsMeasured):
        phase_deg = points.phase_deg - 360

    moved = Turned(points.timed, points.table)
    np.testing.assert_allclose(stretch.phase_deg(moved), stretch.phase_deg(points) - 360)


def test_what_is_set_aside_is_a_group_of_its_own_turns_no_phase_and_says_why():
    turned = [np.exp(1j * np.radians(p)) for p in (170, -170, 0, -150, -130)]
    each = [
        point(k, 20.0 + k, velocity_re_m_s=v.real, velocity_im_m_s=v.imag, base_accel_im_m_s2=0.0)
        for k, v in enumerate(turned)
    ]
    points = of(*each).setting_aside(reasons(np.arange(5) == 2, LOST))
    assert groups(points) == {"good": [0, 1, 3, 4], NAME: [2]}
    assert points.phase_deg[[0, 1, 3, 4]] == pytest.approx([170, 190, 210, 230])
    assert points.phase_deg[2] % 360 == pytest.approx(0, abs=1e-9)
    assert points.setting_aside(points.why_aside) is points
    more = points.up_to([*points.timed, *timed(point(9, 30.0))], SETTINGS)
    assert np.flatnonzero(more.aside).tolist() == [2]
    said = {line.name: line.value for line in record_lines(PaneContents(points), 2, SETTINGS)}
    assert "signal lost" in said["Set aside, not fitted"]
    assert "Set aside, not fitted" not in {x.name for x in record_lines(PaneContents(points), 1, SETTINGS)}


def test_what_was_read_elsewhere_is_a_group_of_its_own_and_turns_no_phase():
    opposite = {"velocity_re_m_s": -0.05, "velocity_im_m_s": 0.0195, "mounting": 1}
    points = of(
        *(point(k, 20.0 + k) for k in range(3)), *(point(9 + k, 20.5 + k, **opposite) for k in range(3))
    )
    assert groups(points) == {"good": [0, 1, 2], "good, clamped anew": [3, 4, 5]}
    assert np.ptp(points.phase_deg[:3]) == np.ptp(points.phase_deg[3:]) == 0.0
    assert points.read_at("").tolist() == [True] * 3 + [False] * 3


def test_every_region_is_drawn_once_with_gaps_between():
    runs = {
        (1, 1): SegmentRun(1, 1, 18.0, 22.0, 9, True),
        (1, 2): SegmentRun(2, 1, 100.0, 110.0, 9, True),
        (2, 1): SegmentRun(1, 2, 18.0, 22.0, 9, False),
    }
    regions = regions_of(runs)
    assert regions == [(1, 18.0, 22.0), (2, 100.0, 110.0)]
    whole = joined(grid(regions))
    assert np.isnan(whole).sum() == 1
    assert np.nanmin(whole) == 18.0


# Segments, drift, record


def test_segments_are_planned_running_done_or_broken_off(state, index):
    points = PointsMeasured.of(state.contents.points, state.limits)
    stand = standings(state, points)
    assert [s.state for s in stand] == ["done", "running", "planned"]
    assert [s.points for s in stand] == ["9 of 9 points", "4 of 9 points", "0 of 9 points"]
    assert stand[0].band == "18 to 22 Hz"
    assert stand[0].marked == 1
    assert {s.level for s in stand} == {"4.91 m/s²"}
    over = SessionState(index.configuration)
    for event in (*index.events, SessionEnded("stopped safely", "interlock open")):
        over.take(event)
    assert [s.state for s in standings(over, points)] == ["done", "broken off", "planned"]


def test_a_segment_is_done_only_after_its_last_pass():
    config = configuration()
    config.experiment.sweep.sweeps = 2
    state, none = SessionState(config), of()
    state.take(SessionBegan("2026-04-01T08:00:05+00:00", "0", {}, ()))
    state.take(SegmentBegan(1, 1, 18.0, 22.0, 9))
    state.take(SegmentEnded(1, 1))
    first = standings(state, none)[0]
    assert (first.state, first.points) == ("running", "0 of 18 points, pass 1 of 2")
    state.take(SegmentBegan(1, 2, 18.0, 22.0, 9))
    state.take(SegmentEnded(1, 2))
    assert standings(state, none)[0].state == "done"


def test_a_pass_that_a_diagnosis_asked_for_breaks_no_segment_off():
    """Of other steps than the file's; it is done with them."""
    state, none = SessionState(configuration()), of()
    state.take(SessionBegan("2026-04-01T08:00:05+00:00", "0", {}, ()))
    for turn, steps in ((1, 25), (2, 20)):
        state.take(SegmentBegan(1, turn, 18.0, 22.0, steps))
        state.take(SegmentEnded(1, turn))
    state.take(SessionEnded("done", ""))
    first = standings(state, none)[0]
    assert (first.state, first.points) == ("done", "0 of 45 points, pass 2 of 2")


def test_drift_begins_with_the_first_sentinel_at_zero():
    points = of(point(1, purpose="sentinel"), point(2), point(3, purpose="sentinel"))
    drift = drifted(points, [SentinelCompared(3, 20.0, -0.4, 0.1)])
    assert drift.index.tolist() == [0, 2]
    assert drift.time_s.tolist() == [0.0, 20.0]
    assert drift.percent.tolist() == [0.0, -0.4]
    assert "at most -0.400 %" in drift.words
    assert drifted(points, []) is None


def test_the_record_tells_every_field_of_a_point():
    numbers = {
        name: 0.5 + 0.001 * k
        for k, name in enumerate(f.name for f in fields(point()) if f.type in (float, Positive))
    }
    one = point(31, **numbers, signal_level=0.77, temperature_c=21.25, remarks=WEAK, segment=4, sweep=3)
    seen = PaneContents(of(one))
    lines = record_lines(seen, 0, SETTINGS)
    said = " | ".join(line.value for line in lines)
    wanted = {
        "frequency_hz": "0.5 Hz", "level_m_s2": "0.501 m/s", "dwell_s": "0.502 s", "settle_s": "0.503 s",
        "drive_v": "0.504 V", "control_error_percent": "+0.511 %", "base_distortion_percent": "0.51 %",
    }  # fmt: skip
    assert set(wanted) <= set(numbers)
    for text in (*wanted.values(), "0.77", "21.25", "31 (step)", "4, 3", one.range_name, *WEAK):
        assert text in said, text
    for value in (
        one.base_m_s2.real,
        one.base_m_s2.imag,
        1e3 * one.velocity_m_s.real,
        1e3 * one.velocity_m_s.imag,
    ):
        assert f"{value:.5g}" in said


# The step in progress


def test_settling_is_followed_as_the_measurement_saw_it(index):
    """Block by block to the very number the measurement decided by."""
    state, compared = SessionState(index.configuration), 0
    following = Following(state.limits)
    for event in index.events:
        state.take(event)
        if state.step is None or state.step.over:
            continue
        while following.take(state.step):
            pass
        if isinstance(event, StepSettled):
            last = following.course.standings[-1]
            # The rounding of a fit's noise is in the bound: of readings without noise that is all there is.
            assert 100 * last.remaining == pytest.approx(event.remaining_percent, rel=1e-9, abs=1e-6)
            assert last.seconds == pytest.approx(event.seconds)
            compared += 1
    assert compared > 10


def test_the_step_is_put_into_words(state):
    assert words(state.step, state.limits) == f"116.25 Hz, step {state.step.began.step}: measured"


def test_the_time_signal_ends_with_the_latest_sample(state):
    trace = latest_cycles(state.step)
    assert trace.time_s[-1] == 0
    assert -trace.time_s[0] == pytest.approx(8 / state.step.began.frequency_hz, rel=0.01)
    assert np.abs(trace.base_m_s2).max() == pytest.approx(0.5 * 9.81, rel=0.05)


# Other files


def test_a_sweep_over_a_force_is_no_ratio_to_a_base_and_is_not_drawn():
    f, one = np.array([20.0, 21.0]), np.ones(2)
    struck = {"frequency_hz": f, "velocity_re_m_s": one, "velocity_im_m_s": one}
    struck |= {"force_re_n": one, "force_im_n": 0 * one}
    shaken = {"frequency_hz": f, "velocity_m_s": one}
    assert [one.name for one in besides({Path("a.csv"): Found(sweeps=[struck, shaken])})] == ["a.csv, 2"]


def test_a_sweep_of_another_file_is_brought_to_the_same_quantity():
    f = np.array([21.0, 20.0])
    columns = {
        "frequency_hz": f,
        "velocity_re_m_s": np.array([0.1, 0.2]),
        "velocity_im_m_s": np.zeros(2),
        "base_accel_re_m_s2": np.array([5.0, 4.0]),
        "base_accel_im_m_s2": np.zeros(2),
    }
    amplitudes = {"frequency_hz": f, "velocity_m_s": np.array([0.1, 0.2])}
    phasors, sizes = besides({Path("other.csv"): Found(sweeps=[columns, amplitudes])})
    assert (phasors.name, sizes.name) == ("other.csv, 1", "other.csv, 2")
    np.testing.assert_allclose(phasors.over_base_s, [0.05, 0.02])
    np.testing.assert_allclose(sizes.over_base_s, np.array([0.2, 0.1]) / 9.81)
    assert (phasors.has_phase, sizes.has_phase) == (True, False)
    assert phasors.inside((20.5, 22.0)).tolist() == [False, True]
