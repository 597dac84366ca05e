"""How a sweep is measured: tolerances, times, limits, and what counts where nobody says anything.

The tables of the experiment and the rig file take their defaults from here; what they have no key for is as
it stands here.
"""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class LevelControl:
    """Level control on the fitted base acceleration."""

    tolerance: float = 0.01
    """Relative: an accepted step's base is this near the level."""
    abort: float = 0.5
    """Relative: above the level by this, the run stops."""
    most_corrections: int = 8
    ramp_s: float = 0.05
    """A change of drive takes so long."""
    check_share: float = 0.02
    """Of the drive limit, for a loop check before any gain is known."""
    signal_over_noise: float = 20.0
    """A loop check answers at least so clearly ..."""
    check_s: float = 4.0
    """... within this time."""


@dataclass(frozen=True)
class Settle:
    """When a response counts as steady."""

    tolerance: float = 0.001
    """Relative, of the response over the base."""
    block_cycles: float = 3.0
    block_least_s: float = 0.04
    most_s: float = 8.0


@dataclass(frozen=True)
class Dwell:
    """How long a steady response is read."""

    cycles: float = 20.0
    least_s: float = 0.3
    most_s: float = 4.0


@dataclass(frozen=True)
class Limits:
    """Beyond these the run stops; from `warn` of them on it says so."""

    base_m_s2: float = 50.0
    velocity_m_s: float = 1.0
    travel_m: float = 5e-3
    """Peak displacement of the base."""
    drive_v: float = 5.0
    warn: float = 0.8


@dataclass(frozen=True)
class SweepSettings:
    """All of them."""

    control: LevelControl = field(default_factory=LevelControl)
    settle: Settle = field(default_factory=Settle)
    dwell: Dwell = field(default_factory=Dwell)
    limits: Limits = field(default_factory=Limits)
    least_signal_level: float = 0.1
    """Of the vibrometer's light; below it a point is marked."""
    latency_s: float = 0.3
    """Allowed for a command where the shaker does not say at which sample it took effect."""

    def block_s(self, frequency_hz: float) -> float:
        """Length of the blocks by which a step is followed."""
        return max(self.settle.block_cycles / frequency_hz, self.settle.block_least_s)

    def dwell_s(self, frequency_hz: float) -> float:
        """Length of the reading itself."""
        return min(max(self.dwell.cycles / frequency_hz, self.dwell.least_s), self.dwell.most_s)
