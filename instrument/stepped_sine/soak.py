"""When a chamber's temperature counts as reached. Pure: fed with readings by a run and by who watches."""

from instrument.stream.raw import SoakBegan, TemperatureRead


class Soak:
    """Follows one soak: how long the temperature has been near its set point without leaving it."""

    def __init__(self, began: SoakBegan) -> None:
        self.began = began
        self.temperature_c: float | None = None
        """Last read."""
        self.elapsed_s = 0.0
        """Up to the last reading."""
        self._near_from_s: float | None = None

    def take(self, read: TemperatureRead) -> None:
        """A reading of this soak. Between two readings the temperature is taken to stay where both are."""
        self.temperature_c = read.value_c
        self.elapsed_s = read.soak_s or 0.0
        if abs(read.value_c - self.began.set_point_c) > self.began.within_c:
            self._near_from_s = None
        elif self._near_from_s is None:
            self._near_from_s = self.elapsed_s

    @property
    def near_s(self) -> float:
        """How long it has been near; 0 where it is not."""
        return 0.0 if self._near_from_s is None else self.elapsed_s - self._near_from_s

    @property
    def done(self) -> bool:
        """Whether it has been near long enough."""
        return self._near_from_s is not None and self.near_s >= self.began.soak_s

    @property
    def too_late(self) -> bool:
        """Whether the time for it is over."""
        return not self.done and self.elapsed_s >= self.began.most_s

    @property
    def words(self) -> str:
        """How it stands, in a line."""
        goal = f"{self.began.set_point_c:g} °C"
        if self.temperature_c is None:
            return f"soaking at {goal}"
        at = f"{self.temperature_c:.1f} °C"
        return f"soaking {at} to {goal}, {self.near_s:.0f} of {self.began.soak_s:g} s"
