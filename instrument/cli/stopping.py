r"""A run stopped or held from outside.

Ctrl-C and Ctrl-\ are the user's stop; a closed terminal or SIGTERM a safe one; Ctrl-Z holds, and again
resumes. The first stop counts: another would break off the silencing and the keeping that follow it.
"""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from time import monotonic
from types import FrameType

import click

from instrument.errors import RigStopped
from instrument.processes.terminal_signals import BY_A_PERSON
from instrument.run.control import RunControl

_SIGNALS = ("SIGTERM", "SIGHUP")
_HOLD = getattr(signal, "SIGTSTP", None)
_INSISTS_S = 10.0
"""After so long a further Ctrl-C counts again: something hangs, and a person wants to get out."""
_STOPPING = "stopping already: the shaker is silenced, what is complete is kept"


@contextmanager
def safe_stop(control: RunControl) -> Iterator[None]:
    r"""SIGTERM and SIGHUP raise `RigStopped` here, Ctrl-C and Ctrl-\ `KeyboardInterrupt`: the first counts.

    Where the run has ended by itself before, that was the first: nothing is raised. What is raised may be
    lost where Python runs code that nobody waits for; the run hears of it by `control` then, between two
    blocks.
    """
    known = [getattr(signal, name) for name in _SIGNALS if hasattr(signal, name)]
    before = {number: signal.getsignal(number) for number in (*known, *BY_A_PERSON)}
    stopped_s: list[float] = []

    def stop(number: int, _: FrameType | None) -> None:
        for other in known:
            signal.signal(other, signal.SIG_IGN)
        if stopped_s or control.ending:
            return
        stopped_s.append(monotonic())
        what = "the terminal was closed" if number == getattr(signal, "SIGHUP", None) else "terminated"
        control.abort(what)
        raise RigStopped(what)

    def interrupt(_: int, __: FrameType | None) -> None:
        if control.ending and not stopped_s:
            stopped_s.append(monotonic())
        if stopped_s and monotonic() - stopped_s[0] < _INSISTS_S:
            click.echo(_STOPPING, err=True)
            return
        stopped_s[:] = [monotonic()]
        control.interrupt()
        raise KeyboardInterrupt

    def hold_or_resume(_: int, __: FrameType | None) -> None:
        if control.held:
            control.resume()
            click.echo("going on", err=True)
        else:
            control.hold()
            click.echo("held, the shaker silent after this block: Ctrl-Z again to go on", err=True)

    for number in known:
        signal.signal(number, stop)
    for number in BY_A_PERSON:
        signal.signal(number, interrupt)
    if _HOLD is not None:
        before[_HOLD] = signal.signal(_HOLD, hold_or_resume)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def hear_no_more(*, alone: bool) -> None:
    """One Ctrl-C is unheard from here on: the command is over, and its exit status stands.

    A second one ends what still waits. Not where the process is another program's, not the command's `alone`:
    that one goes on to hear.
    """

    def once(*_: object) -> None:
        signal.signal(signal.SIGINT, signal.default_int_handler)

    if alone and threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGINT, once)


@contextmanager
def ended_as_by_a_person(*, even_ignored: bool = True) -> Iterator[None]:
    """While this is open SIGTERM and SIGHUP raise `KeyboardInterrupt`, as Ctrl-C does: the first counts.

    Not `even_ignored`: what is ignored (SIGHUP under nohup) stays so. Off the main thread nothing changes.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    signals = [getattr(signal, name) for name in _SIGNALS if hasattr(signal, name)]
    before = {number: signal.getsignal(number) for number in signals}
    known = [n for n, handler in before.items() if even_ignored or handler != signal.SIG_IGN]

    def end(_: int, __: FrameType | None) -> None:
        for other in known:
            signal.signal(other, signal.SIG_IGN)
        raise KeyboardInterrupt

    for number in known:
        signal.signal(number, end)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
