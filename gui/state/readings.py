"""The newest of what the rig gives: drive, base, velocity, channels; each with the moment it came. No Qt.

A value is of now, or its age is known. What no instrument gives any more is None, not its last value.
"""

from dataclasses import dataclass
from math import pi

import numpy as np

from instrument.stream.event import Event
from instrument.stream.raw import (
    AcquisitionBegan,
    BlockAcquired,
    DiagnosisStarted,
    Held,
    RangeSet,
    SessionEnded,
    ShakerCommanded,
    StepBegan,
)
from instrument.stream.scaling import Scaling

FRESH_S = 0.5
"""What is older is marked."""


@dataclass(frozen=True)
class ChannelNow:
    """One input in the newest block."""

    name: str
    peak_v: float
    full_scale_v: float
    overload: bool
    cable_fault: bool

    @property
    def share(self) -> float:
        """The peak as a share of the full scale."""
        return self.peak_v / self.full_scale_v if self.full_scale_v > 0 else 0.0


class Readings:
    """Follows the raw events, and what the shaker says of itself where somebody asks it.

    Attributes
    ----------
    samples_at, drive_at : float
        When the newest block and the newest word on the drive came, on the clock `take` is told.
    clipped : dict
        By channel: when it was last driven beyond its input's range, on the same clock.
    """

    def __init__(self) -> None:
        self.drive_v: float | None = None
        self.drive_at = self.samples_at = 0.0
        self.clipped: dict[str, float] = {}
        self._asked_shaker = False
        self._frequency_hz: float | None = None
        self._names: tuple[str, ...] = ()
        self._block: BlockAcquired | None = None
        self._scale_m_s_v = np.nan
        self._block_scale_m_s_v = np.nan

    def take(self, event: Event, at: float) -> None:
        """One event of the stream, and when it came."""
        match event:
            case AcquisitionBegan():
                self._names, self._block, self._frequency_hz = event.channels, None, None
                self.clipped = {}
                self._drive(None if event.part in ("hammer", "struck") else 0.0, at)
            case RangeSet():
                self._scale_m_s_v = event.scale_m_s_v
            case BlockAcquired():
                self._hear(event, at)
            case StepBegan():
                self._frequency_hz = event.frequency_hz
            case ShakerCommanded():
                self._drive(event.drive_v, at)
            case Held():
                self._drive(0.0, at)
            case SessionEnded() | DiagnosisStarted():
                self.forget()

    def see_drive(self, drive_v: float, at: float) -> None:
        """The shaker was asked: from now on its own word counts, and not what it was told."""
        self._asked_shaker = True
        self.drive_v, self.drive_at = drive_v, at

    def forget(self) -> None:
        """The rig is let go of: there is nothing any more that could be known."""
        self.drive_v, self._block, self._frequency_hz = None, None, None
        self._asked_shaker = False

    def peaks(self, scaling: Scaling) -> tuple[float, float] | None:
        """Largest base acceleration and velocity of the newest block, m/s^2 and m/s; None without one."""
        if self._block is None or not (scaling.has("base") and scaling.has("velocity")):
            return None
        base, velocity = np.abs(scaling.motion(self._block.volts, self._block_scale_m_s_v)).max(axis=1)
        return float(base), float(velocity)

    def travel_m(self, base_m_s2: float) -> float | None:
        """Of the base at the step's frequency."""
        f = self._frequency_hz
        return None if f is None else base_m_s2 / (2 * pi * f) ** 2

    @property
    def channels(self) -> list[ChannelNow]:
        """Every input of the newest block."""
        block = self._block
        if block is None:
            return []
        peaks = np.abs(block.volts).max(axis=1)
        rows = zip(self._names, peaks, block.full_scale_v, block.overload, block.cable_fault, strict=False)
        return [ChannelNow(name, float(peak), full, over, fault) for name, peak, full, over, fault in rows]

    def _hear(self, block: BlockAcquired, at: float) -> None:
        self.samples_at = at
        if block.counts.size:
            self._block, self._block_scale_m_s_v = block, self._scale_m_s_v
        for name, over in zip(self._names, block.overload, strict=False):
            if over:
                self.clipped[name] = at
        if not self._asked_shaker:
            # The run goes on only while the shaker answers it.
            self.drive_at = at

    def _drive(self, drive_v: float | None, at: float) -> None:
        if not self._asked_shaker or drive_v is None:
            self.drive_v, self.drive_at = drive_v, at
