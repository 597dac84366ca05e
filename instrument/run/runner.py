"""The runner: does what the plan says on a rig, one loop on one thread.

While a run goes on nothing else reads a device or drives the shaker (others may silence it), and nothing
else that measures looks at a clock. Whatever ends a part, the shaker is silenced first, and believed silent
when it says so. Only this loop beats the heartbeat: a hung acquisition lets it go stale, and the device goes
silent by itself.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from time import sleep

from drivers.errors import DriverError, Refused
from drivers.front_end import Block, InputChannel
from instrument.errors import RigStopped, ShakerNotSilent
from instrument.files.experiment_file import TemperatureTable
from instrument.run.analysis import Analysis
from instrument.run.at_rest import silenced
from instrument.run.control import RunControl
from instrument.run.rig import Rig
from instrument.run.soaking import Soaking, read_temperature
from instrument.run.watching import BEAT_S, Told, Watching
from instrument.stepped_sine.drive import lowers_first
from instrument.stepped_sine.plan import Action, ChoiceWanted, Plan, RangeWanted, Result, WordWanted
from instrument.stepped_sine.settings import SweepSettings
from instrument.stepped_sine.settling_trace import begins_at
from instrument.stream.derived import (
    DriveRequested,
    LimitExceeded,
    LoopChecked,
    PointMeasured,
    RangeRequested,
    StepsChosen,
)
from instrument.stream.event import Derived, Event
from instrument.stream.raw import (
    AcquisitionBegan,
    BlockAcquired,
    Held,
    Part,
    PlanOverruled,
    RangeSet,
    ShakerCommanded,
    SignalLevelRead,
    StepBegan,
    StepDeclined,
)

_LONGEST_READ_S = 0.5
"""A call of the front-end: in between the heartbeat, limits and a person's word have their turn."""
_REST_S, _LOOK_S = 5.0, 0.01
"""After a stop, before the run says that the shaker does not obey; and how often it looks."""
_MARGIN_S = 2.0
"""Behind the device's own watchdog, until a shaker that was told to stop is taken to run on."""
_ECHO_OFF = 1e-3
"""Share by which the drive of a receipt may exceed the one asked for: rounding is less."""
_CHOICE_LOOK_S = 0.05
"""Within a wait for a choice, the heartbeat has its turn this often."""


