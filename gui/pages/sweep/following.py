"""The step in progress as numbers to draw. No Qt."""

from dataclasses import dataclass
from time import perf_counter

import numpy as np

from fitting.arrays import Array
from gui.state.step import Step, Trace
from instrument.files.acceleration import acceleration_unit
from instrument.stepped_sine.settings import SweepSettings
from instrument.stepped_sine.settling_trace import SettlingTrace, begins_at
from instrument.stream.derived import DriveRequested, SettlingTimedOut, StepSettled

_CYCLES = 8.0
"""Of the time signal shown."""
_MOST_S = 0.006
"""Of fitting blocks at a turn; the rest at the next."""


@dataclass
class Following:
    """Keeps a `SettlingTrace` of the step shown: a new one for another step, drive or range."""

    settings: SweepSettings
    _step: Step | None = None
    _change: object = None
    _course: SettlingTrace | None = None
    _next: int = 0

    def take(self, step: Step) -> bool:
        """Follow a step as far as time allows; whether there is more to do."""
        if step is not self._step or step.last_change != self._change:
            self._begin(step)
        if self._course is None:
            return False
        for first, x in step.since(self._next):
            self._course.add(first, x)
            self._next = first + x.shape[1]
        end = perf_counter() + _MOST_S
        while self._course.read():
            if perf_counter() > end:
                return True
        return False

    @property
    def course(self) -> SettlingTrace | None:
        """Since the last change; None before the first command."""
        return self._course

    def remaining(self) -> tuple[Array, Array, Array]:
        """Seconds since the last change, the bound on the transient in percent, and that by noise alone.

        Shape (looks,) each.
        """
        known = [s for s in self._course.standings if s.remaining < np.inf] if self._course else []
        table = np.array([(s.seconds, 100 * s.remaining, 100 * s.noise) for s in known]).reshape(-1, 3)
        return table[:, 0], table[:, 1], table[:, 2]

    @property
    def base_m_s2(self) -> float | None:
        """Amplitude of the latest block."""
        done = self._course.standings if self._course is not None else []
        return done[-1].base_m_s2 if done else None

    def _begin(self, step: Step) -> None:
        self._step, self._change, self._course, self._next = step, step.last_change, None, 0
        if step.last_change is None:
            return
        change, latest = step.last_change
        rate, began = step.acquisition.sample_rate_hz, step.began
        begin = begins_at(change, latest, rate, self.settings)
        self._course = SettlingTrace(began.frequency_hz, began.decay_1_s, rate, begin, self.settings)
        self._next = max(0, latest)


def latest_cycles(step: Step) -> Trace:
    """The end of the time signal, its time counted back from the latest sample."""
    seconds = _CYCLES / step.began.frequency_hz
    trace = step.trace(seconds)
    count = min(len(trace.time_s), int(np.ceil(seconds * step.acquisition.sample_rate_hz)))
    if not count:
        return trace
    time = trace.time_s[-count:] - trace.time_s[-1]
    return Trace(time, trace.base_m_s2[-count:], trace.velocity_m_s[-count:])


def words(step: Step, settings: SweepSettings) -> str:
    """What the step is doing, in a line."""
    began = step.began
    what = {
        "step": "",
        "sentinel": "sentinel, ",
        "calibration": "calibration, ",
        "loop-check": "loop check, ",
    }
    place = f"{what[began.purpose]}{began.frequency_hz:.6g} Hz, step {began.step}"
    return f"{place}: {_phase(step, settings)}"


def _phase(step: Step, settings: SweepSettings) -> str:
    if step.point is not None:
        said = "; ".join(step.point.remarks)
        return f"measured, {said}" if said else "measured"
    if step.checked is not None:
        return f"answers {acceleration_unit().said(step.checked.gain_m_s2_v, '.3g')} a volt"
    if step.held:
        return "held, the shaker is silent"
    match step.rest:
        case StepSettled():
            return f"settled in {step.rest.seconds:.2f} s, dwelling"
        case SettlingTimedOut():
            return f"not settled after {step.rest.seconds:.2f} s, dwelling"
    if step.asked:
        said = step.asked[-1].why
        return f"{'drive' if isinstance(step.asked[-1], DriveRequested) else 'range'} corrected: {said}"
    return f"settling, at most {settings.settle.most_s:g} s" if step.commands else "beginning"
