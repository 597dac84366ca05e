"""What ends a command, and with which status.

BadInput        2   a file, an option: file, place, what was found, what is expected
RigStopped      3   the rig stopped itself safely: what was seen, its limit, what to do
StoppedByUser 130   Ctrl-C during a run: what is kept, and where
"""


class BadInput(Exception):
    """The user gave something that cannot be used. The message is one line."""


class StoppedByUser(Exception):
    """A run ended by Ctrl-C, the shaker silent. The message is one line."""


class RigStopped(Exception):
    """A run ended itself, the shaker silent. The message is one line."""
