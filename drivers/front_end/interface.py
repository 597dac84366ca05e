"""The front-end as the rest of the program sees it: blocks of samples on one clock."""

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class InputChannel:
    """An input to record."""

    number: int
    """As printed on the device, from 1."""
    name: str
    iepe: bool = False
    """Feed the sensor."""
    range_v: float = 10.0
    """Peak. The device takes the next larger one it has; `Block.full_scale_v` says which."""


@dataclass(frozen=True)
class Block:
    """Samples in a row from every channel, as the converters gave them."""

    first_sample: int
    """Index of the first one since `start`."""
    counts: NDArray[np.int32]
    """Shape (channels, samples), in the order the channels were asked for."""
    volts_per_count: NDArray[np.float64]
    """Shape (channels,)."""
    full_scale_v: NDArray[np.float64]
    """Shape (channels,)."""
    overload: NDArray[np.bool_]
    """Shape (channels,): somewhere in the block."""
    cable_fault: NDArray[np.bool_]
    """Shape (channels,): an open or shorted sensor."""

    @property
    def samples(self) -> int:
        """How many there are of each channel."""
        return int(self.counts.shape[1])


@dataclass(frozen=True)
class Transducer:
    """What a sensor's own memory (TEDS, IEEE 1451.4) says of it."""

    type: str
    serial: str
    mv_per_unit: float | None = None
    """Per m/s^2, N or degree Celsius; None where the unit is none of these."""


class FrontEnd(Protocol):
    """What a driver must do. Every method returns within a bounded time or raises a `DriverError`.

    More of it, by device: docs/plugins.md.
    """

    @property
    def sample_rate_hz(self) -> float:
        """As the device runs, after `start`."""
        ...

    def identity(self) -> str:
        """Model and serial number, as the device states them."""
        ...

    def start(self, channels: tuple[InputChannel, ...], sample_rate_hz: float) -> None:
        """Begin to sample; index 0 is the first sample after it. Refused where the rate is not to be had."""
        ...

    def read(self, samples: int) -> Block:
        """The next `samples` of each channel, none lost, or a `DriverError`."""
        ...

    def stop(self) -> None:
        """End sampling. Works in any state, also twice."""
        ...

    def close(self) -> None:
        """Let go of the connection."""
        ...


@runtime_checkable
class ReadsMemories(Protocol):
    """What a front-end has besides that reads the memories of sensors when it is opened; none has to."""

    @property
    def transducers(self) -> tuple[Transducer | None, ...]:
        """By input, from 1 on; None where nothing answers."""
        ...
