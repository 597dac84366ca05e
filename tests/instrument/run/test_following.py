"""What a run measures after its diagnosis: proposed, agreed to, done, diagnosed again, recorded."""

import shutil
import signal
import subprocess
import sys

import following_cases
import pytest
import sessions
from following_cases import (
    BACKWARDS,
    CLAMPING,
    HALF,
    SEGMENTS,
    SPOT,
    SPOT_MM,
    SPOT_OF_THE_CASE,
    STEPS,
    a_law,
    grouped,
    really,
    run,
)
from formula_rig import SWEEP, formula_rig
from run_at_point import RunAtPoint

from instrument.errors import RigStopped
from instrument.run.companion import Companion
from instrument.run.control import RunControl
from instrument.run.experiment import run_experiment
from instrument.run.following import Earlier
from instrument.run.operator import SimulatedOperator
from instrument.run.replay import replay
from instrument.session.configuration import read_whole_experiment
from instrument.session.storage import SessionFile
from instrument.simulated_case import write_case
from instrument.stream.derived import DiagnosisFound, PointMeasured
from instrument.stream.event import from_line, to_line
from instrument.stream.raw import (
    FollowUpDecided,
    FollowUpEnded,
    FollowUpProposed,
    OperatorDid,
    SpotMoved,
)

FOLLOWS = '[diagnosis]\nfollow_up = "{}"\n'
KILLS = (4, 17, 20)
"""Points: in the sweep, in what the rig does alone, and after hands have moved the laser."""
OF_FOLLOWING = (FollowUpProposed, FollowUpDecided, SpotMoved, FollowUpEnded, DiagnosisFound)


def that_follows(experiment, how="do", more=""):
    experiment.path.write_text(experiment.path.read_text() + FOLLOWS.format(how) + more)
    return read_whole_experiment(experiment.path)


def events_of(finished):
    return [e for e in sessions.events_of(finished.session) if isinstance(e, OF_FOLLOWING)]


class KilledAt(Companion):
    """What a kill at certain points would have left: a copy made once they are on the disk.

    By the thread that seals, between two seals: what the run has measured by then may be ahead of it.
    """

    def __init__(self, folder, points):
        self._folder, self._points, self._count = folder, points, 0

    def recording(self, folder, session):
        self._running = folder

    def watch(self, events):
        before, self._count = self._count, self._count + sum(isinstance(e, PointMeasured) for e in events)
        for point in self._points:
            if before < point <= self._count:
                copy = self._folder / str(point) / self._running.name
                shutil.copytree(self._running, copy, ignore=shutil.ignore_patterns("lock"))


def run_to_be_killed(points, experiment, folder, *offers):
    killed = KilledAt(folder, points)
    return run(experiment, folder, *offers, companion=killed, watch=killed.watch)


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    """Its folder, and an experiment that follows its diagnosis up."""
    folder = tmp_path_factory.mktemp("follows")
    with formula_rig(folder, sweep=SWEEP) as (_, experiment):
        yield folder, that_follows(experiment)


@pytest.fixture(scope="module")
def finished(rig):
    """Steps backwards at once, then another spot."""
    folder, experiment = rig
    return run_to_be_killed(KILLS, experiment, folder)


def test_a_group_is_followed_by_what_tells_it_apart_until_one_explanation_is_left(finished):
    assert [type(e) for e in events_of(finished)] == [
        *(DiagnosisFound, FollowUpProposed, FollowUpDecided, FollowUpEnded),
        *(DiagnosisFound, FollowUpProposed, FollowUpDecided, SpotMoved, FollowUpEnded),
        DiagnosisFound,
    ]
    assert finished.diagnosis == events_of(finished)[-1]


def test_what_the_rig_can_do_alone_is_the_experiments_word_hands_a_persons(finished):
    decided = [e for e in events_of(finished) if isinstance(e, FollowUpDecided)]
    assert [(e.number, e.agreed, e.by) for e in decided] == [(1, True, "experiment"), (2, True, "person")]


def test_its_points_are_a_pass_of_their_own_and_know_their_spot(finished):
    further = [p for p in finished.points if p.sweep > 1]
    assert [(p.sweep, p.frequency_hz, p.pickup) for p in further] == [
        *((2, f, 0) for f in STEPS["frequencies_hz"]),
        *((3, f, 1) for f in STEPS["frequencies_hz"]),
    ]
    assert {p.spot_mm for p in further if p.pickup} == {SPOT_MM}


def test_a_replay_gives_the_same_to_the_bit(finished):
    with SessionFile(finished.session) as file:
        assert replay(file, fit=a_law, diagnose=grouped(BACKWARDS, SPOT)).differences == []


