"""A chamber in a run: soaked in virtual time, held, aborted, given up; temperatures in stream and points."""

import dataclasses
import threading

import pytest
from formula_rig import CHAMBER_REGISTERS, formula_rig
from quick_run import no_fit, run
from sessions import events_of

from drivers.simulated.climate import Climate
from drivers.simulated.rig import SimulatedChamber
from gui.state import SessionState
from instrument.check.forecast import Forecast
from instrument.check.work import planned_work
from instrument.errors import BadInput, RigStopped, StoppedByUser
from instrument.report.html import html_page
from instrument.report.setting import rig_section
from instrument.run.companion import Companion
from instrument.run.control import RunControl
from instrument.run.replay import replay
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile
from instrument.stream.raw import (
    AcquisitionBegan,
    BlockAcquired,
    Held,
    SoakBegan,
    SoakEnded,
    StepBegan,
    TemperatureRead,
)

SWEEP = "[[sweep.segments]]\nlow_hz = 95.0\nhigh_hz = 107.0\npoints = 3\n"
WANTED = "set_point_c = 35.0\nsoak_s = 60.0\nmost_s = 2000.0"


def chamber(air_s: float = 40.0) -> SimulatedChamber:
    return SimulatedChamber(Climate(air_s=air_s, plate_s=40.0), CHAMBER_REGISTERS)


class AtReading(Companion):
    """Does something at a reading of the soak, on the thread that measures."""

    def __init__(self, number, do):
        self._left, self._do = number, do
        self.events = []

    def happened(self, event):
        self.events.append(event)
        if isinstance(event, TemperatureRead) and event.soak_s is not None:
            self._left -= 1
            if self._left == 0:
                self._do()


@pytest.fixture(scope="module")
def soaked(tmp_path_factory):
    """A whole run at 35 degC: its session and the rig."""
    folder = tmp_path_factory.mktemp("soaked")
    with formula_rig(folder, sweep=SWEEP, temperature=WANTED, chamber=chamber()) as (rig, experiment):
        return run(experiment, folder), rig, experiment


def test_the_sweep_begins_when_the_chamber_has_stayed_within_for_the_soak_time(soaked):
    finished, _, _ = soaked
    events = events_of(finished.session)
    (began,) = [e for e in events if isinstance(e, SoakBegan)]
    (ended,) = [e for e in events if isinstance(e, SoakEnded)]
    soak = [e for e in events if isinstance(e, TemperatureRead) and e.soak_s is not None]
    assert (began.set_point_c, began.within_c, began.soak_s) == (35.0, 0.5, 60.0)
    near = [e for e in soak if e.soak_s >= ended.seconds - 60.0]
    assert all(abs(e.value_c - 35.0) <= 0.5 for e in near)
    before = [e for e in soak if e not in near]
    assert abs(before[-1].value_c - 35.0) > 0.5
    # 13 K to half a kelvin with 40 s: 130 s; then a minute, seen every five seconds.
    assert ended.seconds == pytest.approx(40 * 3.26 + 60, abs=5.1)
    assert events.index(ended) < min(k for k, e in enumerate(events) if isinstance(e, StepBegan))


def test_nothing_of_a_soak_is_recorded_but_the_temperature_and_the_shaker_is_silent(soaked):
    finished, rig, _ = soaked
    events = events_of(finished.session)
    between = events[
        next(k for k, e in enumerate(events) if isinstance(e, SoakBegan)) : next(
            k for k, e in enumerate(events) if isinstance(e, SoakEnded)
        )
    ]
    assert not [e for e in between if not isinstance(e, SoakBegan | TemperatureRead)]
    commands = [e.now_s for e in rig.device.log if e.what.startswith("command")]
    assert min(commands) > 180


