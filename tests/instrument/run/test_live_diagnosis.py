"""The diagnosis of a run: when it is made, what is recorded of it, what a replay compares."""

import json
import os
import signal
import threading

import numpy as np
import pytest
from diagnosis_cases import diagnosis
from following_cases import a_law
from formula_rig import formula_rig
from run_at_point import RunAtPoint
from sessions import events_of

from fitting.effects import CATALOGUE
from instrument.cli.output import Output
from instrument.cli.print_run import print_finished, run_result
from instrument.errors import BadInput, RigStopped, StoppedByUser
from instrument.facts.damping import DampingResult, ModeFound
from instrument.files.experiment_file import DiagnosisTable, ExperimentDocument
from instrument.planning.follow_up import Possible
from instrument.results.event_words import said_of
from instrument.run.control import RunControl
from instrument.run.experiment import run_experiment
from instrument.run.live_diagnosis import ToDiagnose, able, apart, diagnose_points
from instrument.run.replay import replay
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile
from instrument.simulated_case import EFFECTS, chosen_effect
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import DampingFound, DiagnosisFound, FitUpdated
from instrument.stream.raw import DiagnosisStarted, SessionEnded


def no_law(number, last_step, points, damping, specimen):
    return FitUpdated(number, last_step, None, "no law")


def times(asked):
    """Says what it was given."""
    points = sum(p.step <= asked.last_step for p in asked.points)
    given = {"times_s": list(asked.times_s), "points": points}
    return DiagnosisFound(asked.number, asked.last_step, None, json.dumps(given))


def told(found):
    """What it was given."""
    return json.loads(found.message)


def whole(asked):
    return DiagnosisFound(asked.number, asked.last_step, diagnosis())


def refused(_):
    raise AssertionError("called without a law")


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    with formula_rig(folder) as (_, experiment):
        return run_experiment(experiment, folder, ("sweep",), fit=a_law, diagnose=times)


def test_it_is_made_once_of_the_whole_sweep_and_recorded_before_the_end(finished):
    events = [e for e in events_of(finished.session) if isinstance(e, DiagnosisStarted | DiagnosisFound)]
    assert [type(e) for e in events] == [DiagnosisStarted, DiagnosisFound]
    assert events[1] == finished.diagnosis
    assert events[1].last_step == events[0].last_step == max(p.step for p in finished.points)
    assert told(events[1])["points"] == len(finished.points)
    assert isinstance(events_of(finished.session)[-1], SessionEnded)


def test_points_come_with_times_of_the_sample_counter(finished):
    t = told(finished.diagnosis)["times_s"]
    samples = [p.sample for p in finished.points]
    assert [b - t[0] for b in t] == pytest.approx([(n - samples[0]) / 8192.0 for n in samples], abs=1e-9)


def test_a_replay_computes_it_again_and_compares(finished):
    with SessionFile(finished.session) as file:
        again = replay(file, fit=a_law, diagnose=times)
    assert again.differences == []
    assert again.diagnosis == finished.diagnosis


def test_a_replay_notices_another_diagnosis(finished):
    def another(asked):
        found = times(asked)
        return DiagnosisFound(found.number, found.last_step, None, "another")

    with SessionFile(finished.session) as file:
        again = replay(file, fit=a_law, diagnose=another)
    assert len(again.differences) == 1
    assert "DiagnosisFound" in again.differences[0]


def test_a_replay_tells_other_words_from_another_diagnosis(tmp_path):
    def saying(words):
        return lambda asked: DiagnosisFound(asked.number, asked.last_step, None, words)

    with formula_rig(tmp_path) as (_, experiment):
        recorded = saying("too few points: 2")
        finished = run_experiment(experiment, tmp_path, ("sweep",), fit=a_law, diagnose=recorded)
    with SessionFile(finished.session) as file:
        again = replay(file, fit=a_law, diagnose=saying("2 points are too few"))
        other = replay(file, fit=a_law, diagnose=saying("3 points are too few"))
    assert again.equal
    assert again.words == [
        "DiagnosisFound.message: too few points: 2 recorded, 2 points are too few computed"
    ]
    assert not other.equal
    assert other.words == []


def test_without_a_law_nothing_is_asked(tmp_path):
    with formula_rig(tmp_path) as (_, experiment):
        finished = run_experiment(experiment, tmp_path, ("sweep",), fit=no_law, diagnose=refused)
    assert finished.diagnosis is None
    assert not any(isinstance(e, DiagnosisStarted) for e in events_of(finished.session))


def test_a_sweep_that_is_stopped_is_not_diagnosed_and_its_resumed_whole_is(tmp_path):
    control = RunControl()
    enough = RunAtPoint(6, lambda: control.abort("enough"))
    with formula_rig(tmp_path) as (_, experiment):
        with pytest.raises(RigStopped, match="enough"):
            run_experiment(
                experiment,
                tmp_path,
                ("sweep",),
                control=control,
                companion=enough,
                fit=a_law,
                diagnose=refused,
            )
        (folder,) = tmp_path.glob("*.running")
        finished = run_experiment(experiment, tmp_path, ("sweep",), resume=folder, fit=a_law, diagnose=times)
    t = told(finished.diagnosis)["times_s"]
    assert len(t) == len(finished.points) == 15
    assert t == sorted(t)
    with SessionFile(finished.session) as file:
        contents = contents_of(file, with_hits=False)
    # The same clock, whether it followed the run or its recording.
    assert t == [p.time_s for p in contents.points]
    with SessionFile(finished.session) as file:
        assert replay(file, fit=a_law, diagnose=times).differences == []


