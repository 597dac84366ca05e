"""The sweep of a run: calibration, soak, then the plan's steps, identified while they are measured."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from instrument.check.forecast import (
    Forecast,
    calibration_segments,
    distinct,
    planned_segments,
    with_next_coarser,
)
from instrument.files.experiment_file import SweepTable
from instrument.run.analysis import Analysis
from instrument.run.live_choice import Chooser, LiveChoice
from instrument.run.live_fit import Fitter, LiveFit
from instrument.run.rig import Rig
from instrument.run.runner import Runner
from instrument.session.configuration import Experiment
from instrument.session.setup import Setup
from instrument.stepped_sine.adaptive import AdaptivePlanner
from instrument.stepped_sine.plan import Done, Plan, PlannedSegment, Planner
from instrument.stream.derived import FitUpdated, PointMeasured, StepsChosen
from instrument.stream.event import Event
from instrument.stream.raw import ChoiceStarted, PlanOverruled, SegmentEnded, StepDeclined

_ADAPTIVE_PASSES = 2
"""The first pass, and all steps chosen after it."""


class SweepPart:
    """The sweep of one run, with its live fit and choice of steps.

    `happened` has to be told of every event after it was analysed.

    Parameters
    ----------
    earlier
        Events of a run that was broken off.
    record
        Takes what is not analysed: fits and choices, from any thread.
    """

    def __init__(
        self,
        experiment: Experiment,
        *,
        specimen: AnySpecimen,
        setup: Setup,
        forecast: Forecast,
        analysis: Analysis,
        earlier: list[Event],
        record: Callable[[Event], object],
        fit: Fitter,
    ) -> None:
        self._experiment, self._setup, self._forecast = experiment, setup, forecast
        self._specimen = specimen
        self._analysis, self._record, self._fitter = analysis, record, fit
        self._calibration_points = tuple(
            e for e in earlier if isinstance(e, PointMeasured) and e.purpose == "calibration"
        )
        last_step = max((getattr(e, "step", 0) for e in earlier), default=0)
        declined = tuple(e for e in earlier if isinstance(e, StepDeclined))
        done = Done((*analysis.points, *self._calibration_points), declined)
        self._planner = AdaptivePlanner(setup.sweep, forecast.decay_1_s, next_step=last_step + 1, done=done)
        self._planner.overruled = [e for e in earlier if isinstance(e, PlanOverruled)]
        self._chosen = [e for e in earlier if isinstance(e, StepsChosen)]
        self._chooser: Chooser | None = None
        self._choosing: LiveChoice | None = None
        self._live: LiveFit | None = None
        self._fits = 0
        self.is_measured = False
        """Whether every step of it is."""
        self.fit: FitUpdated | None = None
        """The last one of all points."""

    @property
    def table(self) -> SweepTable:
        """The table `[sweep]` of the experiment's file."""
        found = self._experiment.document.sweep
        assert found is not None
        return found

    def prepare(self) -> None:
        """Models that choices are made with, before anything moves; a hammer test changes little of them."""
        if self.table.plan == "adaptive":
            # Refused for every other structure before a run begins.
            assert isinstance(self._specimen, PlateSpecimen)
            self._chooser = Chooser(self._specimen, self.table, self._setup.sweep, self._chosen)
            self._chooser.ground(self._analysis.damping)

    def run(self, rig: Rig, runner: Runner, emit: Callable[[Event], object]) -> None:
        """From the mounted plate to the last step, and the fit of all points."""
        emit(rig.operator.mount("damped"))
        table, ranges, planner = self.table, distinct(rig.vibrometer.ranges), self._planner
        segments, planner.sentinel = planned_segments(self._forecast, table, ranges)
        used = [s.range_name for s in segments] + ([planner.sentinel[1]] if planner.sentinel else [])
        names = [n for n in with_next_coarser(used, ranges) if n not in self._analysis.calibrations]
        calibration = calibration_segments(table, names, ranges)
        if calibration:
            emit(rig.operator.aim("base"))
            runner.sweep("calibration", planner.plan(calibration))
        emit(rig.operator.aim("pickup"))
        if self._experiment.document.temperature is not None:
            runner.soak(self._experiment.document.temperature)
        if table.plan == "adaptive":
            self._adaptive(runner, segments[0])
        else:
            self._measured(runner, planner.plan(segments))

    @property
    def passes(self) -> int:
        """Over the segments, before anything follows."""
        return self.table.sweeps if self.table.plan == "fixed" else _ADAPTIVE_PASSES

    def follow(self, runner: Runner, segments: Sequence[PlannedSegment], mounting: int = 0) -> None:
        """Further steps, and the fit of all points.

        What is there of another `mounting` counts for nothing: a clamping that was broken off is begun anew.
        """
        before = self._planner
        there = tuple(p for p in before.done.points if p.mounting == mounting)
        planner = Planner(
            self._setup.sweep,
            before.decay_1_s,
            None,
            before.next_step,
            replace(before.done, points=there),
            before.drive,
        )
        self._measured(runner, planner.plan(segments))
        before.next_step = planner.next_step

    def fit_again(self) -> None:
        """Fit all points once more: something else than points has come."""
        with LiveFit(self._specimen, self._record, self._fitter, self._fits) as live:
            live.offer(self._analysis.points, self._analysis.damping)
        self._fits, self.fit = live.number, live.latest

    def happened(self, event: Event) -> None:
        """Begins a fit or a choice where the event says that there is more to go by."""
        a = self._analysis
        if isinstance(event, SegmentEnded) and a.points and event.sweep > 0 and self._live is not None:
            self._live.offer(a.points, a.damping)
        if isinstance(event, ChoiceStarted) and self._choosing is not None:
            self._choosing.start(event, a.points, a.damping)

    def choice(self, number: int, patience_s: float) -> StepsChosen | None:
        """The choice of a number; None where it is not made within a time."""
        assert self._choosing is not None
        return self._choosing.take(number, patience_s)

    def _adaptive(self, runner: Runner, band: PlannedSegment) -> None:
        """A sweep that chooses its own steps; all in the range that has room for the band's resonances."""
        chooser, planner = self._chooser, self._planner
        assert chooser is not None
        ground = chooser.ground(self._analysis.damping)
        planner.level_m_s2, planner.chosen = band.level_m_s2[0], dict(chooser.chosen)
        planner.range_of = lambda frequency_hz: band.range_name
        planner.region_of = lambda frequency_hz: int(ground.region(np.array([frequency_hz]))[0])
        with LiveChoice(chooser, self._record) as self._choosing:
            self._measured(runner, planner.adaptive())

    def _measured(self, runner: Runner, plan: Plan) -> None:
        """Walk a plan, fits beside it; the last one is of all points."""
        with LiveFit(self._specimen, self._record, self._fitter, self._fits) as self._live:
            runner.sweep("sweep", plan)
            self.is_measured = True
            self._live.offer(self._analysis.points, self._analysis.damping)
        self._fits = self._live.number
        self.fit, self._live = self._live.latest, None
