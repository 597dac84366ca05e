"""What a fit, and a diagnosis with its effects, say at a session's own points."""

from pathlib import Path

import numpy as np
import pytest
from diagnosis_cases import diagnosis
from result_cases import identification
from sessions import point

from gui.actions.rediagnosis import DiagnosisAsked, ShownDiagnosis
from gui.pages.sweep.drawing import draw_amplitude, draw_phase
from gui.pages.sweep.panes import Pointed
from gui.pages.sweep.points import PointsMeasured
from gui.pages.sweep.predicted import Predicted, taken_of
from gui.pages.sweep.record_lines import record_lines
from gui.pages.sweep.seen import PaneContents
from gui.plots import Axis
from instrument.facts.diagnosis import PointLeft, Residual
from instrument.facts.identification import PointFitted
from instrument.session.contents import TimedPoint
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import FitUpdated

SETTINGS = SweepSettings()
SESSION = Path("one.h5")


def of(*points):
    return PointsMeasured.of([TimedPoint(p, 10.0 * k) for k, p in enumerate(points)], SETTINGS)


def all_in(points):
    return np.zeros(len(points), dtype=bool)


def fitted(f, **more):
    return PointFitted(frequency_hz=f, segment=1, measured_m_s=0.1, difference_percent=0.0, **more)


def left(f, percent=1.0, turn=0.0, **more):
    """With effects by so many percent and degrees off, without them by 10 %."""
    off = (1 + percent / 100) * np.exp(1j * np.radians(turn)) - 1
    parts = {"re_percent": 100 * off.real, "im_percent": 100 * off.imag}
    ten = Residual(amplitude_percent=10.0, re_percent=10.0, im_percent=0.0)
    one = {"segment": 1, "sweep": 1, "level_m_s2": 9.81, "noise_percent": 0.1}
    return PointLeft(
        frequency_hz=f, before=ten, after=Residual(amplitude_percent=percent, **parts), **one | more
    )


def shown(*rows, asked=None, **how):
    return ShownDiagnosis(diagnosis(**how).but(points=rows, points_set_aside=()), "", asked)


def with_effects(points, of_it, last_step=None):
    return Predicted.with_effects(points, of_it, last_step, all_in(points))


def test_rows_are_taken_only_where_they_belong_to_the_points():
    points = of(point(1, 20.0), point(2, 21.0), point(3, 22.0))
    for rows in ([fitted(f, predicted_m_s=0.1) for f in (20.0, 21.0)], [left(20.0), left(21.0)]):
        assert taken_of(points, rows, 2, all_in(points)).tolist() == [0, 1]
        assert taken_of(points, rows, 3, all_in(points)) is None
        assert taken_of(points, rows, None, all_in(points)) is None
        others = of(point(1, 20.5), point(2, 21.0))
        assert taken_of(others, rows, 2, all_in(others)) is None


def test_what_was_set_aside_has_no_row_and_the_others_keep_theirs():
    points = of(point(1, 20.0), point(2, 21.0), point(3, 22.0))
    aside = np.array([False, True, False])
    assert taken_of(points, [left(20.0), left(22.0)], None, aside).tolist() == [0, 2]


def test_rows_are_a_results_files_and_theirs_are_its_points_by_spot():
    """Its own spot was measured again after another one: the rows have both of its passes first."""
    there = {"pickup": 1, "spot_mm": (150.0, 24.0)}
    points = of(point(1, 20.0), point(2, 20.0, **there), point(3, 20.0), point(4, 20.0, mounting=1))
    for make in (left, lambda f, **more: fitted(f, predicted_m_s=1.0, **more)):
        rows = [make(20.0, pickup=k) for k in (0, 0, 1, 0)]
        assert taken_of(points, rows, 4, all_in(points)).tolist() == [0, 2, 1, 3]


def test_a_fit_says_its_own_amplitudes_and_one_that_failed_nothing():
    points = of(point(1, 20.0), point(2, 21.0))
    rows = [fitted(20.0, predicted_m_s=0.1), fitted(21.0, predicted_m_s=0.2)]
    found = FitUpdated(1, 2, identification().but(points=rows))
    predicted = Predicted.by_fit(points, found, all_in(points))
    assert (predicted.of(0), predicted.of(1), predicted.name) == (0.1, 0.2, "")
    for none in (None, FitUpdated(1, 2, None, "no")):
        assert not Predicted.by_fit(points, none, all_in(points)).index.size


