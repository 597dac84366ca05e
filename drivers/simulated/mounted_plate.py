"""What the world asks of a plate that is mounted, and what a person may do to one that lets it be done."""

from typing import Protocol, runtime_checkable

from drivers.arrays import Array
from drivers.simulated.drive import DrivePiece


class MountedPlate(Protocol):
    """What is mounted: driven, and asked what it does at uniform times."""

    def drive(self, piece: DrivePiece) -> None:
        """The shaker's output from now on."""
        ...

    def at(self, output: str, first_s: float, step_s: float, count: int) -> Array:
        """An output by its name. Shape (count,)."""
        ...


@runtime_checkable
class CanBeChanged(Protocol):
    """Read at another spot, loaded with a known mass, clamped anew."""

    def look_at(self, spot_m: tuple[float, float] | None) -> None:
        """The laser on another spot than the specimen's; None for that."""
        ...

    def load(self, mass_kg: float, at_m: tuple[float, float]) -> None:
        """A known mass on it, and no other."""
        ...

    def unload(self) -> None:
        """No known mass on it."""
        ...

    def clamp(self) -> None:
        """Out of its clamp and in again."""
        ...


@runtime_checkable
class CanBeStruck(Protocol):
    """Made ready for blows on the treated plate."""

    def strike(self, hit_m: tuple[float, float], read_m: tuple[float, float] | None, *, free: bool) -> None:
        """Blows at one place, the laser on another (None: where it was); hung free or in its clamp."""
        ...


@runtime_checkable
class CanBePlaced(Protocol):
    """Made ready for blows on the bare plate, with a sensor on it."""

    def place(self, hit_m: tuple[float, float], response_m: tuple[float, float]) -> None:
        """Where the hammer strikes and the sensor sits."""
        ...


@runtime_checkable
class CanBeHit(Protocol):
    """Hit by the hammer, once it is ready for it."""

    def hit(self, now_s: float) -> None:
        """One blow, soon."""
        ...