def test_each_diagnosis_knows_what_was_measured_before_it_in_a_replay_too(rig, tmp_path):
    told = []

    def knowing(asked):
        told.append([one.kind for one in asked.possible.done])
        return grouped(BACKWARDS, SPOT)(asked)

    _, experiment = rig
    finished = run_experiment(experiment, tmp_path, ("sweep",), fit=a_law, diagnose=knowing)
    with SessionFile(finished.session) as file:
        assert replay(file, fit=a_law, diagnose=knowing).differences == []
    assert told == 2 * [[], ["reversed"], ["reversed", "spot"]]


def test_a_proposal_comes_back_from_its_line(finished):
    proposed = next(e for e in events_of(finished) if isinstance(e, FollowUpProposed))
    assert from_line(to_line(proposed)) == proposed
    assert proposed.offers[0].between == ("spot_offset", "gain_error")


def test_nothing_follows_where_the_experiment_does_not_ask_for_it(tmp_path):
    with formula_rig(tmp_path) as (_, experiment):
        found = run(experiment, tmp_path)
    assert [type(e) for e in events_of(found)] == [DiagnosisFound]
    assert {p.sweep for p in found.points} == {1}


def test_another_level_is_driven(tmp_path):
    with formula_rig(tmp_path) as (_, experiment):
        found = run(that_follows(experiment), tmp_path, (HALF,))
    levels = [p.level_m_s2 for p in found.points if p.sweep == 2]
    assert levels == pytest.approx([9.81 / 2] * 3, rel=1e-3)


@pytest.mark.parametrize(("how", "asked"), [("offer", ["reversed", "spot"]), ("do", ["spot"])])
def test_a_person_is_asked_as_the_experiment_says_and_may_decline(tmp_path, monkeypatch, how, asked):
    heard = []

    def declines(self, offer):
        heard.append(offer.kind)
        return offer.kind != "spot"

    monkeypatch.setattr(SimulatedOperator, "agree", declines)
    with formula_rig(tmp_path) as (_, experiment):
        found = run(that_follows(experiment, how), tmp_path)
    assert heard == asked
    assert {p.sweep for p in found.points} == {1, 2}
    assert events_of(found)[-1] == FollowUpDecided(2, 0, False, "person")
    assert found.diagnosis.number == 2


def test_at_most_so_many_are_made(tmp_path):
    with formula_rig(tmp_path) as (_, experiment):
        experiment = that_follows(experiment, more="follow_up_at_most = 1\n")
        found = run(experiment, tmp_path)
    assert {p.sweep for p in found.points} == {1, 2}
    assert isinstance(events_of(found)[-1], DiagnosisFound)


@pytest.mark.parametrize("after", KILLS)
def test_killed_anywhere_it_ends_as_if_it_had_never_been(rig, finished, after):
    folder, experiment = rig
    (running,) = (folder / str(after)).glob("*.running")
    again = run(experiment, running.parent, resume=running)
    is_as_if_never_stopped(again, finished)


def test_broken_off_it_ends_as_if_it_had_never_been_stopped(tmp_path, finished):
    control = RunControl()
    enough = RunAtPoint(16, lambda: control.abort("broken off"))
    with formula_rig(tmp_path) as (_, experiment):
        experiment = that_follows(experiment)
        with pytest.raises(RigStopped, match="broken off"):
            run(experiment, tmp_path, control=control, companion=enough)
        (folder,) = tmp_path.glob("*.running")
        again = run(experiment, tmp_path, resume=folder)
    is_as_if_never_stopped(again, finished)


def is_as_if_never_stopped(again, finished):
    """The same steps, proposals and decisions, and the same once more from the recording."""
    places = [(p.sweep, p.segment, p.frequency_hz, p.pickup) for p in again.points]
    assert places == [(p.sweep, p.segment, p.frequency_hz, p.pickup) for p in finished.points]
    assert again.diagnosis.number == finished.diagnosis.number
    assert decisions_of(again) == decisions_of(finished)
    with SessionFile(again.session) as file:
        assert replay(file, fit=a_law, diagnose=grouped(BACKWARDS, SPOT)).differences == []


def decisions_of(run):
    return [e for e in events_of(run) if isinstance(e, FollowUpProposed | FollowUpDecided)]