def test_a_point_has_the_temperature_read_before_its_step(soaked):
    finished, _, _ = soaked
    events, read = events_of(finished.session), None
    at_step = {}
    for event in events:
        if isinstance(event, TemperatureRead):
            read = event
        elif isinstance(event, StepBegan):
            assert read is not None
            assert read.soak_s is None
            at_step[event.step] = read.value_c
    assert finished.points
    assert [p.temperature_c for p in finished.points] == [at_step[p.step] for p in finished.points]
    assert all(p.temperature_c == pytest.approx(35.0, abs=0.5) for p in finished.points)


def test_a_replay_is_equal_to_the_bit(soaked):
    finished, _, _ = soaked
    with SessionFile(finished.session) as file:
        again = replay(file, fit=no_fit)
    assert again.differences == []
    assert [p.temperature_c for p in again.points] == [p.temperature_c for p in finished.points]


def test_the_soak_counts_on_the_sessions_clock(soaked):
    finished, _, _ = soaked
    with SessionFile(finished.session) as file:
        contents = contents_of(file)
    assert contents.points[0].time_s > 180
    assert len(contents.temperatures) == sum(
        isinstance(e, TemperatureRead) and e.soak_s is None for e in events_of(finished.session)
    )


def test_the_report_lists_it(soaked):
    finished, _, _ = soaked
    with SessionFile(finished.session) as file:
        page = html_page("", [], [rig_section(contents_of(file))])
    assert "35 °C, within 0.5 °C" in page
    assert "the reading before it" in page


def test_a_window_says_how_far_it_is_and_counts_it(soaked):
    finished, _, experiment = soaked
    with SessionFile(finished.session) as file:
        state, events = SessionState(file.configuration), list(file.events())
    work = planned_work(experiment, Forecast.of(experiment.the_specimen()), ("sweep",))
    state.time_to_go.plan(work, 0.0)
    said, left = [], []
    for event in events:
        state.take(event)
        if isinstance(event, TemperatureRead) and event.soak_s is not None:
            assert state.run.state == "soaking"
            said.append(state.run.next_words)
            left.append(state.time_to_go.measuring_s(state.time_s))
        if isinstance(event, AcquisitionBegan | BlockAcquired):
            assert state.run.state != "soaking"
    assert said[0] == "soaking 22.0 °C to 35 °C, 0 of 60 s"
    assert said[-1].endswith("°C to 35 °C, 60 of 60 s")
    assert left[0] > 60
    assert left[1] < left[0]
    lines = [line.text for line in state.log.lines]
    assert "soaking at 35 °C, within 0.5 °C for 60 s" in lines
    assert any(line.startswith("soaked: at the set point after") for line in lines)


def test_an_abort_ends_a_soak_and_leaves_nothing(tmp_path):
    control = RunControl()
    with formula_rig(tmp_path, sweep=SWEEP, temperature=WANTED, chamber=chamber()) as (rig, experiment):
        stop = AtReading(3, lambda: control.abort("enough for today"))
        with pytest.raises(RigStopped, match=r"^enough for today; nothing was measured$"):
            run(experiment, tmp_path, control=control, companion=stop)
        assert not rig.device.status(rig.world.clock()[1]).running
    assert not list(tmp_path.glob("*.h5"))


def test_a_stop_by_the_keyboard_works_in_a_soak(tmp_path):
    def interrupt():
        raise KeyboardInterrupt

    with (
        formula_rig(tmp_path, sweep=SWEEP, temperature=WANTED, chamber=chamber()) as (_, experiment),
        pytest.raises(StoppedByUser, match="nothing was measured"),
    ):
        run(experiment, tmp_path, companion=AtReading(3, interrupt))


def test_after_a_hold_the_soak_begins_again(tmp_path):
    control = RunControl()

    def hold():
        control.hold()
        threading.Timer(0.3, control.resume).start()

    with formula_rig(tmp_path, sweep=SWEEP, temperature=WANTED, chamber=chamber()) as (_, experiment):
        watcher = AtReading(3, hold)
        run(experiment, tmp_path, control=control, companion=watcher)
    kinds = [type(e) for e in watcher.events if isinstance(e, SoakBegan | SoakEnded | Held)]
    assert kinds == [SoakBegan, Held, SoakBegan, SoakEnded]


