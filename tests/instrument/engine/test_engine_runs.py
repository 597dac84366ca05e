"""Runs in the engine over real wires: the same sessions as without it, and the client's word counts."""

import os
import signal
import subprocess
import sys
from dataclasses import replace

import pytest
from engine_cases import (
    LONG,
    done,
    drive_v,
    ended,
    engine_of,
    engine_rig,
    follow,
    is_silent,
    told,
    wait_until,
    without_samples,
)
from formula_rig import SWEEP
from quick_engine import QUICK_ENGINE, no_fit
from sessions import events_of, points_of

from instrument.engine import Engine, Order
from instrument.engine.client import ENGINE
from instrument.engine.messages import (
    Happened,
    OperatorAsked,
    Progressed,
    RigClosed,
    RigOpened,
    StopPathChanged,
)
from instrument.engine.wire import encode, read
from instrument.run.experiment import run_experiment
from instrument.session.configuration import read_whole_experiment
from instrument.simulated_case import write_case
from instrument.stream.derived import DampingFound, FitUpdated, HitJudged, HitRevised, PointMeasured
from instrument.stream.raw import (
    BlockAcquired,
    FitStarted,
    Held,
    OperatorDid,
    SessionBegan,
    SessionEnded,
)

pytestmark = pytest.mark.usefixtures("warm")

POINTS = 49
SWEEP_OF_POINTS = SWEEP.replace("points = 6", "points = 40")
"""Long beside what a word to the engine takes, on a busy machine too."""


def comparable(events):
    """Without what the clock on the wall decides: the date, and where the fit's thread comes in."""
    kept = [e for e in events if not isinstance(e, FitStarted | FitUpdated)]
    return [replace(e, utc="") if isinstance(e, SessionBegan) else e for e in kept]


@pytest.fixture(scope="module")
def run_twice(tmp_path_factory):
    """The same experiment by a direct call, then in the engine: both sessions, and what the client heard."""
    direct, apart = (tmp_path_factory.mktemp(name) for name in ("direct", "apart"))
    with engine_rig(direct, hammer=True) as (_, experiment):
        finished = run_experiment(read_whole_experiment(experiment), direct, ("hammer", "sweep"), fit=no_fit)
    with engine_rig(apart, hammer=True) as (_, experiment), engine_of(Order(experiment, apart)) as engine:
        messages = follow(engine)
    return finished.session, ended(messages), messages


def test_a_run_in_the_engine_gives_the_session_of_a_direct_call(run_twice):
    session, end, _ = run_twice
    assert (end.why, end.message, end.folder) == ("done", "", None)
    direct, apart = (events_of(path, with_samples=True) for path in (session, end.session))
    assert comparable(apart) == comparable(direct)
    blocks = [[e.counts for e in events if isinstance(e, BlockAcquired)] for events in (direct, apart)]
    assert all((a == b).all() for a, b in zip(*blocks, strict=True))


def test_the_client_is_told_every_event_of_the_session_in_order(run_twice):
    _, end, messages = run_twice
    assert without_samples(told(messages)) == without_samples(events_of(end.session))


def test_blocks_come_with_their_samples(run_twice):
    _, end, messages = run_twice
    there = [e for e in events_of(end.session, with_samples=True) if isinstance(e, BlockAcquired)]
    came = [e for e in told(messages) if isinstance(e, BlockAcquired)]
    assert len(came) == len(there)
    assert all((a.counts == b.counts).all() for a, b in zip(came, there, strict=True))


def test_the_client_hears_of_long_work_and_of_the_rig(run_twice):
    _, _, messages = run_twice
    assert any(isinstance(m, Progressed) and m.what == "forecasting the sweep" and m.ended for m in messages)
    assert sum(isinstance(m, RigOpened | RigClosed) for m in messages) == 2
    assert StopPathChanged(True) in messages


