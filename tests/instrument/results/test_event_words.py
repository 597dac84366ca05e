"""What the log and the console say of an event: one line, or nothing."""

import pytest
from sessions import block, point

from instrument.results.event_words import Saying, said_of
from instrument.stream.derived import DiagnosisFound, FitUpdated, HitJudged, SentinelCompared, StepsChosen
from instrument.stream.raw import DiagnosisStarted, PlanOverruled, SoakEnded, StepDeclined


def chosen(*frequencies_hz, ended=False):
    segments = (1,) * len(frequencies_hz)
    return StepsChosen(1, 9, frequencies_hz, segments, "law", ended, "2 % everywhere", 2.0, 1.0)


@pytest.mark.parametrize(
    ("event", "line"),
    [
        (HitJudged(3, 0, 10, 87.4, True, ""), "hit 3: 87 N, good"),
        (HitJudged(3, 0, 10, 87.4, False, "a double hit"), "hit 3: 87 N, left out: a double hit"),
        (
            SentinelCompared(5, 100.0, -0.25, 0.1),
            "sentinel 100 Hz: -0.250 %, +0.100 deg since the first time",
        ),
        (SoakEnded(61.2), "soaked: at the set point after 61 s"),
        (point(1, 20.0, remarks=("weak light", "hum")), "20 Hz: weak light; hum"),
        (FitUpdated(2, 9, None, "too few points"), "fit 2: not yet: too few points"),
        (DiagnosisStarted(1, 9), "tracing what the fit cannot explain"),
        (DiagnosisFound(1, 9, None, "too few"), "no diagnosis: too few"),
        (StepDeclined(4, 1, 1, 97.5), "97.5 Hz: left out on a person's word"),
        (PlanOverruled(1, "add", 98.0), "a person adds 98 Hz"),
        (PlanOverruled(1, "end"), "a person ends the sweep"),
    ],
)
def test_an_event_that_a_person_wants_to_know_of_is_one_line(event, line):
    assert said_of(event) == line


@pytest.mark.parametrize("event", [block(), point(1, 20.0)])
def test_what_speaks_for_itself_is_not_said(event):
    assert said_of(event) is None


def test_a_choice_of_steps_says_why_and_which_where_it_is_one():
    assert said_of(chosen(97.5)) == "next 97.5 Hz: 2 % everywhere"
    assert said_of(chosen(97.5, 98.0)) == "2 % everywhere"
    assert said_of(chosen(ended=True)) == "the sweep ends: 2 % everywhere"


def test_a_range_that_is_not_calibrated_is_said_once_and_the_next_one_too():
    saying, fine, coarse = Saying(), "range fine is not calibrated", "range coarse is not calibrated"
    remarks = [(fine,), (fine, "hum"), (fine,), (coarse,), (fine, coarse)]
    lines = [saying.line(point(number, 20.0 + number, remarks=r)) for number, r in enumerate(remarks)]
    assert lines == [f"20 Hz: {fine}", "21 Hz: hum", None, f"23 Hz: {coarse}", None]
    assert saying.line(SoakEnded(61.2)) == "soaked: at the set point after 61 s"


def test_what_is_of_one_point_is_said_of_each():
    saying = Saying()
    assert [saying.line(point(n, 20.0, remarks=("hum",))) for n in (1, 2)] == ["20 Hz: hum"] * 2