def test_a_chamber_that_does_not_get_there_stops_the_run_with_its_cure(tmp_path):
    wanted = WANTED.replace("2000.0", "100.0")
    with (
        formula_rig(tmp_path, sweep=SWEEP, temperature=wanted, chamber=chamber(1e4)) as (_, experiment),
        pytest.raises(RigStopped) as stopped,
    ):
        run(experiment, tmp_path)
    assert str(stopped.value) == (
        "chamber at 22.1 °C after 100 s, 0 s within 0.5 °C of 35 °C, 60 s expected: is its door shut, does "
        "it heat and cool? else raise temperature.most_s or within_c; nothing was measured"
    )


def test_a_chamber_that_refuses_the_set_point_stops_the_run_before_anything_is_measured(tmp_path):
    wanted = WANTED.replace("35.0", "80.0")
    begun = Begun()
    with (
        formula_rig(tmp_path, sweep=SWEEP, temperature=wanted, chamber=chamber()) as (_, experiment),
        pytest.raises(RigStopped, match=r"^chamber at .*writing set point 80 °C: refused[^\n]*$") as stop,
    ):
        run(experiment, tmp_path, companion=begun)
    assert begun.steps == 0
    assert "is temperature.set_point_c = 80 within the chamber's range?" in str(stop.value)
    assert "begin a new run; nothing was measured" in str(stop.value)
    assert "--resume" not in str(stop.value)


class Begun(Companion):
    """Counts the steps that are begun."""

    steps = 0

    def happened(self, event):
        self.steps += isinstance(event, StepBegan)


def test_a_chamber_unplugged_in_the_sweep_stops_the_run_and_keeps_what_there_is(tmp_path):
    with formula_rig(tmp_path, sweep=SWEEP, chamber=chamber()) as (rig, experiment):

        class Unplug(Companion):
            def happened(self, event):
                if isinstance(event, StepBegan) and event.step == 4:
                    rig.chamber.stop()

        with pytest.raises(RigStopped, match=r"^chamber at .*no connection|^chamber at .*lost[^\n]*kept in"):
            run(experiment, tmp_path, companion=Unplug())
        assert not rig.device.status(rig.world.clock()[1]).running


def test_an_analog_channel_on_the_plate_counts_before_the_chamber(tmp_path):
    with formula_rig(tmp_path, sweep=SWEEP, chamber=chamber()) as (_, experiment):
        sensor = experiment.rig.channels.base.model_copy(update={"input": 5})
        channels = experiment.rig.channels.model_copy(update={"temperature": sensor})
        document = experiment.rig.model_copy(update={"channels": channels})
        finished = run(dataclasses.replace(experiment, rig=document), tmp_path)
    assert all(p.temperature_c == pytest.approx(0.0, abs=0.1) for p in finished.points)
    read = [e.value_c for e in events_of(finished.session) if isinstance(e, TemperatureRead)]
    assert read == pytest.approx([22.0] * len(read))


def test_a_set_point_without_a_chamber_is_refused_before_the_run(tmp_path):
    with (
        formula_rig(tmp_path, sweep=SWEEP, temperature=WANTED) as (_, experiment),
        pytest.raises(BadInput, match=r"temperature.set_point_c = 35: .*rig\.toml has no \[chamber\]"),
    ):
        run(experiment, tmp_path)


def test_a_set_point_for_a_thermometer_is_refused_before_the_run(tmp_path):
    with formula_rig(tmp_path, sweep=SWEEP, temperature=WANTED, chamber=chamber()) as (_, experiment):
        thermometer = experiment.rig.chamber.model_copy(update={"set_point_register": None})
        document = experiment.rig.model_copy(update={"chamber": thermometer})
        with pytest.raises(BadInput, match=r"\[chamber\] of .*rig\.toml is a thermometer"):
            run(dataclasses.replace(experiment, rig=document), tmp_path)
