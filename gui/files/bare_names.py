"""Sentences about files with their names alone: a folder's path says nothing to who has just opened it."""

import re

_FOLDER = re.compile(r"(?<![^\s('\"])(?:/|[A-Za-z]:[\\/])(?:[^\s:;,'\"()\\/]+[\\/])+(?=[^\s:;,\\/])")
"""Before a name, from the root on. Up to a space: behind one, `m/s` would be taken for more of it."""
_COMMAND = re.compile(r"viscorig [^:;]*$")
"""What is to be typed, in which a path is needed in whole."""
_DEVICES = "/dev/"


def bare_names(said: str) -> str:
    """Without the folders of absolute paths, but for those of devices and of commands to be typed."""

    def shortened(found: re.Match[str]) -> str:
        kept = found[0].startswith(_DEVICES) or _COMMAND.search(said, 0, found.start())
        return found[0] if kept else ""

    return _FOLDER.sub(shortened, said)
