"""What ends a command, and with which status.

BadInput        2   a file, an option: file, place, what was found, what is expected
RigStopped      3   the rig stopped itself safely: what was seen, its limit, what to do
ShakerNotSilent 3   it stopped, and the shaker does not say that it is silent
StoppedByUser 130   Ctrl-C during a run: what is kept, and where
"""

import errno
from typing import Literal

SWITCH_OFF = "SWITCH THE AMPLIFIER OFF"
"""What a person has to do about a shaker that nobody knows to be silent."""
NOT_SILENT: Literal["stopped, shaker NOT known to be silent"] = "stopped, shaker NOT known to be silent"
"""How such a run ended, as its session says."""
_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class BadInput(Exception):
    """The user gave something that cannot be used. The message is one line."""


class StoppedByUser(Exception):
    """A run ended by Ctrl-C, the shaker silent. The message is one line."""


class RigStopped(Exception):
    """A run ended itself, the shaker silent. The message is one line."""


class ShakerNotSilent(RigStopped):
    """A run ended over a shaker that nobody knows to be silent. The message is one line: first what to do."""

    def __init__(self, said: str) -> None:
        super().__init__(said if said.startswith(SWITCH_OFF) else f"{SWITCH_OFF}: {said}")


def fault_words(error: BaseException) -> str:
    """What to say of an error that nobody foresaw."""
    if isinstance(error, MemoryError):
        return "no memory left"
    return f"internal error, {type(error).__name__}: {' '.join(str(error).split())}"


def is_full(error: Exception) -> bool:
    """Whether the disk, somebody's share of it, or what one file may hold is."""
    return isinstance(error, OSError) and error.errno in _FULL


def system_words(error: OSError) -> str:
    """What the system says of a file that it did not take or give, without the number of its error."""
    if not is_full(error) or error.errno == errno.EFBIG:
        return error.strerror or str(error)
    said = error.strerror or ""
    # The library under a session's file says more of itself than of the disk.
    return said if said.startswith("disk full") else "disk full"
