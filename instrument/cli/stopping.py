"""A run stopped or held from outside.

Ctrl-C is the user's stop; a closed terminal or SIGTERM a safe one; Ctrl-Z holds, and again resumes.
"""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

import click

from instrument.errors import RigStopped
from instrument.run.control import RunControl

_SIGNALS = ("SIGTERM", "SIGHUP")
_HOLD = getattr(signal, "SIGTSTP", None)


@contextmanager
def safe_stop(control: RunControl) -> Iterator[None]:
    """While this is open, SIGTERM and SIGHUP raise `RigStopped`, once; the shaker is silenced on the way."""
    known = [getattr(signal, name) for name in _SIGNALS if hasattr(signal, name)]
    before = {number: signal.getsignal(number) for number in known}

    def stop(number: int, _: FrameType | None) -> None:
        for other in known:
            signal.signal(other, signal.SIG_IGN)
        what = "the terminal was closed" if number == getattr(signal, "SIGHUP", None) else "terminated"
        raise RigStopped(what)

    def hold_or_resume(_: int, __: FrameType | None) -> None:
        if control.held:
            control.resume()
            click.echo("going on", err=True)
        else:
            control.hold()
            click.echo("held, the shaker silent after this block: Ctrl-Z again to go on", err=True)

    for number in known:
        signal.signal(number, stop)
    if _HOLD is not None:
        before[_HOLD] = signal.signal(_HOLD, hold_or_resume)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
