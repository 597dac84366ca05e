"""The shaker as the rest of the program sees it: a sine of a frequency and a drive, with a heartbeat.

The device closes no loop: it makes the drive it is told, ramped, never above its own limit. The level at the
base is controlled from the measured acceleration, elsewhere.
"""

from dataclasses import dataclass
from enum import IntEnum
from typing import Protocol


class Alarm(IntEnum):
    """Why the device latched itself silent. It stays so until it is reset."""

    NONE = 0
    HEARTBEAT = 1
    INTERLOCK = 2
    OVERDRIVE = 3
    AMPLIFIER = 4


@dataclass(frozen=True)
class Echo:
    """The device's receipt of a command."""

    sequence: int
    sample: int | None
    """Index of the sample at which it took effect; None where the device does not know it."""
    drive_v: float
    """The drive accepted: less than asked where the device's own limit holds it."""


@dataclass(frozen=True)
class ShakerStatus:
    """What the device says of itself."""

    running: bool
    ramping: bool
    """The drive is still on its way to what was asked."""
    limited: bool
    """The device's own limit holds the drive below what was asked."""
    interlock_open: bool
    alarm: Alarm
    drive_v: float
    """Amplitude at the output now."""
    frequency_hz: float
    limit_v: float
    lost_answers: int = 0
    """That did not come or came damaged so far, those asked for again included; of the line, as it counts."""


class Shaker(Protocol):
    """What a driver must do. Every method returns within a bounded time or raises a `DriverError`.

    More of it, by device: docs/plugins.md.
    """

    def identity(self) -> str:
        """Maker, model, version, as the device states them."""
        ...

    def start(self) -> None:
        """Allow output; the drive stays zero until a command. Refused with an alarm or an open interlock."""
        ...

    def command(self, frequency_hz: float, drive_v: float, ramp_v_s: float) -> Echo:
        """A new sine, phase continuous; the amplitude goes there at `ramp_v_s`."""
        ...

    def stop(self) -> None:
        """Ramp to zero and disallow output. Works in any state, also twice."""
        ...

    def beat(self) -> None:
        """Send the heartbeat. Without one within the device's time-out it goes silent by itself."""
        ...

    def set_heartbeat_timeout_s(self, timeout_s: float) -> None:
        """How long without a beat the device waits until it goes silent. Told at the start of a run."""
        ...

    def status(self) -> ShakerStatus:
        """What the device says of itself."""
        ...

    def reset_alarm(self) -> None:
        """Clear a latched alarm whose cause is gone. Refused where it is not."""
        ...

    def close(self) -> None:
        """Let go of the connection. Does not stop the shaker: `stop` does."""
        ...
