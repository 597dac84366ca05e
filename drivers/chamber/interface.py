"""A climate chamber as the rest of the program sees it; one without a set point is a thermometer."""

from typing import Protocol


class Chamber(Protocol):
    """What a driver must do. Every method returns within a bounded time or raises a `DriverError`.

    More of it, by device: docs/plugins.md.
    """

    def identity(self) -> str:
        """What the device says it is; where it says nothing, what it is taken for and where. Asks it once."""
        ...

    def temperature_c(self) -> float:
        """Measured now, in degrees Celsius: never an earlier reading."""
        ...

    def set_point_c(self) -> float | None:
        """The set point that the device keeps; None for a thermometer."""
        ...

    def go_to(self, set_point_c: float) -> float:
        """A new set point, as read back. Refused where the device keeps another, and by a thermometer."""
        ...

    def close(self) -> None:
        """Let go of the connection. The chamber keeps its set point."""
        ...
