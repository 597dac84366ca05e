"""The engine's side of a run: what the client hears, and what its messages do."""

import io
import logging
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace

import pytest

from drivers.errors import DriverError
from instrument.engine import host as hosting
from instrument.engine import process
from instrument.engine.host import Host, LogToClient
from instrument.engine.mailbox import Mailbox
from instrument.engine.messages import (
    AbortWanted,
    DeclineWanted,
    Happened,
    HoldWanted,
    Order,
    OverruleWanted,
    Planned,
    Progressed,
    RecordingBegan,
    ResumeWanted,
    RigClosed,
    RigOpened,
    Silenced,
    StopWanted,
)
from instrument.engine.wire import encode
from instrument.errors import RigStopped, ShakerNotSilent
from instrument.stream.raw import Held


class Shaker:
    """At rest once it is told to, unless it does not answer."""

    def __init__(self, *, answers=True):
        self.stops, self.answers = 0, answers

    def stop(self):
        if not self.answers:
            raise DriverError("shaker: no answer")
        self.stops += 1

    def status(self):
        return SimpleNamespace(drive_v=0.0, running=False)


class Interrupted:
    """In the place of what breaks into the main thread."""

    def __init__(self):
        self.asked = []

    def ask(self, error):
        self.asked.append(error)


@pytest.fixture
def host():
    made = Host(ask_content=False)
    made.interruption = Interrupted()
    return made


@pytest.fixture
def exits(monkeypatch):
    """How the process would have been ended, in the place of ending it."""
    found = []
    monkeypatch.setattr(hosting, "sleep", lambda s: None)
    monkeypatch.setattr(hosting.os, "_exit", found.append)
    return found


def heard(host):
    return host.mailbox.drain()


def listen(host, *messages, tail=b""):
    host.listen(io.BytesIO(b"".join(encode(m) for m in messages) + tail))


@dataclass(frozen=True)
class Rig:
    """What a host needs of one."""

    shaker: object
    operator: object
    document: object
    in_virtual_time: bool = False


def rig_with(shaker):
    return Rig(shaker, None, SimpleNamespace(shaker="its table"))


# Told


def test_a_client_hears_where_the_run_is_kept_what_it_will_do_and_what_happens(host):
    host.recording(Path("a.running"), Path("a.h5"))
    host.planned((), ())
    host.happened(Held())
    began = RecordingBegan(Path("a.running"), Path("a.h5"))
    assert heard(host) == [began, Planned((), ()), Happened(Held())]
    assert host.recorded == began


def test_progress_is_told_at_its_ends_and_a_few_times_between(host, monkeypatch):
    now = [0.0]
    monkeypatch.setattr(hosting, "monotonic", lambda: now[0])
    with host.progress("models") as report:
        for k in range(100):
            now[0] += 0.03
            report(k / 50)
    first, *between, last = heard(host)
    assert (first, last) == (Progressed("models", 0.0), Progressed("models", 1.0, ended=True))
    # Every fourth report comes a tenth of a second after the one before; more than all is all.
    assert len(between) == 25
    assert [m.fraction for m in between] == [min(1.0, (4 * k + 3) / 50) for k in range(25)]


def test_work_that_fails_has_ended_too(host):
    with pytest.raises(ValueError, match="broken"), host.progress("models"):
        raise ValueError("broken")
    assert heard(host)[-1] == Progressed("models", 1.0, ended=True)


def test_what_is_logged_is_told_on_one_line():
    mailbox = Mailbox()
    record = logging.LogRecord("drivers", logging.WARNING, "", 0, "no\nanswer %s", ("yet",), None)
    record.created = 0.0
    LogToClient(mailbox).emit(record)
    (said,) = mailbox.drain()
    assert (said.level, said.text) == ("WARNING", "no answer yet")
    assert said.utc == "1970-01-01T00:00:00.000+00:00"


# Asked


def test_a_hold_a_word_to_the_plan_and_a_declined_step_reach_the_run(host, exits):
    held = []
    host._end = lambda error: held.append((host.control.held, type(error)))
    listen(host, HoldWanted(), DeclineWanted(), OverruleWanted("add", 50.0))
    assert held == [(True, RigStopped)]
    assert host.control.declined()
    assert host.control.word() == ("add", 50.0)
    listen(host, ResumeWanted())
    assert not host.control.held


def test_a_stop_silences_the_shaker_past_the_run_for_good(host, exits):
    shaker = Shaker()
    with host.with_rig(rig_with(shaker)) as rig:
        assert heard(host) == [RigOpened("its table")]
        host._do(StopWanted())
        assert shaker.stops == 1
        assert heard(host) == [Silenced()]
        with pytest.raises(DriverError, match="for good"):
            rig.shaker.start()
    assert heard(host) == [RigClosed()]
    assert [type(e) for e in host.interruption.asked] == [KeyboardInterrupt]


def test_a_run_that_lets_go_of_a_shaker_that_does_not_stop_says_so(host):
    with pytest.raises(ShakerNotSilent), host.with_rig(rig_with(Shaker())):
        raise host.control.ends(ShakerNotSilent("no answer"))
    assert heard(host)[-1] == RigClosed(at_rest=False)


def test_an_abort_before_the_rig_is_open_or_after_it_is_closed_asks_for_the_end_alone(host):
    host._do(AbortWanted())
    shaker = Shaker()
    with host.with_rig(rig_with(shaker)):
        pass
    host._do(AbortWanted())
    assert shaker.stops == 0
    assert len(host.interruption.asked) == 2


def test_a_shaker_that_does_not_answer_is_not_said_to_be_silent(host, caplog):
    with host.with_rig(rig_with(Shaker(answers=False))), caplog.at_level(logging.ERROR, hosting.log.name):
        hosting.log.propagate = True
        host._do(StopWanted())
    assert Silenced() not in heard(host)


def test_the_end_of_the_client_is_the_end_of_the_run_and_of_a_process_that_hangs(host, exits):
    shaker = Shaker()
    with host.with_rig(rig_with(shaker)):
        listen(host)
    assert shaker.stops == 1
    assert host.control.aborted == "the program that watched the run has ended"
    assert [type(e) for e in host.interruption.asked] == [RigStopped]
    assert exits == [1]


@pytest.mark.parametrize("tail", [b"\xff" * 12, b"\x02\0\0\0\0\0\0\0{}", b"\x01"])
def test_a_client_that_cannot_be_understood_ends_the_run_as_well(host, exits, tail):
    listen(host, HoldWanted(), tail=tail)
    assert host.control.held
    assert host.control.aborted
    assert exits == [1]


def test_what_is_no_word_of_a_client_does_nothing(host):
    host._do(Order(Path("a.toml"), Path("out")))
    assert host.interruption.asked == []
    assert host.control.aborted is None


@pytest.mark.parametrize("kept", [True, False])
def test_a_run_that_is_broken_off_before_it_can_say_what_is_kept_is_not_said_to_be_empty(
    tmp_path, monkeypatch, kept
):
    host, folder = Host(ask_content=False), tmp_path / "a.running"

    def broken_off(*_, companion, **__):
        if kept:
            folder.mkdir()
            companion.recording(folder, tmp_path / "a.h5")
        raise KeyboardInterrupt

    monkeypatch.setattr(process, "run_experiment", broken_off)
    monkeypatch.setattr(process, "read_whole_experiment", lambda _: None)
    host.interruption = nullcontext()
    end = process._run(Order(tmp_path / "a.toml", tmp_path), host, None, None)
    said = f"what is complete is in {folder}: viscorig recover {folder}" if kept else "nothing was measured"
    assert (end.why, end.message) == ("stopped by the user", said)
