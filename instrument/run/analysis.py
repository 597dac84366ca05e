"""From raw events to derived ones. Live runs and replays go through this and nothing else."""

import cmath
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace

from fitting.errors import TooFewPoints
from instrument.facts.follow_up import FollowUp
from instrument.hammer_test.analysis import HammerAnalysis
from instrument.hammer_test.struck import StruckAnalysis
from instrument.run.refused_calibration import refused
from instrument.session.setup import Setup
from instrument.stepped_sine.calibration import Calibration, calibrate
from instrument.stepped_sine.lost_velocity import lost_in_noise
from instrument.stepped_sine.step import StepAnalysis
from instrument.stepped_sine.step_context import StepContext
from instrument.stream.clock import SessionClock
from instrument.stream.derived import (
    CalibrationFound,
    DampingFound,
    PointMeasured,
    SentinelCompared,
    StruckFound,
)
from instrument.stream.event import Derived, Event
from instrument.stream.raw import (
    AcquisitionBegan,
    BlockAcquired,
    ClampedAnew,
    FollowUpDecided,
    FollowUpProposed,
    HammerTestEnded,
    Held,
    MassPut,
    OperatorDid,
    RangeSet,
    SegmentEnded,
    SessionBegan,
    ShakerCommanded,
    SignalLevelRead,
    SpotMoved,
    StepBegan,
    StepDeclined,
    StrikingBegan,
    TemperatureRead,
)
from instrument.stream.scaling import Scaling


