"""The order of a sweep that chooses its own steps: each choice is made while the step before it is measured.

    choice 1 -> first pass ... last step | choice 2 | its step | choice 3 | ...
                               ^ decided meanwhile      ^ decided meanwhile

It knows neither the model nor a clock: it asks, goes on measuring, and takes the answer. What was chosen and
measured before a break is walked again without a word.
"""

from collections.abc import Callable, Generator, Mapping
from dataclasses import dataclass, field

from instrument.stepped_sine.plan import (
    Action,
    ChoiceWanted,
    Plan,
    PlannedSegment,
    Planner,
    RangeWanted,
    Result,
)
from instrument.stream.derived import StepsChosen
from instrument.stream.raw import ChoiceStarted, SegmentBegan, SegmentEnded


@dataclass
class AdaptivePlanner(Planner):
    """What such a plan draws on beside a fixed one."""

    level_m_s2: float = 0.0
    range_of: Callable[[float], str] = lambda frequency_hz: ""
    """Name of the vibrometer's range at a frequency."""
    chosen: Mapping[int, StepsChosen] = field(default_factory=dict)
    """Choices of a run that was broken off, by number."""

    def adaptive(self) -> Plan:
        """Until a choice says that it is the end."""
        number, last = 1, 0
        yield from self._start(number, last, None)
        choice = yield from self._take(number)
        sweep = 1
        while not choice.ended:
            steps = list(zip(choice.frequencies_hz, choice.segments, strict=True))
            number += 1
            if not steps:
                yield from self._start(number, last, None)
            for k, (frequency, segment) in enumerate(steps):
                planned = PlannedSegment(
                    segment, sweep, (frequency,), (self.level_m_s2,), self.range_of(frequency)
                )
                if k == len(steps) - 1:
                    yield from self._start(number, last, frequency)
                last = yield from self._one(planned, last)
            choice = yield from self._take(number)
            sweep = 2

    def _one(self, planned: PlannedSegment, last: int) -> Generator[Action, Result, int]:
        """One step; the number of the last one measured by then."""
        frequency = planned.frequencies_hz[0]
        done = self.done.find(planned, frequency)
        if done is not None:
            return max(last, done.step)
        yield RangeWanted(planned.range_name)
        yield SegmentBegan(planned.segment, planned.sweep, frequency, frequency, 1)
        yield from self._step(planned, "step", frequency, self.level_m_s2)
        measured = self.next_step - 1
        yield SegmentEnded(planned.segment, planned.sweep)
        return measured

    def _start(self, number: int, last: int, pending_hz: float | None) -> Plan:
        if number not in self.chosen:
            yield ChoiceStarted(number, last, pending_hz)

    def _take(self, number: int) -> Generator[Action, Result, StepsChosen]:
        known = self.chosen.get(number)
        if known is not None:
            return known
        found = yield ChoiceWanted(number)
        assert isinstance(found, StepsChosen)
        return found