def test_a_hit_is_rejected_and_another_one_taken(tmp_path):
    with (
        engine_rig(tmp_path, hammer=True) as (_, experiment),
        engine_of(Order(experiment, tmp_path, ("hammer",), ask_content=True)) as engine,
    ):
        asked = []

        def react(message):
            if isinstance(message, OperatorAsked) and message.what == "content":
                asked.append(message.good)
                engine.reject(1) if len(asked) == 1 else engine.content()

        messages = follow(engine, react)
    events = told(messages)
    done(messages)
    assert asked == [2, 2]
    assert OperatorDid("rejected", "", 1) in events
    assert HitRevised(1, accepted=False) in events
    assert sum(isinstance(e, HitJudged) for e in events) == 3
    assert without_samples(events_of(ended(messages).session)) == without_samples(events)


def test_a_rejected_hit_may_be_undone(tmp_path):
    with (
        engine_rig(tmp_path, hammer=True) as (_, experiment),
        engine_of(Order(experiment, tmp_path, ("hammer",), ask_content=True)) as engine,
    ):

        def react(message):
            if isinstance(message, OperatorAsked) and message.what == "content":
                engine.reject(2)
                engine.undo(2)
            if isinstance(message, Happened) and message.event == HitRevised(2, accepted=True):
                engine.content()

        messages = follow(engine, react)
    revised = [e.accepted for e in told(messages) if isinstance(e, HitRevised) and e.hit == 2]
    assert revised[:2] == [False, True]
    done(messages)


def test_a_person_is_asked_to_mount_and_aim_and_answers(tmp_path):
    with (
        engine_rig(tmp_path, person=True) as (_, experiment),
        engine_of(Order(experiment, tmp_path, ("sweep",))) as engine,
    ):
        answers = {"mount": engine.mounted, "aim": engine.aimed}
        messages = follow(engine, lambda m: answers[m.what]() if isinstance(m, OperatorAsked) else None)
    assert [(m.what, m.detail) for m in messages if isinstance(m, OperatorAsked)] == [
        ("mount", "damped"),
        ("aim", "pickup"),
    ]
    done(messages)


def test_a_run_that_waits_for_its_operator_can_be_aborted(tmp_path):
    with (
        engine_rig(tmp_path, person=True) as (_, experiment),
        engine_of(Order(experiment, tmp_path, ("sweep",))) as engine,
    ):
        end = ended(follow(engine, lambda m: engine.abort() if isinstance(m, OperatorAsked) else None))
    assert (end.why, end.message, end.session) == ("stopped by the user", "nothing was measured", None)


def test_a_hold_silences_and_resuming_goes_on(tmp_path):
    with (
        engine_rig(tmp_path, sweep=SWEEP_OF_POINTS) as (rig, experiment),
        engine_of(Order(experiment, tmp_path)) as engine,
    ):
        points, held = [], []

        def react(message):
            event = message.event if isinstance(message, Happened) else None
            if isinstance(event, PointMeasured):
                points.append(event)
                if len(points) == 3:
                    engine.hold()
            elif isinstance(event, Held):
                wait_until(lambda: is_silent(rig), 5)
                held.append(drive_v(rig))
                engine.resume()

        end = ended(follow(engine, react))
    assert held == [0.0]
    assert end.why == "done"
    assert len(points_of(end.session)) == POINTS


def test_an_abort_keeps_what_is_complete_and_a_resume_tells_it_again(tmp_path):
    with engine_rig(tmp_path, sweep=SWEEP_OF_POINTS) as (rig, experiment):
        with engine_of(Order(experiment, tmp_path)) as engine:
            seen = []

            def react(message):
                if isinstance(message, Happened) and isinstance(message.event, PointMeasured):
                    seen.append(message.event)
                    if len(seen) == 4:
                        engine.abort()

            messages = follow(engine, react)
        end = ended(messages)
        assert is_silent(rig)
        assert end.why == "stopped by the user"
        assert f"kept in {end.session}" in end.message
        assert told(messages)[-1] == SessionEnded("stopped by the user", "")
        first = points_of(end.session)
        assert 4 <= len(first) < POINTS
        with engine_of(Order(experiment, tmp_path, resume=end.folder)) as engine:
            again = follow(engine)
    assert [e for e in told(again) if isinstance(e, PointMeasured)][: len(first)] == first
    assert len(points_of(ended(again).session)) == POINTS
    assert without_samples(told(again)) == without_samples(events_of(ended(again).session))


