"""Seconds since a session's first sample, across all its acquisitions."""

from datetime import datetime

from instrument.stream.event import Event
from instrument.stream.raw import AcquisitionBegan, BlockAcquired, SessionBegan, SoakBegan, TemperatureRead


class SessionClock:
    """Follows the raw events. A later acquisition begins when the one before has ended, soaking behind it."""

    def __init__(self) -> None:
        self._first: datetime | None = None
        self._since_first_s = self._offset_s = self._end_s = 0.0
        self._soak_s = 0.0
        self._rate = 1.0

    def take(self, event: Event) -> None:
        """Any event; most say nothing of time."""
        match event:
            case SessionBegan():
                now = datetime.fromisoformat(event.utc)
                self._first = self._first or now
                self._since_first_s = (now - self._first).total_seconds()
            case AcquisitionBegan():
                self._rate = event.sample_rate_hz
                # A run that went through virtual time is ahead of the clock.
                self._offset_s = max(self._end_s, self._since_first_s)
            case BlockAcquired():
                self._end_s = self.at(event.first_sample + event.samples)
            case SoakBegan():
                self._soak_s = self._end_s
            case TemperatureRead() if event.soak_s is not None:
                self._end_s = self._soak_s + event.soak_s

    @property
    def end_s(self) -> float:
        """Of all that happened so far."""
        return self._end_s

    def at(self, sample: int) -> float:
        """Of a sample of the present acquisition."""
        return self._offset_s + sample / self._rate
