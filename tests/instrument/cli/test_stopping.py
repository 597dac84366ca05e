"""One stop ends a run: those that follow do not break off what the first has begun."""

import os
import signal
import subprocess
import sys
import threading

import pytest

from instrument.cli.main import main, run
from instrument.cli.predict import predict
from instrument.cli.stopping import ended_as_by_a_person, safe_stop
from instrument.errors import RigStopped
from instrument.paper_case import case_file
from instrument.run.control import RunControl


def send(number):
    os.kill(os.getpid(), number)


def end(kept, first, *others):
    """As a run does: what it has is kept on the way out, whatever else is sent."""
    try:
        send(first)
    finally:
        for number in others:
            send(number)
        kept.append("all")


LAST_MOMENT = """
import os, signal, sys
from instrument.cli import main as program

ended, run, exit = sys.argv[1], program.run, sys.exit

def late(what, *given):
    found = what(*given) if what is run else None
    os.kill(os.getpid(), signal.SIGINT)
    return found if what is run else what(*given)

if ended == "said":
    program.run = lambda *given: late(run, *given)
else:
    sys.exit = lambda status: late(exit, status)
sys.argv = ["viscorig", "check", "absent.toml"]
program.main()
"""
"""A Ctrl-C as soon as a command has said its last word, or when its process is about to end."""


@pytest.mark.parametrize(("moment", "status"), [("said", 130), ("ends", 2)])
def test_a_ctrl_c_in_the_last_moment_gives_a_status_that_is_documented(tmp_path, moment, status):
    words = [sys.executable, "-c", LAST_MOMENT, moment]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert done.returncode == status, done.stderr
    assert "Traceback" not in done.stderr


def test_a_command_called_within_another_program_leaves_it_its_ctrl_c(capfd):
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(SystemExit, match="2"):
        main(["check", "absent.toml"])
    assert signal.getsignal(signal.SIGINT) is before


@pytest.mark.parametrize("first", [signal.SIGINT, signal.SIGQUIT])
def test_a_second_ctrl_c_does_not_break_off_the_first(capsys, first):
    control, kept = RunControl(), []
    with pytest.raises(KeyboardInterrupt), safe_stop(control):
        end(kept, first, signal.SIGQUIT, signal.SIGINT, signal.SIGTERM, signal.SIGINT)
    assert kept == ["all"]
    assert control.interrupted
    assert "stopping already" in capsys.readouterr().err


def test_a_ctrl_c_after_a_terminate_does_not_break_it_off():
    control, kept = RunControl(), []
    with pytest.raises(RigStopped, match="terminated"), safe_stop(control):
        end(kept, signal.SIGTERM, signal.SIGINT)
    assert kept == ["all"]
    assert control.aborted == "terminated"


def test_what_stops_once_a_run_ends_by_itself_only_says_that_it_stops(capsys):
    control, kept = RunControl(), []
    control.ends(RigStopped("a limit"))
    with safe_stop(control):
        end(kept, signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGQUIT)
    assert kept == ["all"]
    assert not control.interrupted
    assert control.aborted is None
    assert capsys.readouterr().err.count("stopping already") == 2


def test_where_something_hangs_a_later_ctrl_c_counts_again(monkeypatch):
    monkeypatch.setattr("instrument.cli.stopping._INSISTS_S", 0.0)
    with safe_stop(RunControl()):
        for _ in range(2):
            with pytest.raises(KeyboardInterrupt):
                send(signal.SIGINT)


def test_afterwards_signals_mean_what_they_meant():
    before = [signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)]
    with safe_stop(RunControl()):
        assert signal.getsignal(signal.SIGINT) is not before[0]
    assert [
        signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)
    ] == before


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_a_long_sum_ends_as_by_a_person(monkeypatch, capsys, number):
    before = signal.signal(number, signal.SIG_DFL)
    monkeypatch.setattr(predict, "callback", lambda **_: signal.raise_signal(number))
    specimen = str(case_file("zn1.toml"))
    try:
        assert run(["predict", specimen, "--frequencies", "20"]) == 130
        assert capsys.readouterr().err.strip() == "viscorig: stopped"
        assert signal.getsignal(number) == signal.SIG_DFL
    finally:
        signal.signal(number, before)


def test_what_is_ignored_stays_ignored(monkeypatch):
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with ended_as_by_a_person(even_ignored=False):
            signal.raise_signal(signal.SIGHUP)
            assert signal.getsignal(signal.SIGHUP) == signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, before)


def test_beside_the_main_thread_nothing_changes():
    before, seen = signal.getsignal(signal.SIGTERM), []

    def inside():
        with ended_as_by_a_person():
            seen.append(signal.getsignal(signal.SIGTERM))

    thread = threading.Thread(target=inside)
    thread.start()
    thread.join()
    assert seen == [before]
