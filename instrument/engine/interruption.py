"""Ends what the main thread is doing, from another thread: as Ctrl-C does, even in a wait for a device."""

import _thread
import signal
import threading
from types import FrameType

from instrument.errors import RigStopped
from instrument.run.control import RunControl

AGAIN_S = 0.05
"""A signal that comes just before the main thread begins to wait does not end the wait: it comes again."""


class Interruption:
    """Raises in the main thread, once, while it is inside this context; what was asked before, on entering.

    A second one would break off the cleaning up after the first; so would one of a run that ends by itself.
    """

    def __init__(self, control: RunControl) -> None:
        self._control = control
        self._guard = threading.Lock()
        self._error: BaseException | None = None
        self._heard = threading.Event()
        """Raised, or nothing is left to be broken off."""

    @property
    def asked(self) -> bool:
        """Whether somebody has asked for the end."""
        return self._error is not None

    def ask(self, error: BaseException) -> None:
        """Raise this in the main thread. The first one counts."""
        with self._guard:
            if self._error is not None:
                return
            self._error = error
        self._signal()
        threading.Thread(target=self._insist, name="interruption", daemon=True).start()

    def _insist(self) -> None:
        while not self._heard.wait(AGAIN_S):
            self._signal()

    @staticmethod
    def _signal() -> None:
        if hasattr(signal, "pthread_kill"):
            signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)
        else:
            _thread.interrupt_main()

    def __enter__(self) -> "Interruption":
        signal.signal(signal.SIGTERM, self._terminated)
        signal.signal(signal.SIGINT, self._raise)
        if self._error is not None:
            self._raise()
        return self

    def __exit__(self, *_: object) -> None:
        self._ignore()
        self._heard.set()

    def _terminated(self, *_: object) -> None:
        self._error = self._error or RigStopped("terminated")
        self._raise()

    def _raise(self, _: int = 0, __: FrameType | None = None) -> None:
        self._ignore()
        self._heard.set()
        if self._control.ending:
            return
        raise self._error or KeyboardInterrupt

    def _ignore(self) -> None:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
