"""A shaker brought to rest: told to stop, again where it does not obey, believed when it says it is silent.

A stop can be refused by a device that is busy, acknowledged and not carried out, or lost on a line. So
nothing that ends with silence relies on having sent it.
"""

import _thread
import threading
from collections.abc import Callable
from time import monotonic, sleep

from drivers.errors import DriverError, Refused, TimedOut
from drivers.shaker import Shaker, ShakerStatus

AT_REST_S = 1.0
"""How long a stopped shaker may take to be at zero where a person waits for it."""
_LOOK_S = 0.01
"""Between two looks at its status: a ramp to zero takes a tenth of a second."""
_REFUSED_AGAIN_S = 0.05
"""Before the next try with a device that says no or does not answer: a busy one needs a moment."""


def bring_to_rest(shaker: Shaker, within_s: float = AT_REST_S) -> None:
    """Stop it, and again where it refuses, goes on or was started meanwhile, until it says that it is silent.

    Raises `DriverError` where it does not answer, or is not at rest within that many seconds.
    """
    deadline = monotonic() + within_s
    while True:
        try:
            shaker.stop()
            break
        except Refused:
            # Its watchdog may have done it meanwhile.
            if _is_at_rest(shaker.status()):
                return
            if monotonic() > deadline:
                raise
            sleep(_REFUSED_AGAIN_S)
    while True:
        status = shaker.status()
        if _is_at_rest(status):
            return
        if monotonic() > deadline:
            raise TimedOut(
                f"shaker: stopped, but its drive is still {status.drive_v:.3g} V after {within_s:g} s"
            )
        if status.running:
            shaker.stop()
        sleep(_LOOK_S)


def _is_at_rest(status: ShakerStatus) -> bool:
    return status.drive_v == 0 and not status.running


def came_to_rest(shaker: Shaker, within_s: float = AT_REST_S) -> str:
    """`bring_to_rest`, and why it did not come; empty where it did."""
    try:
        bring_to_rest(shaker, within_s)
    except DriverError as error:
        return " ".join(str(error).split())
    return ""


def silenced(shaker: Shaker, within_s: float) -> str:
    """`came_to_rest`, tried again until the time is over, though nobody answers; no signal breaks it off.

    It goes on on a thread of its own: signals reach the main thread alone. What a signal raises there
    meanwhile is raised once the shaker is silent; where it does not say so, that is what counts.
    """
    said = ["it was not told to stop"]
    # Not a `Thread`: its start can be broken off too, and a `join` that was takes a living one for ended.
    done, began = threading.Event(), False
    raised: BaseException | None = None
    while not done.is_set():
        try:
            if not began:
                # Begun twice where a signal comes just between, which does no harm.
                began = _begins(_insist, shaker, within_s, said, done)
            done.wait()
        except BaseException as error:  # Ctrl-C, or what a handler makes of a SIGTERM
            raised = error
    if raised is not None and not said[0]:
        raise raised
    return said[0]


def _begins(insist: Callable[..., None], *given: object) -> bool:
    """Whether it has a thread; without memory for one it is done here, where a signal may break it off."""
    try:
        return bool(_thread.start_new_thread(insist, given))
    except (RuntimeError, MemoryError):
        insist(*given)
        return True


def _insist(shaker: Shaker, within_s: float, said: list[str], done: threading.Event) -> None:
    deadline = monotonic() + within_s
    try:
        while True:
            # What a stop takes of the time counts; at least one is tried.
            said[0] = came_to_rest(shaker, max(deadline - monotonic(), _LOOK_S))
            if not said[0] or monotonic() > deadline:
                return
            sleep(_REFUSED_AGAIN_S)
    except Exception as error:  # a driver's own fault: whoever waits hears of it
        said[0] = f"{type(error).__name__}: {' '.join(str(error).split())}"
    finally:
        done.set()
