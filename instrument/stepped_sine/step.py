"""One step: samples in, events out. No clock, file, thread or device.

    commanded -> settling -> dwelling -> measured
        ^            |           |
        +-- drive or range requested

A new command makes what came before worthless: blocks count from the end of its ramp.
"""

from typing import Literal

import numpy as np

from fitting.arrays import Array
from instrument.stepped_sine.guard import Guard
from instrument.stepped_sine.level_control import LevelControl
from instrument.stepped_sine.lost_velocity import StillVelocity
from instrument.stepped_sine.point_of_reading import Reading, point_of
from instrument.stepped_sine.samples import Samples
from instrument.stepped_sine.settling import Settling
from instrument.stepped_sine.settling_trace import begins_at
from instrument.stepped_sine.sine_fit import SineFit, sine_fit
from instrument.stepped_sine.soundness import soundness
from instrument.stepped_sine.step_context import StepContext
from instrument.stream.derived import (
    DriveRequested,
    LimitExceeded,
    LoopChecked,
    RangeRequested,
    SettlingTimedOut,
    StepSettled,
)
from instrument.stream.event import Derived
from instrument.stream.raw import RangeSet, ShakerCommanded, StepBegan

_CHECK_BLOCKS = 2.0
"""A loop check reads so many blocks at once."""
_RINGS = 4.0
"""E-foldings of the slowest motion, until an overload of a range just set is no more of what went before:
to a fiftieth. A choice."""
_CLIPPED = 0.98
"""Share of the vibrometer's full scale from which its output counts as clipped."""


