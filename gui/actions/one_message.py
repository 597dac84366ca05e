"""What is said of files that were opened at once: one message, which grows as they are read."""

from collections.abc import Callable


class OneMessage:
    """A message that comes takes the place of the one before: this one has what was said before in it.

    Parameters
    ----------
    awaits : callable
        Whether more may come of what was opened.
    said, refused : callable
        Told of all of it in one line; the second where any of it could not be done.
    """

    def __init__(
        self, awaits: Callable[[], bool], said: Callable[[str], object], refused: Callable[[str], object]
    ) -> None:
        self._awaits, self._said, self._refused = awaits, said, refused
        self._lines: list[str] = []
        self._bad = False

    def begin(self) -> None:
        """What was said before is not of what is opened now."""
        self._lines, self._bad = [], False

    def say(self, line: str) -> None:
        """Of one file: something was done."""
        self._add(line)

    def refuse(self, line: str) -> None:
        """Of one file: something could not be done."""
        self._bad = True
        self._add(line)

    def settle(self) -> None:
        """Something has come of which nothing is said: what is said from now on may be of other files."""
        if not self._awaits():
            self.begin()

    def _add(self, line: str) -> None:
        self._lines.append(line)
        (self._refused if self._bad else self._said)("; ".join(self._lines))
        self.settle()
