"""What ends a command, and with which status.

BadInput        2   a file, an option: file, place, what was found, what is expected
"""


class BadInput(Exception):
    """The user gave something that cannot be used. The message is one line."""
