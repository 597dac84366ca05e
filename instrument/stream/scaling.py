"""From a block's counts to volts, and from volts to units: signs and ranges are applied here alone.

Products are taken in one order, so that a replay, a report and the window see the same bits as the run did.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array


def volts_of(counts: NDArray[np.int32], volts_per_count: Sequence[float]) -> Array:
    """Shape (channels, samples), row by row in memory, so that sums are the same on replay."""
    return np.multiply(counts, np.array(volts_per_count)[:, None], order="C")


class SensorStated(Protocol):
    """What a rig's file says of what hangs on an input."""

    @property
    def units_per_volt(self) -> float:
        """Signed."""
        ...

    @property
    def invert(self) -> bool:
        """Whether its positive direction is the other way."""
        ...


@dataclass(frozen=True)
class Scaling:
    """Which row of a block is what, and what its volts are worth."""

    rows: Mapping[str, int]
    units_per_volt: Mapping[str, float]
    """Signed: negative where the sensor faces the other way. Of the velocity the sign alone; its range tells
    the rest."""

    @classmethod
    def of(cls, channels: Sequence[str], sensors: Mapping[str, SensorStated]) -> Self:
        """Of an acquisition's channels, as the rig says what hangs on them."""
        scales = {name: sensor.units_per_volt for name, sensor in sensors.items()}
        scales["velocity"] = -1.0 if sensors["velocity"].invert else 1.0
        return cls({name: channels.index(name) for name in channels if name in sensors}, scales)

    def has(self, name: str) -> bool:
        """Whether there is such a channel."""
        return name in self.rows

    def units(self, name: str, volts: Array) -> Array:
        """Samples of a channel in m/s^2, N or degree Celsius, from those of all channels in V.

        Shapes (channels, samples) to (samples,).
        """
        return volts[self.rows[name]] * self.units_per_volt[name]

    def velocity(self, volts: Array, scale_m_s_v: float) -> Array:
        """The laser's samples in m/s, read in a range of this scale. Shapes as of `units`."""
        return self.units("velocity", volts) * scale_m_s_v

    def motion(self, volts: Array, scale_m_s_v: float) -> Array:
        """Base acceleration in m/s^2 and velocity in m/s. Shape (2, samples)."""
        return np.stack([self.units("base", volts), self.velocity(volts, scale_m_s_v)])

    def blow(self, volts: Array) -> Array:
        """Force in N and response in m/s^2. Shape (2, samples)."""
        return np.stack([self.units("force", volts), self.units("response", volts)])
