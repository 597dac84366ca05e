"""A run that is ended from outside: by another thread, by a signal; and the process that it runs in."""

import os
import signal
import threading
from types import SimpleNamespace

import pytest

from instrument.engine import __main__ as process
from instrument.engine.interruption import AGAIN_S, Interruption
from instrument.errors import RigStopped
from instrument.run.control import RunControl


@pytest.fixture
def signals():
    """As they were, afterwards."""
    kept = {s: signal.getsignal(s) for s in (signal.SIGINT, signal.SIGTERM)}
    yield
    for s, handler in kept.items():
        signal.signal(s, handler)


class Wanted(Exception):
    pass


def waits(waiting):
    """Until it is broken off; says that it has begun."""
    waiting.set()
    threading.Event().wait(5.0)


def test_another_thread_ends_what_the_main_thread_waits_for_once(signals):
    interruption = Interruption(RunControl())
    waiting = threading.Event()

    def ask():
        waiting.wait()
        interruption.ask(Wanted("first"))
        interruption.ask(Wanted("second"))

    asking = threading.Thread(target=ask)
    asking.start()
    with pytest.raises(Wanted, match="first"), interruption:
        waits(waiting)
    asking.join()
    assert interruption.asked
    # What cleans up afterwards is not broken off.
    os.kill(os.getpid(), signal.SIGINT)
    os.kill(os.getpid(), signal.SIGTERM)


def test_a_signal_that_the_wait_did_not_hear_comes_again(signals, monkeypatch):
    """As one does that comes between the last look for signals and the wait."""
    real, sent = signal.pthread_kill, []

    def kill(*to):
        sent.append(to)
        if len(sent) > 1:
            real(*to)

    monkeypatch.setattr(signal, "pthread_kill", kill)
    interruption, waiting = Interruption(RunControl()), threading.Event()
    asking = threading.Thread(target=lambda: (waiting.wait(), interruption.ask(Wanted("again"))))
    asking.start()
    with pytest.raises(Wanted, match="again"), interruption:
        waits(waiting)
    asking.join()
    # Once it is heard, no more.
    count = len(sent)
    threading.Event().wait(3 * AGAIN_S)
    assert len(sent) == count


def test_a_run_that_has_ended_meanwhile_is_not_signalled_again_and_again(signals, monkeypatch):
    sent = []
    monkeypatch.setattr(signal, "pthread_kill", lambda *to: sent.append(to))
    interruption = Interruption(RunControl())
    with interruption:
        pass
    interruption.ask(Wanted("too late"))
    threading.Event().wait(3 * AGAIN_S)
    assert len(sent) == 1


def test_what_was_asked_before_is_raised_on_entering(signals):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    interruption = Interruption(RunControl())
    assert not interruption.asked
    interruption.ask(Wanted("before"))
    with pytest.raises(Wanted, match="before"), interruption:
        pytest.fail("entered")


def test_a_process_that_is_terminated_stops_safely_and_ctrl_c_is_the_user(signals):
    with pytest.raises(RigStopped, match="terminated"), Interruption(RunControl()):
        os.kill(os.getpid(), signal.SIGTERM)
    with pytest.raises(KeyboardInterrupt), Interruption(RunControl()):
        os.kill(os.getpid(), signal.SIGINT)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_nothing_breaks_off_a_run_that_ends_by_itself(signals, number):
    control = RunControl()
    interruption = Interruption(control)
    with interruption:
        control.ends(RigStopped("a limit"))
        os.kill(os.getpid(), number)
        interruption.ask(Wanted("too late"))
        assert not threading.Event().wait(3 * AGAIN_S)


# The process


def test_the_pipes_are_the_engines_alone_and_no_thread_keeps_its_process(monkeypatch):
    done = []
    fake = SimpleNamespace(
        dup=lambda fd: 10 + fd,
        dup2=lambda fd, to: done.append((fd, to)),
        open=lambda path, how: 20,
        fdopen=lambda fd, mode: (fd, mode),
        devnull=os.devnull,
        O_RDONLY=os.O_RDONLY,
        _exit=lambda code: done.append(("exit", code)),
    )
    monkeypatch.setattr(process, "os", fake)
    monkeypatch.setattr(process, "serve", lambda commands, replies: done.append((commands, replies)))
    monkeypatch.setattr(process.faulthandler, "enable", lambda: done.append("faults"))
    process.main()
    # Standard input is empty and standard output goes to standard error before anything runs.
    assert done == ["faults", (20, 0), (2, 1), ((10, "rb"), (11, "wb")), ("exit", 0)]
