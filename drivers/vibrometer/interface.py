"""The vibrometer as the rest of the program sees it. Its samples come through the front-end, as a voltage."""

from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True)
class Range:
    """One measuring range."""

    name: str
    """As the device spells it."""
    scale_m_s_v: float
    full_scale_v: float
    highest_hz: float
    delay_s: float | None
    """Stated by the maker; None where unknown. Measured in place all the same."""
    verified: bool
    """Seen in a manual or on a device, not from memory."""

    @property
    def full_scale_m_s(self) -> float:
        """Largest velocity read without overload."""
        return self.scale_m_s_v * self.full_scale_v


class Vibrometer(Protocol):
    """What a driver must do. Every method returns within a bounded time or raises a `DriverError`.

    More of it, by device: docs/plugins.md.
    """

    @property
    def ranges(self) -> tuple[Range, ...]:
        """From the most sensitive to the coarsest."""
        ...

    def identity(self) -> str:
        """Controller, decoder and sensor head, as the device states them."""
        ...

    def set_range(self, name: str) -> Range:
        """Choose a range and read it back."""
        ...

    def range(self) -> Range:
        """The one in use, asked of the device."""
        ...

    def signal_level(self) -> float:
        """How much light comes back, 0 to 1."""
        ...

    def signal_delay_s(self) -> float | None:
        """Delay of the velocity signal as the device states it; None where it states none."""
        ...

    def close(self) -> None:
        """Let go of the connection."""
        ...