def test_a_diagnosis_says_amplitude_and_phase_with_its_effects():
    points = of(point(1, 20.0), point(2, 21.0))
    found = with_effects(points, shown(left(20.0, 1.0, 3.0), left(21.0, -2.0, -170.0)))
    measured = np.abs(points.over_base_s) * points.level_m_s2
    np.testing.assert_allclose(found.amplitude_m_s, measured * [1.01, 0.98])
    np.testing.assert_allclose(found.turn_deg, [3.0, -170.0])
    assert found.name == "with added_mass"


def test_two_effects_doubt_and_a_persons_word_are_in_its_name():
    points, row = of(point(1, 20.0)), left(20.0)
    both = shown(row)
    pair = {"added_mass": ("added_mass",), "spot_offset": ("spot_offset",)}
    both = ShownDiagnosis(both.found.but(equivalent=pair), "")
    assert with_effects(points, both).name == "with added_mass and spot_offset"
    assert with_effects(points, shown(row, verdict="ambiguous")).name == "with added_mass (ambiguous)"
    by_hand = DiagnosisAsked(SESSION, accept=("added_mass",))
    assert with_effects(points, shown(row, asked=by_hand)).name == "with added_mass, by hand"


def test_nothing_is_said_where_no_effect_is_accepted_or_the_points_are_others():
    points, row = of(point(1, 20.0)), left(20.0)
    none = shown(row, verdict="none")
    assert not with_effects(points, ShownDiagnosis(none.found.but(equivalent={}, effects=()), "")).index.size
    assert not with_effects(points, shown(row.but(after=row.before))).index.size
    assert not with_effects(points, shown(left(20.5))).index.size
    assert not with_effects(points, shown(row, left(21.0))).index.size
    assert not with_effects(points, None).index.size


def test_a_recorded_diagnosis_has_the_points_before_it_and_one_made_here_all():
    points, row = of(point(1, 20.0), point(2, 21.0)), left(20.0)
    assert with_effects(points, shown(row), last_step=1).index.tolist() == [0]
    made_here = DiagnosisAsked(SESSION)
    assert not with_effects(points, shown(row, asked=made_here), last_step=1).index.size
    both = shown(row, left(21.0), asked=made_here)
    assert with_effects(points, both, last_step=1).index.tolist() == [0, 1]


@pytest.fixture
def seen():
    """Two passes of two points, a sentinel, and what a diagnosis says of each."""
    points = of(
        point(1, 20.0),
        point(2, 22.0),
        point(3, 20.0, sweep=2),
        point(4, 22.0, sweep=2),
        point(5, 20.0, purpose="sentinel"),
    )
    rows = [left(f, percent, 2.0) for f, percent in ((20, 1), (22, 2), (20, 3), (22, 4), (20, 5))]
    explained = with_effects(points, shown(*rows))
    fit = FitUpdated(
        1, 5, identification().but(points=[fitted(r.frequency_hz, predicted_m_s=0.1) for r in rows])
    )
    predicted = Predicted.by_fit(points, fit, all_in(points))
    return PaneContents(points, predicted=predicted, explained=explained, fit=1)


def test_each_pass_has_a_line_through_its_own_points(made, seen):
    plot = made(Pointed(Axis("f"), Axis("|v/a|")))
    draw_amplitude(plot, seen)
    f, y = plot.curves["with added_mass, at points"]
    np.testing.assert_array_equal(f, [20, 22, np.nan, 20, 22])
    one = 1e3 * np.abs(seen.points.over_base_s[0])
    np.testing.assert_allclose(y, one * np.array([1.01, 1.02, np.nan, 1.03, 1.04]))
    assert "model at the points, fit 1" in plot.names
    draw_phase(plot, seen)
    _, phase = plot.curves["with added_mass, at points"]
    np.testing.assert_allclose(phase - seen.points.phase_deg[0], [2, 2, np.nan, 2, 2])
    draw_amplitude(plot, seen.but(explained=Predicted()))
    assert not any("added_mass" in name for name in plot.names)


def test_the_record_of_a_point_has_what_fit_and_diagnosis_predict(seen):
    said = {line.name: line for line in record_lines(seen, 3, SETTINGS)}
    measured = 1e3 * abs(seen.points.over_base_s[3]) * 9.81
    assert said["Fit 1 predicts"].value.startswith("100 mm/s")
    assert said["Diagnosis predicts"].value == f"{1.04 * measured:.5g} mm/s, +4.00 %"
    assert "with added_mass" in said["Diagnosis predicts"].tip