def test_a_bad_experiment_is_the_end_in_one_line(tmp_path):
    experiment = tmp_path / "experiment.toml"
    experiment.write_text("\0")
    with engine_of(Order(experiment, tmp_path), ENGINE) as engine:
        end = ended(follow(engine))
    assert end.why == "bad input"
    assert "experiment.toml" in end.message
    assert "\n" not in end.message


def test_an_engine_that_is_killed_is_said_to_have_died_and_the_client_silences_the_shaker(tmp_path):
    with (
        engine_rig(tmp_path, sweep=LONG) as (rig, experiment),
        engine_of(Order(experiment, tmp_path)) as engine,
    ):
        wait_until(lambda: drive_v(rig) > 0)
        wait_until(lambda: any(isinstance(e, PointMeasured) for e in told(engine.poll())))
        os.kill(engine.pid, signal.SIGKILL)
        wait_until(lambda: is_silent(rig), 1.0)
        end = ended(follow(engine))
    assert end.why == "died"
    assert "; the shaker is silent; what is complete is in " in end.message
    assert f"viscorig recover {end.folder}" in end.message


CLIENT = """
import sys, time
from pathlib import Path
from instrument.engine import Engine, Order
from instrument.engine.client import ENGINE
engine = Engine.start(Order(Path(sys.argv[1]), Path(sys.argv[2])), sys.argv[3:])
print(engine.pid, flush=True)
while engine.running:
    engine.poll()
    time.sleep(0.01)
"""


def test_when_the_client_dies_the_shaker_is_silent_and_the_session_kept(tmp_path):
    with engine_rig(tmp_path, sweep=LONG) as (rig, experiment):
        command = [sys.executable, "-c", CLIENT, str(experiment), str(tmp_path), *QUICK_ENGINE]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as client:
            engine = int(client.stdout.readline())
            wait_until(lambda: sum(1 for _ in tmp_path.glob("*.running/part-*.h5")) >= 5)
            client.kill()
        wait_until(lambda: is_silent(rig), 1.0)
        wait_until(lambda: not _exists(engine))
    (session,) = tmp_path.glob("*.h5")
    end = events_of(session)[-1]
    assert end == SessionEnded("stopped safely", "the program that watched the run has ended")
    assert len(points_of(session)) >= 3


def test_a_client_that_reads_nothing_holds_up_no_run(tmp_path):
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with (
        engine_rig(tmp_path) as (_, experiment),
        subprocess.Popen(QUICK_ENGINE, **pipes) as engine,
    ):
        engine.stdin.write(encode(Order(experiment, tmp_path, ("sweep",))))
        engine.stdin.flush()
        wait_until(lambda: bool([*tmp_path.glob("*.h5")]) and not [*tmp_path.glob("*.running")])
        messages = [*iter(lambda: read(engine.stdout), None)]
    assert len(points_of(done(messages).session)) == 15
    assert without_samples(told(messages)) == without_samples(events_of(ended(messages).session))


def _exists(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    # A child of nobody may stay as a zombie where process 1 collects none.
    with open(f"/proc/{pid}/stat") as file:
        return file.read().rpartition(")")[2].split()[0] != "Z"


def test_an_engine_stands_up_a_simulated_rig_itself(tmp_path, cold):
    order = Order(write_case(tmp_path), tmp_path, ("hammer",), ask_content=True)
    with engine_of(order, ENGINE) as engine:
        messages = follow(
            engine,
            lambda m: engine.content() if isinstance(m, OperatorAsked) and m.what == "content" else None,
        )
    assert any(isinstance(e, DampingFound) for e in events_of(done(messages).session))


def test_what_the_engine_is_told_when_it_is_over_is_forgotten(tmp_path):
    engine = Engine.start(Order(tmp_path / "absent.toml", tmp_path))
    end = ended(follow(engine))
    assert (end.why, end.message.count("\n")) == ("bad input", 0)
    assert "absent.toml" in end.message
    for say in (engine.hold, engine.resume, engine.abort, engine.mounted, engine.content, engine.reject):
        say()
    assert not engine.stop().silent
    engine.close()
    engine.close()
    assert engine.poll() == []
