"""One step as it goes on: its commands, its samples, how it comes to rest."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from instrument.stepped_sine.sine_fit import sine_fit
from instrument.stream.derived import (
    DriveRequested,
    LoopChecked,
    PointMeasured,
    RangeRequested,
    SettlingTimedOut,
    StepSettled,
)
from instrument.stream.event import Event
from instrument.stream.raw import AcquisitionBegan, BlockAcquired, Held, RangeSet, ShakerCommanded, StepBegan
from instrument.stream.scaling import Scaling

_MOST_SAMPLES = 2_000_000
"""Of one step, all channels together; the oldest are let go of."""


@dataclass(frozen=True)
class Trace:
    """Samples of the step in units, a row a channel."""

    time_s: Array
    """Since the step began."""
    base_m_s2: Array
    velocity_m_s: Array


@dataclass(frozen=True)
class _Heard:
    """A block and the vibrometer's range it was heard in."""

    block: BlockAcquired
    scale_m_s_v: float


@dataclass
class Step:
    """Follows one step. Its samples are turned into units only when somebody looks."""

    began: StepBegan
    acquisition: AcquisitionBegan
    scaling: Scaling
    latest: int = 0
    """The sample after the latest one when it began."""
    commands: list[ShakerCommanded] = field(default_factory=list)
    asked: list[DriveRequested | RangeRequested] = field(default_factory=list)
    """Corrections."""
    rest: StepSettled | SettlingTimedOut | None = None
    point: PointMeasured | None = None
    checked: LoopChecked | None = None
    held: bool = False
    last_change: tuple[ShakerCommanded | RangeSet, int] | None = None
    """The last command or range, and the sample after the latest one when it came."""
    _heard: list[_Heard] = field(default_factory=list)
    _size: int = 0

    def take(self, event: Event, vibrometer: RangeSet | None) -> None:
        """One event of the stream, and the range at that moment."""
        match event:
            case BlockAcquired() if not self.over and event.counts.size:
                self._hear(_Heard(event, vibrometer.scale_m_s_v if vibrometer is not None else np.nan))
            case ShakerCommanded() if not self.over:
                self.commands.append(event)
                self.last_change = event, self._end
            case RangeSet():
                self.last_change = event, self._end
            case DriveRequested() | RangeRequested():
                self.asked.append(event)
                self.rest = None
            case StepSettled() | SettlingTimedOut():
                self.rest = event
            case PointMeasured():
                self.point = event
            case LoopChecked():
                self.checked = event
            case Held():
                self.held = True

    @property
    def over(self) -> bool:
        """Measured, or broken off by a hold."""
        return self.point is not None or self.checked is not None or self.held

    @property
    def broken_off(self) -> bool:
        """Whether a hold came before it was measured: what was heard of it is past."""
        return self.held and self.point is None and self.checked is None

    @property
    def drive_v(self) -> float:
        """As last accepted by the shaker; 0 before."""
        return self.commands[-1].drive_v if self.commands and not self.held else 0.0

    @property
    def samples(self) -> int:
        """A channel's, so far."""
        return sum(h.block.samples for h in self._heard)

    def trace(self, last_s: float | None = None) -> Trace:
        """Base and velocity in units; the last seconds alone where a number is given."""
        wanted = self._last(last_s)
        if not wanted:
            return Trace(np.zeros(0), np.zeros(0), np.zeros(0))
        first = self._heard[0].block.first_sample
        rate = self.acquisition.sample_rate_hz
        time = [h.block.first_sample - first + np.arange(h.block.samples) for h in wanted]
        rows = np.concatenate([self._in_units(h) for h in wanted], axis=1)
        return Trace(np.concatenate(time) / rate, rows[0], rows[1])

    def since(self, sample: int) -> list[tuple[int, Array]]:
        """Blocks that begin at a sample or later: first sample of each, base in m/s^2 and velocity in m/s.

        Shape (2, samples) each.
        """
        return [
            (h.block.first_sample, self._in_units(h)) for h in self._heard if h.block.first_sample >= sample
        ]

    @property
    def _end(self) -> int:
        """The sample after the latest one."""
        if not self._heard:
            return self.latest
        return self._heard[-1].block.first_sample + self._heard[-1].block.samples

    def phasors(self) -> tuple[Array, NDArray[np.complex128]]:
        """Each block fitted as the measurement fits it: time of its end, and (2, blocks) base and velocity.

        Blocks shorter than a cycle are left out. Calibration is not taken off.
        """
        first = self._heard[0].block.first_sample if self._heard else 0
        rate, f = self.acquisition.sample_rate_hz, self.began.frequency_hz
        ends, found = [], []
        for h in self._heard:
            if h.block.samples >= rate / f:
                ends.append((h.block.first_sample + h.block.samples - first) / rate)
                found.append(sine_fit(self._in_units(h), h.block.first_sample, rate, f).phasor)
        if not found:
            return np.zeros(0), np.zeros((2, 0), dtype=np.complex128)
        return np.array(ends), np.stack(found, axis=1)

    def _hear(self, heard: _Heard) -> None:
        self._heard.append(heard)
        self._size += heard.block.counts.size
        while self._size > _MOST_SAMPLES and len(self._heard) > 1:
            self._size -= self._heard.pop(0).block.counts.size

    def _last(self, last_s: float | None) -> list[_Heard]:
        if last_s is None or not self._heard:
            return self._heard
        end = self._heard[-1].block.first_sample + self._heard[-1].block.samples
        begin = end - last_s * self.acquisition.sample_rate_hz
        return [h for h in self._heard if h.block.first_sample + h.block.samples > begin]

    def _in_units(self, heard: _Heard) -> Array:
        """Shape (2, samples): m/s^2 and m/s."""
        return self.scaling.motion(heard.block.volts, heard.scale_m_s_v)
