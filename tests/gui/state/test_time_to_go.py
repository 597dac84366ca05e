"""The time to go of whole runs, on the run's own clock."""

import random

import pytest
from following_cases import SPOT
from foretold import told_of
from sessions import point

from gui.state.time_to_go import TimeToGo
from instrument.check.piece import TimedPiece
from instrument.facts.follow_up import FollowUp
from instrument.stream.derived import DiagnosisFound, FitUpdated
from instrument.stream.raw import (
    AcquisitionBegan,
    DiagnosisStarted,
    FitStarted,
    FollowUpDecided,
    FollowUpEnded,
    FollowUpProposed,
    Held,
    OperatorDid,
    SessionBegan,
    StepBegan,
)

WITHIN = 0.15


@pytest.mark.long
@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_of_a_whole_run_the_time_to_go_is_right_within_15_percent(tmp_path, seed):
    watched = told_of(tmp_path, ("hammer", "sweep"), seed)
    assert max(map(abs, watched.errors().values())) < WITHIN, watched.errors()


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("fewer points", lambda text: text.replace("points = 21", "points = 9")),
        ("wider", lambda text: text.replace("span_percent = 25.0", "span_percent = 60.0")),
        ("two sweeps", lambda text: text.replace("[sweep]\n", "[sweep]\nsweeps = 2\n")),
        ("without calibration", lambda text: text.replace("[sweep]\n", "[sweep]\ncalibration = false\n")),
        ("weaker", lambda text: text.replace("level_g = 1.0", "level_g = 0.3")),
        ("without sentinel", lambda text: text.replace("[sweep]\n", "[sweep]\nsentinel = false\n")),
    ],
)
def test_of_other_sweeps_too(tmp_path, name, change):
    watched = told_of(tmp_path, ("sweep",), 7, change)
    assert max(map(abs, watched.errors().values())) < WITHIN, watched.errors()


# Made up


def steps(count: int) -> tuple[TimedPiece, ...]:
    return (TimedPiece("step", 1.0, 2.0),) * count


def measured(watched: TimeToGo, durations, begin_s=0.0) -> float:
    now = begin_s
    for number, took in enumerate(durations, start=1):
        now += took
        watched.take(point(number), now, 0.0)
    return now


@pytest.mark.parametrize("pace", [0.5, 1.0, 3.0])
def test_a_pace_other_than_forecast_is_learned(pace):
    chance, to_go = random.Random(1), TimeToGo()
    to_go.plan(steps(100), 0.0)
    durations = [pace * 2.3 * chance.uniform(0.8, 1.2) for _ in range(100)]
    for share in (0.3, 0.6):
        count = round(100 * share)
        at = TimeToGo()
        at.plan(steps(100), 0.0)
        now = measured(at, durations[:count])
        assert at.measuring_s(now) == pytest.approx(sum(durations[count:]), rel=WITHIN)


def test_something_is_known_before_the_first_sample_and_the_bar_never_goes_back():
    to_go, last = TimeToGo(), 0.0
    assert to_go.measuring_s(0.0) is None
    to_go.plan(
        (TimedPiece("hit", 15.0), *steps(20), TimedPiece("fit", 8.0), TimedPiece("diagnosis", 60.0)), 0.0
    )
    assert to_go.measuring_s(0.0) > 50
    assert to_go.beside_s(0.0) == 68
    for number in range(1, 21):
        to_go.take(point(number), 2.3 * number, 0.0)
        assert to_go.fraction(2.3 * number, 0.0) >= last
        last = to_go.fraction(2.3 * number, 0.0)


def test_what_is_measured_after_a_diagnosis_counts_once_it_is_agreed_to():
    watched = TimeToGo()
    watched.plan((TimedPiece("diagnosis", 60.0),), 0.0)
    watched.take(DiagnosisStarted(1, 10), 5.0, 100.0)
    watched.take(DiagnosisFound(1, 10, None, ""), 5.0, 120.0)
    spot = FollowUp.model_validate({**SPOT, "seconds": 150.0})
    watched.take(FollowUpProposed(1, 1, (spot,)), 5.0, 120.0)
    assert watched.measuring_s(5.0) == 0.0
    watched.take(FollowUpDecided(1, 0, True, "person"), 5.0, 121.0)
    # Three steps in thirty seconds; two minutes of hands, and a diagnosis as long as the last.
    assert watched.measuring_s(5.0) == pytest.approx(30.0)
    assert watched.beside_s(121.0) == pytest.approx(140.0)
    watched.take(OperatorDid("changed", "the spot"), 5.0, 200.0)
    assert watched.beside_s(200.0) == pytest.approx(20.0)
    watched.take(FollowUpEnded(1), 5.0, 200.0)
    assert watched.measuring_s(5.0) == 0.0


def test_a_pause_is_nobodys_pace():
    to_go = TimeToGo()
    to_go.plan(steps(10), 0.0)
    now = measured(to_go, [2.3] * 5)
    before = to_go.measuring_s(now)
    to_go.take(Held(), now, 0.0)
    assert to_go.measuring_s(now + 600) == before
    to_go.take(StepBegan(6, "step", 1, 1, 20.0, 9.8, 0.5, 8.0), now + 600, 0.0)
    assert to_go.measuring_s(now + 600) == pytest.approx(before)


def test_a_person_who_is_waited_for_and_the_diagnosis_count():
    to_go = TimeToGo()
    to_go.plan(
        (TimedPiece("mount", 180.0), *steps(2), TimedPiece("fit", 8.0), TimedPiece("diagnosis", 60.0)), 100.0
    )
    to_go.take(SessionBegan("2026-04-01T08:00:00+00:00", "1", {}, ()), 0.0, 100.0)
    to_go.take(OperatorDid("mounted", "damped"), 0.0, 130.0)
    assert to_go.beside_s(130.0) == 68.0
    to_go.take(AcquisitionBegan(1, "sweep", 8192.0, ("base", "velocity")), 0.0, 130.0)
    to_go.take(FitStarted(1, 1), 1.0, 131.0)
    to_go.take(FitUpdated(1, 1, None, ""), 1.0, 151.0)
    # The last fit will take as long as this one.
    assert to_go.beside_s(151.0) == 80.0
    measured(to_go, [2.3, 2.3])
    to_go.take(DiagnosisStarted(1, 2), 4.6, 200.0)
    assert to_go.measuring_s(4.6) == 0.0
    # A fast beginning is no pace yet: the minute foretold shrinks and does not jump.
    to_go.computed(0.01)
    assert 57 < to_go.beside_s(200.1) < 60
    to_go.computed(0.25)
    assert to_go.beside_s(210.0) == pytest.approx(30.0)
    to_go.take(DiagnosisFound(1, 2, None, ""), 4.6, 240.0)
    assert to_go.fraction(4.6, 240.0) == 1.0
