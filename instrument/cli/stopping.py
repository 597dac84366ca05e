"""A run stopped from outside: Ctrl-C is the user's; a closed terminal or SIGTERM is a safe stop."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from instrument.errors import RigStopped

_SIGNALS = ("SIGTERM", "SIGHUP")


@contextmanager
def safe_stop() -> Iterator[None]:
    """While this is open, SIGTERM and SIGHUP raise `RigStopped`, once; the shaker is silenced on the way."""
    known = [getattr(signal, name) for name in _SIGNALS if hasattr(signal, name)]
    before = {number: signal.getsignal(number) for number in known}

    def stop(number: int, _: FrameType | None) -> None:
        for other in known:
            signal.signal(other, signal.SIG_IGN)
        what = "the terminal was closed" if number == getattr(signal, "SIGHUP", None) else "terminated"
        raise RigStopped(what)

    for number in known:
        signal.signal(number, stop)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
