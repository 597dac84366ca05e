"""What happened, in lines for people."""

from dataclasses import dataclass, field
from datetime import datetime, timedelta
from typing import Literal

Kind = Literal["said", "warning", "fault"]
_MOST_LINES = 5000
"""The oldest go first."""


@dataclass(frozen=True)
class LogLine:
    """One line."""

    time_s: float
    """Since the session's first sample."""
    text: str
    kind: Kind
    wall: datetime | None = None
    """The same moment on the clock of the wall, where it is known."""


@dataclass
class Log:
    """Lines in order."""

    lines: list[LogLine] = field(default_factory=list)
    began: datetime | None = None
    """The session, on the clock of the wall."""
    dropped: int = 0
    """Lines let go of, so that a pane knows which it has shown: `dropped + len(lines)` only grows."""

    def add(self, time_s: float, text: str, kind: Kind = "said") -> None:
        """One more."""
        wall = self.began + timedelta(seconds=time_s) if self.began is not None else None
        self.lines.append(LogLine(time_s, text, kind, wall))
        if len(self.lines) > _MOST_LINES:
            self.lines.pop(0)
            self.dropped += 1
