"""How a step comes to rest, block by block, for those who watch: as `StepAnalysis` sees it."""

from dataclasses import dataclass, field

import numpy as np

from fitting.arrays import Array
from instrument.stepped_sine.samples import Samples
from instrument.stepped_sine.settings import SweepSettings
from instrument.stepped_sine.settling import Settling
from instrument.stepped_sine.sine_fit import sine_fit
from instrument.stream.raw import RangeSet, ShakerCommanded

_AHEAD_S = 5.0
"""So far behind the samples' own counter a reader may be; a receipt of later samples is none. A choice."""


def begins_at(
    change: ShakerCommanded | RangeSet, latest: int, sample_rate_hz: float, settings: SweepSettings
) -> int:
    """First sample that belongs to a new drive or range; `latest` is the last one when it came.

    A receipt with a sample that was read before the command, or is far ahead, counts other samples than
    these: it is taken for one without. Waiting for the latter a run would drive for ever.
    """
    allowed = latest + round(settings.latency_s * sample_rate_hz)
    if isinstance(change, RangeSet):
        return allowed
    at = change.sample
    if at is None or not latest <= at <= latest + _AHEAD_S * sample_rate_hz:
        at = allowed
    return at + int(np.ceil(change.ramp_s * sample_rate_hz)) + 1


@dataclass(frozen=True)
class SettlingSample:
    """After a block."""

    seconds: float
    """Since the last change of drive or range took effect."""
    base_m_s2: float
    """Amplitude fitted."""
    remaining: float
    """Bound on what is left of the transient, relative; infinite after the first block."""
    noise: float
    """The same bound by noise alone."""


@dataclass
class SettlingTrace:
    """Of one step under one drive, in one range. Blocks in, a `Standing` for each."""

    frequency_hz: float
    decay_1_s: float
    sample_rate_hz: float
    begin: int
    """First sample that counts."""
    settings: SweepSettings
    standings: list[SettlingSample] = field(default_factory=list)
    _samples: Samples = field(default_factory=lambda: Samples(2))
    _settling: Settling | None = None

    def add(self, first_sample: int, x: Array) -> None:
        """Base and velocity in units, shape (2, samples). Only kept: `read` fits them."""
        if self._samples.first is not None and first_sample != self._samples.end:
            # Blocks are missing on the way here: begin again behind the gap.
            self._samples.clear()
            self._settling = None
        self._samples.add(first_sample, x, self.begin)

    def read(self) -> bool:
        """Fit the next block; whether there was one."""
        count = int(np.ceil(self.settings.block_s(self.frequency_hz) * self.sample_rate_hz))
        if self._samples.count < count:
            return False
        first, x = self._samples.take(count)
        fit = sine_fit(x, first, self.sample_rate_hz, self.frequency_hz)
        (base, velocity), std = fit.phasor, fit.std
        if self._settling is None:
            self._settling = Settling(self.decay_1_s, self.settings.settle.tolerance)
        noise = float(np.hypot(std[1] / abs(velocity), std[0] / abs(base)))
        self._settling.add(complex(velocity / base), noise, count / self.sample_rate_hz)
        seconds = (first + count - self.begin) / self.sample_rate_hz
        s = self._settling
        self.standings.append(SettlingSample(seconds, float(abs(base)), s.remaining, s.noise))
        return True
