"""The order of a sweep that chooses its own steps: each choice is made while the step before it is measured.

    choice 1 -> first pass ... last step | choice 2 | its step | choice 3 | ...
                               ^ decided meanwhile      ^ decided meanwhile

It knows neither the model nor a clock: it asks, goes on measuring, and takes the answer. What was chosen and
measured before a break is walked again without a word.
"""

from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass, field

from instrument.stepped_sine.plan import (
    Action,
    ChoiceWanted,
    Plan,
    PlannedSegment,
    Planner,
    RangeWanted,
    Result,
    WordWanted,
)
from instrument.stream.derived import StepsChosen
from instrument.stream.raw import ChoiceStarted, PlanOverruled, SegmentBegan, SegmentEnded


@dataclass
class AdaptivePlanner(Planner):
    """What such a plan draws on beside a fixed one."""

    level_m_s2: float = 0.0
    range_of: Callable[[float], str] = lambda frequency_hz: ""
    """Name of the vibrometer's range at a frequency."""
    region_of: Callable[[float], int] = lambda frequency_hz: 1
    """Number of the region that a step of a person's own lies in."""
    chosen: Mapping[int, StepsChosen] = field(default_factory=dict)
    """Choices of a run that was broken off, by number."""
    overruled: Sequence[PlanOverruled] = ()
    """What a person said in it."""
    _declined: list[float] = field(default_factory=list)

    def adaptive(self) -> Plan:
        """Until a choice, or a person, says that it is the end."""
        number, last, sweep = 1, 0, 1
        self._declined = []
        yield from self._start(number, last, None)
        while True:
            choice = yield from self._take(number)
            before = last
            for said in (yield from self._words(number)):
                if said.what == "end":
                    return
                assert said.frequency_hz is not None
                last = yield from self._one(self._planned(said.frequency_hz, sweep), last)
            if choice.ended and last == before:
                return
            steps = list(zip(choice.frequencies_hz, choice.segments, strict=True))
            number += 1
            if not steps:
                yield from self._start(number, last, None)
            for k, (frequency, segment) in enumerate(steps):
                if k == len(steps) - 1:
                    yield from self._start(number, last, frequency)
                last = yield from self._one(self._planned(frequency, sweep, segment), last)
            sweep = 2

    def _planned(self, frequency_hz: float, sweep: int, segment: int | None = None) -> PlannedSegment:
        region = self.region_of(frequency_hz) if segment is None else segment
        return PlannedSegment(region, sweep, (frequency_hz,), (self.level_m_s2,), self.range_of(frequency_hz))

    def _one(self, planned: PlannedSegment, last: int) -> Generator[Action, Result, int]:
        """One step; the number of the last one measured by then."""
        frequency = planned.frequencies_hz[0]
        done = self.done.find(planned, frequency)
        if done is not None:
            return max(last, done.step)
        if self.done.is_declined(planned, frequency):
            self._declined.append(frequency)
            return last
        yield RangeWanted(planned.range_name)
        yield SegmentBegan(planned.segment, planned.sweep, frequency, frequency, 1)
        if (yield from self._step(planned, "step", frequency, self.level_m_s2)):
            last = self.next_step - 1
        else:
            self._declined.append(frequency)
        yield SegmentEnded(planned.segment, planned.sweep)
        return last

    def _start(self, number: int, last: int, pending_hz: float | None) -> Plan:
        if number not in self.chosen:
            yield ChoiceStarted(number, last, pending_hz, tuple(self._declined))

    def _take(self, number: int) -> Generator[Action, Result, StepsChosen]:
        known = self.chosen.get(number)
        if known is not None:
            return known
        found = yield ChoiceWanted(number)
        assert isinstance(found, StepsChosen)
        return found

    def _words(self, number: int) -> Generator[Action, Result, list[PlanOverruled]]:
        """All that a person says to a choice; nobody is asked about what lies behind a later one."""
        said = [one for one in self.overruled if one.number == number]
        known = self.chosen.get(number)
        while number + 1 not in self.chosen and not (known is not None and known.ended):
            word = yield WordWanted(number)
            if word is None:
                break
            assert isinstance(word, PlanOverruled)
            said.append(word)
        return said
