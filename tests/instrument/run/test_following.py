"""What a run measures after its diagnosis: proposed, agreed to, done, diagnosed again, recorded."""

import pytest
from following_cases import BACKWARDS, HALF, SPOT, SPOT_MM, STEPS, a_law, grouped, run
from formula_rig import SWEEP, formula_rig
from run_at_point import RunAtPoint

from instrument.errors import RigStopped
from instrument.run.control import RunControl
from instrument.run.following import Earlier
from instrument.run.operator import SimulatedOperator
from instrument.run.replay import replay
from instrument.session.configuration import read_whole_experiment
from instrument.session.storage import SessionFile
from instrument.stream.derived import DiagnosisFound
from instrument.stream.event import from_line, to_line
from instrument.stream.raw import FollowUpDecided, FollowUpEnded, FollowUpProposed, SpotMoved

FOLLOWS = '[diagnosis]\nfollow_up = "{}"\n'
OF_FOLLOWING = (FollowUpProposed, FollowUpDecided, SpotMoved, FollowUpEnded, DiagnosisFound)


def that_follows(experiment, how="do", more=""):
    experiment.path.write_text(experiment.path.read_text() + FOLLOWS.format(how) + more)
    return read_whole_experiment(experiment.path)


def events_of(finished):
    with SessionFile(finished.session) as file:
        return [e for e in file.events(with_samples=False) if isinstance(e, OF_FOLLOWING)]


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """Steps backwards at once, then another spot."""
    folder = tmp_path_factory.mktemp("follows")
    with formula_rig(folder, sweep=SWEEP) as (_, experiment):
        return run(that_follows(experiment), folder)


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


@pytest.mark.parametrize("after", [4, 16, 20])
def test_broken_off_anywhere_it_ends_as_if_it_had_never_been_stopped(tmp_path, finished, after):
    control = RunControl()
    enough = RunAtPoint(after, lambda: control.abort("broken off"))
    with formula_rig(tmp_path) as (_, experiment):
        experiment = that_follows(experiment)
        with pytest.raises(RigStopped, match="broken off"):
            run(experiment, tmp_path, control=control, companion=enough)
        (folder,) = tmp_path.glob("*.running")
        again = run(experiment, tmp_path, resume=folder)
    places = [(p.sweep, p.segment, p.frequency_hz, p.pickup) for p in again.points]
    assert places == [(p.sweep, p.segment, p.frequency_hz, p.pickup) for p in finished.points]
    assert again.diagnosis.number == finished.diagnosis.number
    with SessionFile(again.session) as file:
        assert replay(file, fit=a_law, diagnose=grouped(BACKWARDS, SPOT)).differences == []


def test_what_a_broken_off_run_has_behind_it_is_told_by_its_events(finished):
    earlier = Earlier.of(events_of(finished))
    assert [d.number for d in earlier.found] == [1, 2, 3]
    assert sorted(earlier.proposed) == [1, 2]
    assert sorted(earlier.decided) == [(1, 0), (2, 0)]
    assert earlier.ended == {1, 2}
    assert [s.spot_mm for s in earlier.spots] == [SPOT_MM]