class StepAnalysis:
    """Follows one step from its command to its point."""

    def __init__(self, began: StepBegan, context: StepContext) -> None:
        self._began, self._context = began, context
        self._settings, self._scaling = context.settings, context.scaling
        self._rate = context.sample_rate_hz
        self._range, self._wider = context.vibrometer, context.wider
        self._settled_at = context.settled_at
        self._rings_until: int | None = None if context.range_is_new else context.latest
        self._guard = Guard(began, context.settings)
        self._samples = Samples(3)
        self._command: ShakerCommanded | None = None
        self._from = self._latest = context.latest
        self._phase: Literal["settling", "dwelling", "done"] = "settling"
        self._remarks: list[str] = []
        self._control = LevelControl(began, context.settings, self._guard, self._remarks.append)
        self._still = StillVelocity()
        self._base: float | None = None
        self._flattened = False
        self._settle_s = 0.0
        self._left = 0.0
        self._restart()

    # What the runner asks

    @property
    def done(self) -> bool:
        """Whether the point is measured."""
        return self._phase == "done"

    @property
    def concludes(self) -> bool:
        """Whether it has settled, and what it reads next may become the point."""
        return self._phase == "dwelling"

    def wanted(self) -> int:
        """Samples that complete the next reading, counted from the last one received."""
        missing = max(0, self._from - self._latest) if self._samples.first is None else 0
        return max(1, missing + self._next_length() - self._samples.count)

    # What happened

    def commanded(self, command: ShakerCommanded) -> None:
        """A new drive: everything before it is worthless."""
        self._command = command
        self._from = begins_at(command, self._latest, self._rate, self._settings)
        if self._rings_until is None:
            rings_s = min(_RINGS / max(self._began.decay_1_s, 1e-9), self._settings.settle.most_s)
            self._rings_until = self._from + int(rings_s * self._rate)
        self._restart()

    def range_set(self, vibrometer: RangeSet, wider: tuple[str, ...]) -> None:
        """Another range: its first samples may still be the old one's."""
        self._range, self._wider = vibrometer, wider
        self._from = begins_at(vibrometer, self._latest, self._rate, self._settings)
        self._restart()

    def block(self, first_sample: int, volts: Array, overload: tuple[bool, ...]) -> list[Derived]:
        """Samples of all channels in V, shape (channels, samples)."""
        self._latest = first_sample + volts.shape[1]
        if self._command is None or self.done:
            return []
        row = self._scaling.rows
        if overload[row["base"]]:
            return [self._guard.stop("base acceleration channel overload", 1.0, 0.0, "", "raise its range")]
        x = self._in_units(volts)
        if overload[row["velocity"]] and self._latest > self._from:
            return self._guard.ramp(x[0]) or self._overloaded()
        self._samples.add(first_sample, x, self._from)
        events: list[Derived] = self._guard.ramp(x[0, : max(0, self._from - first_sample)])
        while not self.done and self._samples.count >= self._next_length() and not _final(events):
            events += self._reading(*self._samples.take(self._next_length()))
        return events

    # Readings

    def _reading(self, first: int, x: Array) -> list[Derived]:
        events: list[Derived] = self._guard.look(x[:2], self._command_drive())
        fit = sine_fit(x, first, self._rate, self._began.frequency_hz)
        events += self._guard.level(abs(fit.phasor[0]))
        if _final(events):
            return events
        if np.abs(x[1]).max() > _CLIPPED * self._range.scale_m_s_v * self._range.full_scale_v:
            return events + self._overloaded()
        if self._began.purpose == "loop-check":
            return events + self._loop_checked(first + x.shape[1], fit)
        if self._phase == "dwelling":
            return events + self._dwelt(first, x, fit)
        return events + self._followed(first + x.shape[1], x, fit)

    def _followed(self, end: int, x: Array, fit: SineFit) -> list[Derived]:
        """A block on the way to rest: correct the level, or see whether it has settled."""
        base, velocity = fit.phasor[:2]
        error = self._control.error(abs(base))
        before, self._base = self._base, abs(base)
        if lost := self._control.lost(float(abs(base)), before, self._command_drive()):
            return lost
        if self._control.far_under:
            return []
        if self._still.add(x[1]):
            return self._lost_velocity()
        trim = self._control.trim
        steady = before is not None and abs(abs(base) / before - 1) < max(abs(error) / 2, trim / 2)
        if abs(error) > trim and steady and self._control.may_correct:
            return self._control.correct(abs(base), error, self._command_drive())
        noise = float(np.hypot(fit.std[1] / abs(velocity), fit.std[0] / abs(base)))
        block_s = x.shape[1] / self._rate
        waited = (end - self._from) / self._rate
        settled = self._settling.add(complex(velocity / base), noise, block_s)
        if self._settled_at is not None:
            settled = end in self._settled_at
        held = abs(error) <= self._settings.control.tolerance or not self._control.may_correct
        if settled and held:
            self._dwell(waited)
            return [
                StepSettled(
                    self._began.step,
                    end,
                    waited,
                    100 * self._settling.remaining,
                    self._settling.predicted_s,
                )
            ]
        if waited > self._settings.settle.most_s:
            self._dwell(waited)
            remaining, limit = 100 * self._settling.remaining, 100 * self._settings.settle.tolerance
            if not settled and not any(r.startswith("not settled") for r in self._remarks):
                self._remarks.append(f"not settled: {remaining:.2g} % left, limit {limit:.2g} %")
            return [SettlingTimedOut(self._began.step, waited, min(remaining, 1e6), limit)]
        return []

    def _dwell(self, waited_s: float) -> None:
        self._phase = "dwelling"
        self._settle_s = waited_s
        self._left = min(self._settling.remaining, 1.0)

    def _dwelt(self, first: int, x: Array, fit: SineFit) -> list[Derived]:
        """The reading itself."""
        error = self._control.error(abs(fit.phasor[0]))
        if abs(error) > self._settings.control.tolerance:
            if self._control.may_correct:
                base = float(abs(fit.phasor[0]))
                return self._control.correct_in_dwell(base, error, self._command_drive())
            if abs(error) > self._settings.control.abort:
                return [self._guard.under_level(float(abs(fit.phasor[0])), self._control.level_m_s2)]
            self._remarks.append(f"level {100 * error:+.2g} % off, limit {self._tolerance_percent:.2g} %")
        if self._still.add(x[1]):
            return self._lost_velocity()
        if unsound := self._unsound(first, x, fit):
            return unsound
        self._phase = "done"
        reading = Reading(
            first_sample=first,
            dwell_s=x.shape[1] / self._rate,
            settle_s=self._settle_s,
            fit=fit,
            left=self._left,
            level_m_s2=self._control.level_m_s2,
            control_error=float(error),
            drive_v=self._command_drive(),
            range_name=self._range.name,
            remarks=tuple(self._remarks),
        )
        return [point_of(reading, self._began, self._context)]

    def _unsound(self, first: int, x: Array, fit: SineFit) -> list[Derived]:
        """What makes this reading none; what makes it doubtful is remarked."""
        found = soundness(x, first, self._rate, self._began.frequency_hz, fit)
        if found.fault is not None:
            f = found.fault
            return [self._guard.stop(f.what, f.value, f.limit, f.unit, f.remedy)]
        if found.velocity_is_flat and self._wider and not self._flattened:
            self._flattened = True
            self._samples.clear()
            return [RangeRequested(self._began.step, self._wider[0], f"a flat top in {self._range.name}")]
        self._remarks += found.remarks
        return []

    def _lost_velocity(self) -> list[Derived]:
        """A reading of an input that stands still is none; some in a row end the run."""
        began = self._began
        return [self._still.stop(began.step, began.frequency_hz)] if self._still.lost else []

    def _loop_checked(self, end: int, fit: SineFit) -> list[Derived]:
        base, need = abs(fit.phasor[0]), self._settings.control.signal_over_noise
        ratio = float(base / max(fit.std[0], np.finfo(float).tiny))
        if ratio < need and (end - self._from) / self._rate < self._settings.control.check_s:
            # What went before may still ring.
            return []
        self._phase = "done"
        if ratio < need:
            what = "loop check: base acceleration over its noise"
            remedy = "is the accelerometer connected, the amplifier on, its gain up?"
            return [self._guard.stop(what, ratio, need, "", remedy)]
        f = self._began.frequency_hz
        return [LoopChecked(self._began.step, f, float(base / self._command_drive()), ratio)]

    def _overloaded(self) -> list[Derived]:
        if self._latest < (self._rings_until or 0):
            self._from = self._latest
            self._restart()
            return []
        if not self._wider:
            what = "velocity at the vibrometer's coarsest range"
            full = self._range.scale_m_s_v * self._range.full_scale_v
            return [self._guard.stop(what, full, full, "m/s", "lower the level")]
        self._samples.clear()
        return [RangeRequested(self._began.step, self._wider[0], f"overload in {self._range.name}")]

    def _restart(self) -> None:
        self._samples.clear()
        self._settling = Settling(self._began.decay_1_s, self._settings.settle.tolerance)
        self._base = None
        self._control.restart()
        if self._phase == "dwelling":
            self._phase = "settling"

    # Small things

    @property
    def _tolerance_percent(self) -> float:
        return 100 * self._settings.control.tolerance

    def _command_drive(self) -> float:
        return self._command.drive_v if self._command is not None else 0.0

    def _next_length(self) -> int:
        f, s = self._began.frequency_hz, self._settings
        seconds = s.dwell_s(f) if self._phase == "dwelling" else s.block_s(f)
        if self._began.purpose == "loop-check":
            seconds *= _CHECK_BLOCKS
        return int(np.ceil(seconds * self._rate))

    def _in_units(self, volts: Array) -> Array:
        """m/s^2, m/s and degree Celsius. Shape (3, samples)."""
        known = self._scaling.has("temperature")
        temperature = self._scaling.units("temperature", volts) if known else np.zeros(volts.shape[1])
        return np.vstack([self._scaling.motion(volts, self._range.scale_m_s_v), temperature])


def _final(events: list[Derived]) -> bool:
    """Whether the runner has to act before more samples are worth looking at."""
    return any(isinstance(e, DriveRequested | RangeRequested | LimitExceeded) for e in events)