def test_why_none_was_possible_is_the_result(finished):
    """A third of critical damping on a bare plate: something else was hit."""
    with SessionFile(finished.session) as file:
        specimen = file.configuration.the_specimen()
    damping = DampingFound(DampingResult(modes=[ModeFound(frequency_hz=17.7, damping_ratio=0.33)]))
    points = list(finished.points)
    times_s = [0.0] * len(points)
    asked = ToDiagnose(1, points[-1].step, points, times_s, damping, (), specimen, Possible())
    found = diagnose_points(asked)
    assert found.result is None
    assert "damping_ratio" in found.message
    assert "\n" not in found.message


def test_points_at_one_frequency_are_said_to_be_why_there_is_none(finished):
    with SessionFile(finished.session) as file:
        specimen = file.configuration.the_specimen()
    points = list(finished.points)[:1]
    found = diagnose_points(ToDiagnose(1, points[0].step, points, [0.0], None, (), specimen, Possible()))
    assert found.result is None
    assert found.message == "all points are at 95 Hz, expected two frequencies or more"


def test_a_run_is_offered_what_it_still_allows_and_a_person_what_anybody_may():
    settings = SweepSettings()
    table = DiagnosisTable(follow_up="do", follow_up_at_most=2, follow_up_most_s=500.0)
    plain = ExperimentDocument(specimen="s.toml", rig="r.toml")
    experiment = plain.model_copy(update={"diagnosis": table})
    possible = [able(experiment, settings, number) for number in (1, 2, 3)]
    assert [p.measurements for p in possible] == [2, 1, 2]
    assert [p.most_s for p in possible] == [500.0, 500.0, np.inf]
    assert able(plain, settings, 2) == Possible(settings)


def test_a_failure_of_the_thread_is_raised_where_it_is_waited_for():
    def fail():
        raise RuntimeError("a fault")

    with pytest.raises(RuntimeError, match="a fault"):
        apart(fail)


def test_ctrl_c_ends_the_processes_that_work_for_it(monkeypatch):
    over, ended = threading.Event(), []
    monkeypatch.setattr("instrument.run.live_diagnosis.end_all", lambda: ended.append(1))

    def endless():
        os.kill(os.getpid(), signal.SIGINT)
        over.wait(60)

    try:
        with pytest.raises(KeyboardInterrupt):
            apart(endless)
    finally:
        over.set()
    assert ended == [1]


def test_ctrl_c_does_not_wait_for_it_and_keeps_the_session(tmp_path):
    over = threading.Event()

    def endless(asked):
        os.kill(os.getpid(), signal.SIGINT)
        over.wait(60)
        return times(asked)

    with formula_rig(tmp_path) as (_, experiment):
        try:
            with pytest.raises(StoppedByUser, match="15 steps kept"):
                run_experiment(experiment, tmp_path, ("sweep",), fit=a_law, diagnose=endless)
            assert not over.is_set()
        finally:
            over.set()
    (session,) = tmp_path.glob("*.h5")
    assert isinstance(events_of(session)[-1], SessionEnded)
    assert not any(isinstance(e, DiagnosisFound) for e in events_of(session))


def test_a_person_sees_the_verdict_as_it_comes_and_the_reasons_at_the_end(tmp_path, capsys):
    with formula_rig(tmp_path) as (_, experiment):
        finished = run_experiment(experiment, tmp_path, ("sweep",), fit=a_law, diagnose=whole)
    assert said_of(DiagnosisStarted(1, 9)) == "tracing what the fit cannot explain"
    assert said_of(finished.diagnosis).startswith("verdict: effect")
    assert said_of(DiagnosisFound(1, 9, None, "too few")) == "no diagnosis: too few"
    json.dumps(run_result(finished).as_json(), allow_nan=False)
    assert run_result(finished).diagnose.verdict == "effect"
    print_finished(Output(None), finished)
    said = capsys.readouterr().out
    assert "a mass of 8 g" in said
    assert "what the fit leaves" in said


def test_a_demonstration_hides_what_is_asked_for():
    assert chosen_effect("none", 1) is None
    assert chosen_effect("spot_offset", 1) == "spot_offset"
    assert {chosen_effect("random", seed) for seed in range(300)} == set(EFFECTS)
    assert chosen_effect("random", 7) == chosen_effect("random", 7)
    with pytest.raises(BadInput, match="'ghosts', expected none, random or one of added_mass"):
        chosen_effect("ghosts", 1)


@pytest.mark.parametrize("name", EFFECTS)
def test_what_a_demonstration_hides_can_be_found_by_name(name):
    assert name in CATALOGUE
