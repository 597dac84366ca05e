"""The samples a point was read from."""

from bisect import bisect_left
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from instrument.errors import BadInput
from instrument.session.storage import SessionFile
from instrument.stream.derived import PointMeasured
from instrument.stream.event import Event
from instrument.stream.raw import AcquisitionBegan, BlockAcquired, RangeSet, StepBegan
from instrument.stream.scaling import Scaling


@dataclass(frozen=True)
class DwellSamples:
    """Samples as the sensors gave them, a calibration's gain and delay in them. Shape (samples,) each."""

    time_s: Array
    """Since the dwell's first sample."""
    base_m_s2: Array
    velocity_m_s: Array


def dwell_of(session: SessionFile, step: int, look: Callable[[], None] = lambda: None) -> DwellSamples:
    """Read the dwell of a step. Raises `BadInput` where the session has no such point or not its samples.

    `look` is called between parts; it may raise where the samples are no longer wanted.
    """

    def last_point(number: int) -> int:
        """Step of the last point up to the end of a part: it only grows."""
        for earlier in range(number, -1, -1):
            look()
            steps = [
                e.step for e in session.part(earlier, with_samples=False) if isinstance(e, PointMeasured)
            ]
            if steps:
                return steps[-1]
        return 0

    last = bisect_left(range(session.part_count), step, key=last_point)
    found = _Found(step)
    for number in range(min(last, session.part_count - 1), -1, -1):
        look()
        found.read_back(number, session.part(number, with_samples=False))
        if found.whole:
            break
    if found.point is None or found.acquisition is None:
        raise BadInput(f"{session.path}: no point of step {step} in it")
    volts = _volts(session, range(found.first_part, last + 1), found.point, found.acquisition)
    scaling = Scaling.of(found.acquisition.channels, session.configuration.rig.channels.named())
    base, velocity = scaling.motion(volts, found.scale_m_s_v)
    return DwellSamples(np.arange(volts.shape[1]) / found.acquisition.sample_rate_hz, base, velocity)


@dataclass
class _Found:
    """A point and what was in force when it was read: gathered from its part on backwards."""

    step: int
    point: PointMeasured | None = None
    began: StepBegan | None = None
    acquisition: AcquisitionBegan | None = None
    scale_m_s_v: float = np.nan
    first_part: int = 0
    """In which the step began."""

    @property
    def whole(self) -> bool:
        """Whether nothing is missing."""
        return self.began is not None and self.acquisition is not None and bool(np.isfinite(self.scale_m_s_v))

    def read_back(self, number: int, events: Iterable[Event]) -> None:
        """A part before those there were."""
        for event in reversed(list(events)):
            match event:
                case PointMeasured() if event.step == self.step:
                    self.point = event
                case _ if self.point is None:
                    continue
                case StepBegan() if self.began is None:
                    self.began, self.first_part = event, number
                case RangeSet() if np.isnan(self.scale_m_s_v):
                    self.scale_m_s_v = event.scale_m_s_v
                case AcquisitionBegan() if self.acquisition is None:
                    self.acquisition = event


def _volts(session: SessionFile, parts: range, point: PointMeasured, acquisition: AcquisitionBegan) -> Array:
    """Shape (channels, samples)."""
    end = point.sample + round(point.dwell_s * acquisition.sample_rate_hz)
    pieces: list[Array] = []
    for number in parts:
        for event in session.part(number):
            if event == point:
                break
            if isinstance(event, StepBegan):
                pieces.clear()
            elif isinstance(event, BlockAcquired) and event.counts.size:
                begin = max(0, point.sample - event.first_sample)
                pieces.append(event.volts[:, begin : max(0, end - event.first_sample)])
    found = np.concatenate(pieces, axis=1) if pieces else np.zeros((0, 0))
    if found.shape[1] != end - point.sample:
        raise BadInput(f"{session.path}: the samples of step {point.step} are missing")
    return found