class Analysis:
    """Follows a whole session."""

    def __init__(self, setup: Setup, settled_at: Mapping[int, frozenset[int]] | None = None) -> None:
        """`settled_at`: of a recorded run's steps the samples where they had settled, as it saw that.

        What followed in its recording follows from that; a later version may wait longer.
        """
        self._setup = setup
        self._settled_at = settled_at or {}
        self._acquisition: AcquisitionBegan | None = None
        self._range: RangeSet | None = None
        self._range_is_new = False
        self._range_names: tuple[str, ...] = ()
        self._utc = ""
        self._signal_level: float | None = None
        self._temperature_c: float | None = None
        self._latest = 0
        self._spot: SpotMoved | None = None
        self._mass: MassPut | None = None
        self._mounting = 0
        self._striking: StrikingBegan | None = None
        self._calibration_points: list[PointMeasured] = []
        self.step: StepAnalysis | None = None
        self.hammer: HammerAnalysis | None = None
        self.points: list[PointMeasured] = []
        """Of the sweep, sentinels included."""
        self.times_s: list[float] = []
        """When each of `points` was read, since the session's first sample."""
        self._clock = SessionClock()
        self.calibrations: dict[str, CalibrationFound] = {}
        self.damping: DampingFound | None = None
        self.struck: list[StruckFound] = []
        """What blows on the treated plate gave; of one place and mounting the last time."""
        self._proposed: FollowUpProposed | None = None
        self.followed: list[FollowUp] = []
        """What was decided to be measured after diagnoses, in order."""

    def feed(self, event: Event) -> list[Derived]:
        """Take a raw event; what follows from it."""
        self._clock.take(event)
        derived = self._follow(event)
        for one in list(derived):
            derived += self._keep(one)
        return derived

    def restore(self, event: Event) -> None:
        """Take an event of an earlier run of this session, so that this one can carry on."""
        self._clock.take(event)
        if isinstance(event, Derived):
            self._keep(event)
        elif isinstance(event, ClampedAnew):
            self._mounting = event.mounting
        elif isinstance(event, FollowUpProposed | FollowUpDecided):
            self._follows(event)

    @property
    def wanted(self) -> int:
        """Samples worth waiting for before the next look."""
        if self._strikes and self.hammer is not None:
            return self.hammer.wanted()
        return self.step.wanted() if self.step is not None else 1

    @property
    def concludes(self) -> bool:
        """Whether the samples that are next belong to a reading that may become a point."""
        return not self._strikes and self.step is not None and self.step.concludes

    @property
    def _strikes(self) -> bool:
        return self._acquisition is not None and self._acquisition.part in ("hammer", "struck")

    def _follow(self, event: Event) -> list[Derived]:
        match event:
            case BlockAcquired():
                return self._block(event)
            case ShakerCommanded() if self.step is not None:
                self.step.commanded(event)
            case StepBegan():
                self.step = self._begin(event)
            case SessionBegan():
                self._range_names, self._utc = event.ranges, event.utc
            case AcquisitionBegan():
                self._acquire(event)
            case RangeSet():
                self._range = event
                self._range_is_new = self.step is None or self.step.done
                if isinstance(self.hammer, StruckAnalysis) and self._strikes:
                    return self.hammer.range_set(event)
                if self.step is not None:
                    self.step.range_set(event, self._wider())
            case SpotMoved():
                self._spot = event
            case MassPut():
                self._mass = event
            case ClampedAnew():
                self._mounting = event.mounting
            case FollowUpProposed() | FollowUpDecided():
                self._follows(event)
            case StrikingBegan():
                self._striking = event
            case OperatorDid() if event.what in ("mounted", "aimed"):
                self._spot = None
                # A plate is mounted as it is; what was put on it is taken off.
                self._mass = None if event.what == "mounted" else self._mass
            case SignalLevelRead():
                self._signal_level = event.value
            case TemperatureRead():
                self._temperature_c = event.value_c
            case Held() | StepDeclined():
                self.step = None
            case SegmentEnded():
                self.step = None
                return self._calibrated()
            case OperatorDid() if self.hammer is not None:
                return self.hammer.operator(event)
            case HammerTestEnded() if self.hammer is not None:
                return self.hammer.ended(event)
        return []

    def _follows(self, event: FollowUpProposed | FollowUpDecided) -> None:
        if isinstance(event, FollowUpProposed):
            self._proposed = event
        elif event.agreed and self._proposed is not None:
            self.followed.append(self._proposed.offers[event.offer])

    def _keep(self, event: Derived) -> list[Derived]:
        """What is remembered of derived events, and what follows from them in turn."""
        match event:
            case PointMeasured() if event.purpose == "calibration":
                self._calibration_points.append(event)
            case PointMeasured():
                self.points.append(event)
                self.times_s.append(self._clock.at(event.sample))
                return [*self._compared(event), *lost_in_noise(self.points)]
            case CalibrationFound():
                self.calibrations[event.range_name] = event
                own = [p for p in self._calibration_points if p.range_name == event.range_name]
                # A run that is carried on must not take these points for another range's.
                self._calibration_points = [
                    p for p in self._calibration_points if p.range_name != event.range_name
                ]
                return refused(event, own)
            case DampingFound():
                self.damping = event
            case StruckFound():
                self.struck = event.added_to(self.struck)
        return []

    def _block(self, block: BlockAcquired) -> list[Derived]:
        if self._acquisition is None:
            return []
        self._latest = block.first_sample + block.samples
        if any(block.cable_fault):
            # The run ends for it; nothing of these samples may become a reading before.
            return []
        if self._strikes:
            return self.hammer.block(block) if self.hammer is not None else []
        if self.step is None:
            return []
        found = self.step.block(block.first_sample, block.volts, block.overload)
        return [self._as_it_stood(e) if isinstance(e, PointMeasured) else e for e in found]

    def _as_it_stood(self, point: PointMeasured) -> PointMeasured:
        if point.purpose == "calibration":
            return point
        if self._spot is not None:
            point = replace(point, pickup=self._spot.pickup, spot_mm=self._spot.spot_mm)
        if self._mass is not None:
            point = replace(point, mass_kg=self._mass.mass_kg, mass_at_mm=self._mass.at_mm)
        return replace(point, mounting=self._mounting) if self._mounting else point

    def _acquire(self, event: AcquisitionBegan) -> None:
        self._acquisition, self.step, self._latest = event, None, 0
        if event.part == "hammer" and self._setup.hammer is not None:
            self.hammer = HammerAnalysis(self._setup.hammer, self._scaling(), event.sample_rate_hz)
        elif event.part == "struck":
            self.hammer = self._struck(event)

    def _struck(self, event: AcquisitionBegan) -> StruckAnalysis:
        hammer = self._setup.hammer
        if hammer is None or self._striking is None or self._range is None:
            raise ValueError("blows on the treated plate begin before it is known how it is held and read")
        f = [p.frequency_hz for p in self.points]
        band_hz = min(f, default=0.0), max(f, default=event.sample_rate_hz / 2)
        return StruckAnalysis(
            self._striking,
            hammer,
            self._scaling(),
            event.sample_rate_hz,
            band_hz,
            self._range,
            self._calibration,
        )

    def _begin(self, began: StepBegan) -> StepAnalysis:
        if self._acquisition is None or self._range is None:
            # No run does that; a recording of which something is lost may.
            raise ValueError(f"step {began.step} begins before an acquisition and the vibrometer's range")
        new, self._range_is_new = self._range_is_new, False
        context = StepContext(
            settings=self._setup.sweep,
            scaling=self._scaling(),
            sample_rate_hz=self._acquisition.sample_rate_hz,
            vibrometer=self._range,
            latest=self._latest,
            wider=self._wider(),
            calibration=None if began.purpose == "calibration" else self._calibration,
            signal_level=self._signal_level,
            temperature_c=self._temperature_c,
            settled_at=self._settled_at.get(began.step),
            range_is_new=new,
        )
        return StepAnalysis(began, context)

    def _calibration(self, range_name: str) -> Calibration | None:
        found = self.calibrations.get(range_name)
        return Calibration(found.gain, found.delay_s) if found is not None else None

    def _calibrated(self) -> list[Derived]:
        """Every range that has points enough."""
        found: list[Derived] = []
        for name in dict.fromkeys(p.range_name for p in self._calibration_points):
            with suppress(TooFewPoints):
                found.append(
                    calibrate([p for p in self._calibration_points if p.range_name == name], self._utc)
                )
        return found

    def _compared(self, point: PointMeasured) -> list[Derived]:
        """A sentinel against the first time it was measured."""
        if point.purpose != "sentinel":
            return []
        first = next(
            p for p in self.points if p.purpose == "sentinel" and p.frequency_hz == point.frequency_hz
        )
        if first is point:
            return []
        return [sentinel_compared(first, point)]

    def _wider(self) -> tuple[str, ...]:
        """Ranges coarser than the one in use, next first."""
        names = self._range_names
        if self._range is None or self._range.name not in names:
            return ()
        return names[names.index(self._range.name) + 1 :]

    def _scaling(self) -> Scaling:
        assert self._acquisition is not None
        return Scaling.of(self._acquisition.channels, self._setup.sensors.named())


def sentinel_compared(first: PointMeasured, again: PointMeasured) -> SentinelCompared:
    """How far the response over the base moved."""
    ratio = (again.velocity_m_s / again.base_m_s2) / (first.velocity_m_s / first.base_m_s2)
    change = 100 * (abs(ratio) - 1), 180 / cmath.pi * cmath.phase(ratio)
    return SentinelCompared(again.step, again.frequency_hz, *change)
