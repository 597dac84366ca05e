"""A station made of formulas: a shaker of known gain and a plate of one mode."""

from dataclasses import dataclass, field

import numpy as np

from instrument.stream.event import Derived
from instrument.stream.raw import RangeSet, ShakerCommanded, StepBegan

RATE = 8192.0
RANGE = RangeSet("20mm/s/V", 0.02, 10.0, 20e3, None)
BASE_V = 0.01
"""V per m/s^2."""


@dataclass
class Station:
    """Answers a step: steady sines, and a transient that decays from every command on."""

    gain_m_s2_v: float = 5.0
    response_s: complex = 0.004 - 0.002j
    """Velocity over base acceleration."""
    decay_1_s: float = 8.0
    free_hz: float = 20.5
    stirred: float = 0.3
    """The transient's size over the steady velocity, at a command."""
    noise_v: float = 0.0
    seed: int = 0
    now: int = 0
    _command: ShakerCommanded | None = None
    _sequence: int = 0
    _random: np.random.Generator = field(init=False)

    def __post_init__(self):
        self._random = np.random.default_rng(self.seed)

    def command(self, frequency_hz: float, drive_v: float, ramp_s: float = 0.05, *, told: bool = True):
        self._sequence += 1
        self._command = ShakerCommanded(
            self._sequence, frequency_hz, drive_v, ramp_s, self.now if told else None
        )
        self._from = self.now
        return self._command

    def read(self, samples: int, range_scale: float = RANGE.scale_m_s_v):
        """First index and volts, shape (2, samples)."""
        n = self.now + np.arange(samples)
        t = n / RATE
        c = self._command
        base = self.gain_m_s2_v * c.drive_v * np.exp(2j * np.pi * c.frequency_hz * t)
        since = (n - self._from) / RATE
        size = abs(self.response_s) * abs(base[0]) * self.stirred
        free = size * np.exp((-self.decay_1_s + 2j * np.pi * self.free_hz) * since)
        x = np.stack([base.real * BASE_V, (self.response_s * base + free).real / range_scale])
        first, self.now = self.now, self.now + samples
        return first, x + self.noise_v * self._random.standard_normal(x.shape)


def began(frequency_hz: float = 20.0, level_m_s2: float | None = 9.81, drive_v: float = 1.9, **changes):
    facts = {"step": 1, "purpose": "step", "segment": 1, "sweep": 1, "decay_1_s": 8.0}
    return StepBegan(
        frequency_hz=frequency_hz, level_m_s2=level_m_s2, drive_v=drive_v, **{**facts, **changes}
    )


def of_kind(events: list[Derived], kind: type):
    return [e for e in events if isinstance(e, kind)]