@pytest.mark.long
def test_a_process_killed_in_a_measurement_after_its_diagnosis_gives_the_same_verdicts(tmp_path):
    experiment = write_case(tmp_path)
    head = 'specimen = "specimen.toml"\nrig = "rig.toml"\n[sweep]\nsentinel = false\ncalibration = false\n'
    experiment.write_text(head + SEGMENTS + FOLLOWS.format("do"))
    # Few elements: what is asked is whether it is the same twice.
    specimen = tmp_path / "specimen.toml"
    specimen.write_text(specimen.read_text() + "\n[mesh]\nelements_x = 10\nelements_y = 8\n")
    program = [sys.executable, following_cases.__file__, str(experiment), str(tmp_path)]
    # The second of three steps that follow eighteen; then to the end.
    assert subprocess.run([*program, "20"], check=False).returncode == -signal.SIGKILL
    (running,) = tmp_path.glob("*.running")
    subprocess.run([*program, "0", str(running)], check=True)
    with SessionFile(next(tmp_path.glob("*.h5"))) as file:
        kept = [e for e in file.events(with_samples=False) if isinstance(e, OF_FOLLOWING)]
        again = replay(file, diagnose=really(SPOT_OF_THE_CASE))
    assert again.differences == []
    before, after = (e.result for e in kept if isinstance(e, DiagnosisFound))
    assert (len(before.points), len(after.points)) == (18, 21)
    assert again.diagnosis.result.verdict == after.verdict
    assert [(e.number, e.agreed) for e in kept if isinstance(e, FollowUpDecided)] == [(1, True)]
    assert {p.pickup for p in again.points} == {0, 1}


@pytest.fixture(scope="module")
def clamped(tmp_path_factory):
    """Clamped anew; killed on the way, and begun once more."""
    folder = tmp_path_factory.mktemp("clamped")
    with formula_rig(folder, sweep=SWEEP) as (_, experiment):
        experiment = that_follows(experiment)
        whole = run_to_be_killed((17, 20), experiment, folder, (CLAMPING, BACKWARDS))
        again = [
            run(experiment, running.parent, (CLAMPING, BACKWARDS), resume=running)
            for running in sorted(folder.glob("*/*.running"))
        ]
    return whole, again


def test_what_is_read_after_the_plate_was_clamped_anew_knows_it(clamped):
    whole, _ = clamped
    assert [(p.sweep, p.mounting) for p in whole.points if p.sweep > 1] == [(2, 1)] * 3 + [(3, 1)] * 3
    with SessionFile(whole.session) as file:
        assert replay(file, fit=a_law, diagnose=grouped(CLAMPING, BACKWARDS)).differences == []


def test_a_plate_clamped_anew_may_be_read_at_another_spot_at_once(tmp_path):
    beside = {**CLAMPING, "spot_mm": SPOT_MM}
    with formula_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        found = run(that_follows(experiment), tmp_path, (beside, BACKWARDS))
    # The next one is read where the laser was at first, on the plate as it is clamped now.
    assert [(p.mounting, p.pickup) for p in found.points if p.sweep > 1] == [(1, 1)] * 3 + [(1, 0)] * 3
    with SessionFile(found.session) as file:
        done = [e.what for e in file.events(with_samples=False) if isinstance(e, OperatorDid)]
        assert replay(file, fit=a_law, diagnose=grouped(beside, BACKWARDS)).differences == []
    assert done[-3:] == ["changed", "changed", "aimed"]


def test_a_clamping_that_was_broken_off_is_another_one_and_is_begun_again(clamped):
    _, (in_it, after_it) = clamped
    for again, sweep in ((in_it, 2), (after_it, 3)):
        # All its steps are of the last clamping; what was sealed of the one before stays beside them.
        steps = [p for p in again.points if p.sweep == sweep]
        last = max(p.mounting for p in steps)
        assert [p.frequency_hz for p in steps if p.mounting == last] == STEPS["frequencies_hz"]
        assert {p.mounting for p in again.points if p.sweep == 3} <= {last - 1, last}
    # Nobody knows what happened to the plate meanwhile: it is clamped once more before anything follows.
    assert last > max(p.mounting for p in after_it.points if p.sweep == 2)
    for again in (in_it, after_it):
        with SessionFile(again.session) as file:
            assert replay(file, fit=a_law, diagnose=grouped(CLAMPING, BACKWARDS)).differences == []


def test_what_a_broken_off_run_has_behind_it_is_told_by_its_events(finished):
    earlier = Earlier.of(events_of(finished))
    assert [d.number for d in earlier.found] == [1, 2, 3]
    assert sorted(earlier.proposed) == [1, 2]
    assert sorted(earlier.decided) == [(1, 0), (2, 0)]
    assert earlier.ended == {1, 2}
    assert [s.spot_mm for s in earlier.spots] == [SPOT_MM]