class Runner:
    """One rig, one session."""

    def __init__(
        self,
        rig: Rig,
        analysis: Analysis,
        emit: Callable[[Event], list[Derived]],
        control: RunControl,
        settings: SweepSettings,
        choice: Callable[[int, float], StepsChosen | None] | None = None,
    ) -> None:
        """`choice` gives the choice of a number within so many seconds, for an adaptive sweep."""
        self._choice = choice
        self._rig, self._analysis, self._emit, self._control = rig, analysis, emit, control
        self._settings = settings
        self._told = Told()
        self._watching = Watching(rig, control, self._told)
        self._acquisitions = 0
        self.samples = 0
        """Samples read so far of the acquisition that goes on."""

    def sweep(self, part: Part, plan: Plan) -> None:
        """Walk a plan. Raises `RigStopped`, `DriverError`."""
        channels = tuple(n for n in ("base", "velocity", "temperature") if n in self._rig.sensors)
        self._wait_for_rest()
        with self.acquisition(part, channels):
            self._start()
            result: Result = None
            while True:
                try:
                    action = plan.send(result)
                except StopIteration:
                    return
                result = self._do(action)

    def soak(self, wanted: TemperatureTable) -> None:
        """Bring the chamber there and wait. Raises `RigStopped`, `DriverError`."""
        Soaking(self._rig, self._emit, self._control, self._watching.look).run(wanted)

    def silence(self) -> None:
        """The shaker to zero, whatever state it is in. Raises `ShakerNotSilent` where it does not say so.

        Its own watchdog has its time first: nobody beats the heartbeat meanwhile.
        """
        watchdog_s = self._rig.document.shaker.heartbeat_timeout_s
        if problem := silenced(self._rig.shaker, watchdog_s + _MARGIN_S):
            raise ShakerNotSilent(
                f"the shaker does not say that it is silent ({problem}); its own watchdog should have "
                f"silenced it after {watchdog_s:g} s, which nobody knows"
            )
        self._told.drive_v = 0.0

    # What a part is made of

    @contextmanager
    def acquisition(self, part: Part, names: tuple[str, ...]) -> Iterator[None]:
        """Acquire inputs until the part ends, however it does; a shaker that it drives is then silenced."""
        sensors = self._rig.sensors
        inputs = tuple(InputChannel(sensors[n].input, n, sensors[n].iepe, sensors[n].range_v) for n in names)
        front_end = self._rig.front_end
        front_end.start(inputs, self._rig.sample_rate_hz)
        self._names = names
        ended: BaseException | None = None
        try:
            self._acquisitions, self.samples = self._acquisitions + 1, 0
            self._emit(AcquisitionBegan(self._acquisitions, part, front_end.sample_rate_hz, names))
            yield
        except BaseException as error:
            ended = error
            self._control.ends(error)
            raise
        finally:
            try:
                # Silence first: what follows may take as long as a time-out.
                if part not in ("hammer", "struck"):
                    self._silence_after(ended)
            finally:
                with suppress(DriverError):
                    front_end.stop()

    def read(self, samples: int) -> list[Derived]:
        """The next samples into the stream; what follows from them. Raises `RigStopped`, `DriverError`."""
        self._watching.look()
        most = max(1, int(_LONGEST_READ_S * self._rig.front_end.sample_rate_hz))
        concludes = self._analysis.concludes
        with self._watching.beats.asking("front-end"):
            block = self._rig.front_end.read(min(samples, most))
        self.samples = block.first_sample + block.samples
        if concludes:
            self._watching.confirm_range()
        derived = self._emit(_acquired(block))
        if block.cable_fault.any():
            names = [n for n, bad in zip(self._names, block.cable_fault, strict=True) if bad]
            raise RigStopped(f"cable fault on {', '.join(names)}: check the sensor and its cable")
        _stop_at_a_limit(derived)
        return derived

    def set_range(self, name: str) -> None:
        """Have the vibrometer read in another range, where it does not yet. Raises `DriverError`."""
        if self._told.range is None or self._told.range.name != name:
            with self._watching.beats.asking("vibrometer"):
                self._told.range = self._rig.vibrometer.set_range(name)
            r = self._told.range
            self._emit(RangeSet(r.name, r.scale_m_s_v, r.full_scale_v, r.highest_hz, r.delay_s))

    def _wait_for_rest(self) -> None:
        """Until the drive of what was before is zero: a ramp counts from there. Raises `RigStopped`."""
        for _ in range(round(_REST_S / _LOOK_S)):
            if self._rig.shaker.status().drive_v == 0:
                return
            sleep(_LOOK_S)
        raise ShakerNotSilent(f"the shaker is not at rest {_REST_S:g} s after it was stopped")

    # One action

    def _do(self, action: Action) -> Result:
        if isinstance(action, RangeWanted):
            self.set_range(action.name)
        elif isinstance(action, ChoiceWanted):
            return self._chosen(action.number)
        elif isinstance(action, WordWanted):
            return self._word(action.number)
        elif isinstance(action, StepBegan):
            return self._measure(action)
        else:
            _stop_at_a_limit(self._emit(action))
        return None

    def _chosen(self, number: int) -> StepsChosen:
        """The choice, as a rule made while the last step was measured; samples and heartbeat go on."""
        assert self._choice is not None
        while True:
            for _ in range(round(_LONGEST_READ_S / _CHOICE_LOOK_S)):
                found = self._choice(number, _CHOICE_LOOK_S)
                if found is not None:
                    return found
                self._watching.look()
            self.read(round(_LONGEST_READ_S * self._rig.front_end.sample_rate_hz))

    def _word(self, number: int) -> PlanOverruled | None:
        """What a person has said to the plan, recorded as it is obeyed."""
        word = self._control.word()
        if word is None:
            return None
        said = PlanOverruled(number, *word)
        self._emit(said)
        return said

    def _measure(self, began: StepBegan) -> Result:
        """One step, again from its beginning after a hold."""
        self._control.declined()
        while True:
            self._begin_step(began)
            while not self._control.held:
                if self._declined(began):
                    declined = StepDeclined(began.step, began.segment, began.sweep, began.frequency_hz)
                    self._emit(declined)
                    return declined
                result = self._read_on(began)
                if result is not None:
                    return result
            self._hold()

    def _begin_step(self, began: StepBegan) -> None:
        told = self._told
        with self._watching.beats.asking("chamber"):
            read = read_temperature(self._rig)
        if read is not None:
            self._emit(read)
        with self._watching.beats.asking("vibrometer"):
            level = self._rig.vibrometer.signal_level()
        self._emit(SignalLevelRead(level))
        if told.range is not None and began.frequency_hz > told.range.highest_hz:
            raise RigStopped(
                f"at {began.frequency_hz:g} Hz: the vibrometer's range {told.range.name} reads up to "
                f"{told.range.highest_hz:g} Hz: choose another in [[sweep.segments]], or its filter"
            )
        if lowers_first(told.frequency_hz, told.drive_v, began.frequency_hz, began.drive_v):
            self._lower(began.drive_v)
        self._emit(began)
        self._command(began.frequency_hz, began.drive_v)

    def _read_on(self, began: StepBegan) -> PointMeasured | LoopChecked | None:
        """What the next block ends the step with; None: it goes on, with the drive or range asked for."""
        for event in self.read(self._analysis.wanted):
            if isinstance(event, DriveRequested):
                self._command(began.frequency_hz, event.drive_v)
            elif isinstance(event, RangeRequested):
                self.set_range(event.name)
            elif isinstance(event, PointMeasured | LoopChecked):
                return event
        return None

    def _declined(self, began: StepBegan) -> bool:
        """Whether a person would not have this step, the loop check before it included."""
        self._rig.operator.overrule(self._control)
        return began.sweep > 0 and began.purpose in ("step", "loop-check") and self._control.declined()

    def _hold(self) -> None:
        """Silent until resumed. Samples go on, so that nothing times out."""
        self._emit(Held())
        self.silence()
        while self._control.held:
            self.read(round(BEAT_S * self._rig.front_end.sample_rate_hz))
        self._wait_for_rest()
        self._start()

    def _start(self) -> None:
        self._watching.beats.restart()
        self._rig.shaker.start()

    def _lower(self, drive_v: float) -> None:
        """Less drive at the frequency it has, and until it is there: these samples are of no step."""
        command = self._command(self._told.frequency_hz, drive_v)
        begin = begins_at(command, self.samples, self._rig.front_end.sample_rate_hz, self._settings)
        while self.samples < begin:
            self.read(begin - self.samples)

    def _command(self, frequency_hz: float, drive_v: float) -> ShakerCommanded:
        ramp_s = self._settings.control.ramp_s
        change = max(abs(drive_v - self._told.drive_v), 1e-6)
        try:
            with self._watching.beats.asking("shaker"):
                echo = self._rig.shaker.command(frequency_hz, drive_v, change / ramp_s)
        except Refused as refusal:
            raise self._watching.explained(refusal) from refusal
        if not 0 < echo.drive_v <= drive_v * (1 + _ECHO_OFF):
            raise RigStopped(f"the shaker took {drive_v:.4g} V for {echo.drive_v:.4g} V: does its map hold?")
        self._told.frequency_hz, self._told.drive_v = frequency_hz, echo.drive_v
        command = ShakerCommanded(echo.sequence, frequency_hz, echo.drive_v, ramp_s, echo.sample)
        self._emit(command)
        return command

    def _silence_after(self, ended: BaseException | None) -> None:
        """Silence; where it fails that is told, with what had ended the part before."""
        try:
            self.silence()
        except ShakerNotSilent as loud:
            if isinstance(ended, RigStopped | DriverError):
                loud = ShakerNotSilent(f"{loud}; what came before: {' '.join(str(ended).split())}")
            raise self._control.ends(loud) from ended


def _stop_at_a_limit(derived: list[Derived]) -> None:
    for event in derived:
        if isinstance(event, LimitExceeded):
            raise RigStopped(event.message)


def _acquired(block: Block) -> BlockAcquired:
    return BlockAcquired(
        first_sample=block.first_sample,
        samples=block.samples,
        volts_per_count=tuple(float(v) for v in block.volts_per_count),
        full_scale_v=tuple(float(v) for v in block.full_scale_v),
        overload=tuple(bool(v) for v in block.overload),
        cable_fault=tuple(bool(v) for v in block.cable_fault),
        counts=block.counts,
    )
