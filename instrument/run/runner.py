"""The runner: does what the plan says on a rig, one loop on one thread.

While a run goes on nothing else reads a device or drives the shaker (others may silence it), and nothing
else that measures looks at a clock. Whatever ends a part, the shaker is silenced first, and believed silent
when it says so. Only this loop beats the heartbeat: a hung acquisition lets it go stale, and the device goes
silent by itself.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from time import monotonic, sleep

from drivers.errors import DriverError
from drivers.front_end import Block, InputChannel
from drivers.shaker import Alarm, ShakerStatus
from drivers.vibrometer import Range
from instrument.errors import RigStopped
from instrument.files.experiment_file import TemperatureTable
from instrument.hammer_test.struck import OVERLOADED
from instrument.run.analysis import Analysis
from instrument.run.at_rest import silenced
from instrument.run.control import RunControl
from instrument.run.rig import Rig
from instrument.run.soaking import Soaking, read_temperature
from instrument.stepped_sine.drive import lowers_first
from instrument.stepped_sine.plan import Action, ChoiceWanted, Plan, RangeWanted, Result, WordWanted
from instrument.stepped_sine.settings import SweepSettings
from instrument.stepped_sine.settling_trace import begins_at
from instrument.stepped_sine.soundness import MOST_OFF
from instrument.stream.derived import (
    DriveRequested,
    HitJudged,
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
    HammerTestEnded,
    Held,
    Part,
    PlanOverruled,
    RangeSet,
    ShakerCommanded,
    SignalLevelRead,
    StepBegan,
    StepDeclined,
)

_BEAT_S = 0.2
"""A tenth of the heartbeat's usual limit: a few may come late."""
_LONGEST_READ_S = 0.5
"""A call of the front-end: in between the heartbeat, limits and a person's word have their turn."""
OVERLOADS = 3
"""Of the laser, one blow after the other, before its next range is taken: that may not be calibrated."""
HITS_IN_VAIN = 20
"""Blows refused one after the other before a hammer test is given up: more of them would be no better."""
_REST_S, _LOOK_S = 5.0, 0.01
"""After a stop, before the run says that the shaker does not obey; and how often it looks."""
_MARGIN_S = 2.0
"""Behind the device's own watchdog, until a shaker that was told to stop is taken to run on."""
_ECHO_OFF = 1e-3
"""Relative: more than was asked, by rounding, is none."""
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
        self._range: Range | None = None
        self._beaten = -1e9
        self._frequency_hz = self._drive_v = 0.0
        self._acquisitions = self._samples = 0

    def sweep(self, part: Part, plan: Plan) -> None:
        """Walk a plan. Raises `RigStopped`, `DriverError`."""
        channels = tuple(n for n in ("base", "velocity", "temperature") if n in self._rig.sensors)
        self._wait_for_rest()
        with self._acquisition(part, channels):
            self._rig.shaker.start()
            result: Result = None
            while True:
                try:
                    action = plan.send(result)
                except StopIteration:
                    return
                result = self._do(action)

    def hammer(self, wanted: int, patience_s: float) -> None:
        """Catch blows until enough are good, or none comes, or too many in a row are not.

        Raises `RigStopped`, `DriverError`.
        """
        self._strike("hammer", ("force", "response"), wanted, patience_s)

    def strike(self, wanted: int, patience_s: float, ranges: Sequence[str]) -> None:
        """The same on the treated plate, which the laser reads in the first of some ranges that has room.

        Raises `RigStopped`, `DriverError`.
        """
        self._set_range(ranges[0])
        self._strike("struck", ("force", "velocity"), wanted, patience_s, tuple(ranges[1:]))

    def _strike(
        self,
        part: Part,
        channels: tuple[str, ...],
        wanted: int,
        patience_s: float,
        coarser: tuple[str, ...] = (),
    ) -> None:
        with self._acquisition(part, channels):
            analysis = self._analysis.hammer
            assert analysis is not None
            asked, waited = (-1, -1), 0.0
            operator = self._rig.operator
            while not (analysis.complete and operator.content(analysis.accepted)):
                if analysis.ready and not analysis.complete and analysis.accepted_of_caught != asked:
                    asked, waited = analysis.accepted_of_caught, 0.0
                    operator.hit(analysis.accepted, wanted)
                for did in operator.decided():
                    self._emit(did)
                before = self._samples
                caught = [e for e in self._read(analysis.wanted()) if isinstance(e, HitJudged)]
                if coarser and _too_narrow(analysis.rejected_in_a_row):
                    self._set_range(coarser[0])
                    coarser = coarser[1:]
                waited += 0.0 if caught else (self._samples - before) / self._rig.front_end.sample_rate_hz
                if waited > patience_s + analysis.record_s or len(analysis.rejected_in_a_row) >= HITS_IN_VAIN:
                    break
        self._emit(HammerTestEnded())

    def soak(self, wanted: TemperatureTable) -> None:
        """Bring the chamber there and wait. Raises `RigStopped`, `DriverError`."""
        Soaking(self._rig, self._emit, self._control, self._watch).run(wanted)

    def silence(self) -> None:
        """The shaker to zero, whatever state it is in. Raises `RigStopped` where it does not say that it is.

        Its own watchdog has its time first: nobody beats the heartbeat meanwhile.
        """
        watchdog_s = self._rig.document.shaker.heartbeat_timeout_s
        if problem := silenced(self._rig.shaker, watchdog_s + _MARGIN_S):
            raise RigStopped(
                f"the shaker does not say that it is silent ({problem}): SWITCH THE AMPLIFIER OFF; its own "
                f"watchdog should have silenced it after {watchdog_s:g} s, which nobody knows"
            )
        self._drive_v = 0.0

    def _wait_for_rest(self) -> None:
        """Until the drive of what was before is zero: a ramp counts from there. Raises `RigStopped`."""
        for _ in range(round(_REST_S / _LOOK_S)):
            if self._rig.shaker.status().drive_v == 0:
                return
            sleep(_LOOK_S)
        raise RigStopped(
            f"the shaker is not at rest {_REST_S:g} s after it was stopped: switch the amplifier off"
        )

    # One action

    def _do(self, action: Action) -> Result:
        if isinstance(action, RangeWanted):
            self._set_range(action.name)
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
                self._watch()
            self._read(round(_LONGEST_READ_S * self._rig.front_end.sample_rate_hz))

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
            if (read := read_temperature(self._rig)) is not None:
                self._emit(read)
            self._emit(SignalLevelRead(self._rig.vibrometer.signal_level()))
            if self._range is not None and began.frequency_hz > self._range.highest_hz:
                raise RigStopped(
                    f"at {began.frequency_hz:g} Hz: the vibrometer's range {self._range.name} reads up to "
                    f"{self._range.highest_hz:g} Hz: choose another in [[sweep.segments]], or its filter"
                )
            if lowers_first(self._frequency_hz, self._drive_v, began.frequency_hz, began.drive_v):
                self._lower(began.drive_v)
            self._emit(began)
            self._command(began.frequency_hz, began.drive_v)
            while not self._control.held:
                if self._declined(began):
                    declined = StepDeclined(began.step, began.segment, began.sweep, began.frequency_hz)
                    self._emit(declined)
                    return declined
                for event in self._read(self._analysis.wanted):
                    if isinstance(event, DriveRequested):
                        self._command(began.frequency_hz, event.drive_v)
                    elif isinstance(event, RangeRequested):
                        self._set_range(event.name)
                    elif isinstance(event, PointMeasured | LoopChecked):
                        return event
            self._hold()

    def _declined(self, began: StepBegan) -> bool:
        """Whether a person would not have this step, the loop check before it included."""
        self._rig.operator.overrule(self._control)
        return began.sweep > 0 and began.purpose in ("step", "loop-check") and self._control.declined()

    def _hold(self) -> None:
        """Silent until resumed. Samples go on, so that nothing times out."""
        self._emit(Held())
        self.silence()
        while self._control.held:
            self._read(round(_BEAT_S * self._rig.front_end.sample_rate_hz))
        self._wait_for_rest()
        self._rig.shaker.start()

    def _read(self, samples: int) -> list[Derived]:
        """The next samples into the stream; what follows from them."""
        self._watch()
        most = max(1, int(_LONGEST_READ_S * self._rig.front_end.sample_rate_hz))
        concludes = self._analysis.concludes
        block = self._rig.front_end.read(min(samples, most))
        self._samples = block.first_sample + block.samples
        if concludes:
            self._confirm_range()
        derived = self._emit(_acquired(block))
        if block.cable_fault.any():
            names = [n for n, bad in zip(self._names, block.cable_fault, strict=True) if bad]
            raise RigStopped(f"cable fault on {', '.join(names)}: check the sensor and its cable")
        _stop_at_a_limit(derived)
        return derived

    def _watch(self) -> None:
        """Between blocks: is the run to end, is the shaker well, and the heartbeat."""
        if self._control.interrupted:
            raise KeyboardInterrupt
        if self._control.aborted is not None:
            raise RigStopped(self._control.aborted)
        if monotonic() - self._beaten < _BEAT_S:
            return
        self._rig.shaker.beat()
        self._beaten = monotonic()
        status = self._rig.shaker.status()
        if status.alarm != Alarm.NONE:
            raise RigStopped(
                f"shaker alarm: {status.alarm.name.lower()}: remove its cause, then reset the alarm"
            )
        if status.interlock_open:
            raise RigStopped("shaker interlock open: close it, then begin again")
        self._question(status)

    def _question(self, status: ShakerStatus) -> None:
        """Whether the shaker does what it was told. Raises `RigStopped`."""
        if self._drive_v == 0:
            return
        if not status.running:
            raise RigStopped("the shaker was switched off by somebody else: begin again when it is free")
        if abs(status.frequency_hz / self._frequency_hz - 1) > MOST_OFF:
            raise RigStopped(
                f"the shaker says that it runs at {status.frequency_hz:g} Hz, "
                f"it was told {self._frequency_hz:g} Hz"
            )

    def _lower(self, drive_v: float) -> None:
        """Less drive at the frequency it has, and until it is there: these samples are of no step."""
        command = self._command(self._frequency_hz, drive_v)
        begin = begins_at(command, self._samples, self._rig.front_end.sample_rate_hz, self._settings)
        while self._samples < begin:
            self._read(begin - self._samples)

    def _command(self, frequency_hz: float, drive_v: float) -> ShakerCommanded:
        ramp_s = self._settings.control.ramp_s
        change = max(abs(drive_v - self._drive_v), 1e-6)
        echo = self._rig.shaker.command(frequency_hz, drive_v, change / ramp_s)
        if not 0 < echo.drive_v <= drive_v * (1 + _ECHO_OFF):
            raise RigStopped(f"the shaker took {drive_v:.4g} V for {echo.drive_v:.4g} V: does its map hold?")
        self._frequency_hz, self._drive_v = frequency_hz, echo.drive_v
        command = ShakerCommanded(echo.sequence, frequency_hz, echo.drive_v, ramp_s, echo.sample)
        self._emit(command)
        return command

    def _set_range(self, name: str) -> None:
        if self._range is None or self._range.name != name:
            self._range = self._rig.vibrometer.set_range(name)
            r = self._range
            self._emit(RangeSet(r.name, r.scale_m_s_v, r.full_scale_v, r.highest_hz, r.delay_s))

    def _confirm_range(self) -> None:
        """Before a reading counts: the range is still the one it is scaled by. Raises `RigStopped`.

        Somebody at its panel, or a mains plug, changes it, and every velocity is wrong by the ratio.
        """
        found, wanted = self._rig.vibrometer.range(), self._range
        if wanted is not None and found.name != wanted.name:
            raise RigStopped(
                f"the vibrometer's range is {found.name}, it was set to {wanted.name}: "
                "was it changed at its panel, or switched off and on? this step does not count"
            )

    @contextmanager
    def _acquisition(self, part: Part, names: tuple[str, ...]) -> Iterator[None]:
        sensors = self._rig.sensors
        inputs = tuple(InputChannel(sensors[n].input, n, sensors[n].iepe, sensors[n].range_v) for n in names)
        front_end = self._rig.front_end
        front_end.start(inputs, self._rig.sample_rate_hz)
        self._names = names
        ended: BaseException | None = None
        try:
            self._acquisitions, self._samples = self._acquisitions + 1, 0
            self._emit(AcquisitionBegan(self._acquisitions, part, front_end.sample_rate_hz, names))
            yield
        except BaseException as error:
            ended = error
            raise
        finally:
            try:
                # Silence first: what follows may take as long as a time-out.
                if part not in ("hammer", "struck"):
                    self._silence_after(ended)
            finally:
                with suppress(DriverError):
                    front_end.stop()

    def _silence_after(self, ended: BaseException | None) -> None:
        """Silence; where it fails that is told, with what had ended the part before."""
        try:
            self.silence()
        except RigStopped as loud:
            if isinstance(ended, RigStopped | DriverError):
                raise RigStopped(f"{' '.join(str(ended).split())}; {loud}") from ended
            raise


def _too_narrow(refused: list[str]) -> bool:
    """Whether the laser's range had no room for blow after blow: a softer one is to be had at once."""
    return len(refused) >= OVERLOADS and all(OVERLOADED in why for why in refused[-OVERLOADS:])


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
