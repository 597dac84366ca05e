"""Whole runs over the real wires: what is measured, what a fault does, what is kept."""

import os
import signal
import threading
import time
from collections.abc import Callable

import h5py
import pytest
from formula_rig import formula_rig, gain
from quick_run import no_fit
from run_at_point import RunAtPoint
from sessions import events_of, points_of

from drivers.simulated.rig import SimulatedRig
from instrument.cli.stopping import safe_stop
from instrument.errors import NOT_SILENT, RigStopped
from instrument.run.companion import Companion
from instrument.run.control import RunControl
from instrument.run.experiment import run_experiment
from instrument.run.replay import replay
from instrument.session import storage
from instrument.session.storage import SessionFile
from instrument.stream.raw import SessionEnded, StepBegan

HEARTBEAT_S = 2.0


def run(experiment, folder, parts, **options):
    return run_experiment(experiment, folder, parts, fit=no_fit, **options)


def test_a_sweep_measures_every_step_at_its_level(tmp_path):
    with formula_rig(tmp_path) as (rig, experiment):
        finished = run(experiment, tmp_path, ("sweep",))
    assert len(finished.points) == 15
    assert all(abs(p.control_error_percent) < 1.0 for p in finished.points)
    for p in finished.points:
        exact = gain("velocity", p.frequency_hz) / gain("base_acceleration", p.frequency_hz)
        assert abs(p.velocity_m_s / p.base_m_s2) == pytest.approx(abs(exact), rel=2e-3)
    assert rig.device.log[-1].what == "silent"


def test_live_equals_replay_to_the_bit(tmp_path):
    with formula_rig(tmp_path, hammer=True) as (_, experiment):
        finished = run(experiment, tmp_path, ("hammer", "sweep"))
    with SessionFile(finished.session) as file:
        again = replay(file, fit=no_fit)
    assert again.differences == []
    assert again.derived > 30
    assert again.fit == finished.fit


def test_a_replay_notices_a_single_changed_sample(tmp_path):
    with formula_rig(tmp_path) as (_, experiment):
        finished = run(experiment, tmp_path, ("sweep",))
    with h5py.File(finished.session, "r+") as file:
        last = [name for name in sorted(file["parts"]) if "samples" in file["parts"][name]][-1]
        file["parts"][last]["samples"][0, -1] += 1000
    with SessionFile(finished.session) as file:
        assert not replay(file, fit=no_fit).equal


FAULTS: dict[str, tuple[Callable[[SimulatedRig], None], str]] = {
    "interlock opened": (lambda rig: _locked(rig, rig.device.open_interlock), "(?i)interlock"),
    "amplifier tripped": (lambda rig: _locked(rig, rig.device.trip_amplifier), "(?i)amplifier"),
    "modbus dropped": (lambda rig: rig.modbus.stop(), "shaker|Modbus|127.0.0.1"),
    "stream cut": (lambda rig: rig.front_end.cut_stream(), "stream|LAN-XI"),
    "stream garbled": (lambda rig: rig.front_end.garbage(), "LAN-XI|BK"),
    "samples lost": (lambda rig: rig.front_end.lose(100), "lost|missing|gap"),
    "vibrometer unplugged": (lambda rig: rig.vibrometer.unplug(), "vibrometer|Polytec"),
    "vibrometer silent": (
        lambda rig: setattr(rig.vibrometer.faults, "silent_replies", 100),
        "vibrometer|Polytec",
    ),
}


def _locked(rig: SimulatedRig, do: Callable[[float], None]) -> None:
    with rig.world.lock:
        do(rig.world.clock()[1])


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_stops_the_run_silently_with_everything_complete_kept(tmp_path, name):
    fault, said = FAULTS[name]
    when = []
    with formula_rig(tmp_path) as (rig, experiment):

        def strike():
            when.append(time.monotonic())
            fault(rig)

        with pytest.raises(RigStopped, match=said) as stopped:
            run(experiment, tmp_path, ("sweep",), companion=RunAtPoint(3, strike))
        _wait_until_silent(rig)
    assert "\n" not in str(stopped.value)
    silent = [e for e in rig.device.log if e.what == "silent"][-1]
    assert rig.device.log[-1].drive_v == 0.0
    if silent.wall_s is not None:
        assert silent.wall_s - when[0] < HEARTBEAT_S + 0.5
    (session,) = tmp_path.glob("*.h5")
    assert len(points_of(session)) >= 3
    (ended,) = [e for e in events_of(session) if isinstance(e, SessionEnded)]
    # Nobody hears from a shaker whose line is gone, silent as it is here.
    assert ended.why == (NOT_SILENT if name == "modbus dropped" else "stopped safely")


def _wait_until_silent(rig):
    deadline = time.monotonic() + HEARTBEAT_S + 2
    while time.monotonic() < deadline:
        with rig.world.lock:
            status = rig.device.status(rig.world.clock()[1])
        if status.drive_v == 0 and not status.running:
            return
        time.sleep(0.01)
    pytest.fail("the shaker is still driven")


def test_serial_garbage_is_got_over(tmp_path):
    with formula_rig(tmp_path) as (rig, experiment):

        def strike():
            rig.vibrometer.faults.garbled_replies = 1

        finished = run(experiment, tmp_path, ("sweep",), companion=RunAtPoint(3, strike))
    assert len(finished.points) == 15


def test_an_overload_repeats_the_step_in_a_coarser_range(tmp_path):
    sweep = '[[sweep.segments]]\nlow_hz = 95.0\nhigh_hz = 107.0\npoints = 5\nrange = "5mm/s/V"\n'
    with formula_rig(tmp_path, sweep=sweep.replace("95.0", "18.0").replace("107.0", "21.0")) as (
        _,
        experiment,
    ):
        finished = run(experiment, tmp_path, ("sweep",))
    assert len(finished.points) == 5
    assert {p.range_name for p in finished.points} != {"5mm/s/V"}


def test_an_abort_ends_the_run_and_a_resume_measures_only_what_is_missing(tmp_path):
    control = RunControl()
    with formula_rig(tmp_path) as (_, experiment):
        with pytest.raises(RigStopped, match="enough for today"):
            run(
                experiment,
                tmp_path,
                ("sweep",),
                control=control,
                companion=RunAtPoint(6, lambda: control.abort("enough for today")),
            )
        (folder,) = tmp_path.glob("*.running")
        (session,) = tmp_path.glob("*.h5")
        first = [p.frequency_hz for p in points_of(session)]
        finished = run(experiment, tmp_path, ("sweep",), resume=folder)
    frequencies = [p.frequency_hz for p in points_of(finished.session)]
    assert len(first) >= 6
    assert frequencies[: len(first)] == first
    assert len(frequencies) == len(set(frequencies)) == 15
    with SessionFile(finished.session) as file:
        assert replay(file, fit=no_fit).differences == []


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_no_signal_breaks_off_the_keeping_of_a_run_that_ended_by_itself(tmp_path, monkeypatch, number):
    control = RunControl()
    interrupted_as_it_is_put_together(monkeypatch, number)
    with formula_rig(tmp_path) as (_, experiment):
        end = RunAtPoint(3, lambda: control.abort("enough"))
        with pytest.raises(RigStopped, match=r"^enough; 3 steps kept in .*; to go on: "), safe_stop(control):
            run(experiment, tmp_path, ("sweep",), control=control, companion=end)
    assert len(list(tmp_path.glob("*.h5"))) == 1
    assert not list(tmp_path.glob("*.tmp"))


def test_a_ctrl_c_once_all_is_measured_leaves_a_whole_session(tmp_path, monkeypatch):
    control = RunControl()
    interrupted_as_it_is_put_together(monkeypatch, signal.SIGINT)
    with formula_rig(tmp_path) as (_, experiment), safe_stop(control):
        finished = run(experiment, tmp_path, ("sweep",), control=control)
    assert len(finished.points) == 15
    assert not list(tmp_path.glob("*.running"))


def test_whoever_insists_while_a_session_is_put_together_hears_why_it_ended_and_where_it_is(
    tmp_path, monkeypatch
):
    monkeypatch.setattr("instrument.cli.stopping._INSISTS_S", 0.0)
    control = RunControl()
    interrupted_as_it_is_put_together(monkeypatch, signal.SIGINT)
    with formula_rig(tmp_path) as (_, experiment):
        end = RunAtPoint(3, lambda: control.abort("enough"))
        with pytest.raises(RigStopped) as stopped, safe_stop(control):
            run(experiment, tmp_path, ("sweep",), control=control, companion=end)
    (folder,) = tmp_path.glob("*.running")
    said = f"enough; what is complete is in {folder}: viscorig recover {folder}"
    assert str(stopped.value) == said
    assert not list(tmp_path.glob("*.h5"))
    assert not list(tmp_path.glob("*.tmp"))


def interrupted_as_it_is_put_together(monkeypatch, number):
    honest = storage._put_together

    def put(*parts):
        honest(*parts)
        os.kill(os.getpid(), number)

    monkeypatch.setattr(storage, "_put_together", put)


def test_a_hold_silences_and_resuming_goes_on(tmp_path):
    control = RunControl()
    drives = []
    with formula_rig(tmp_path) as (rig, experiment):

        def hold_and_look():
            control.hold()

            def look():
                _wait_until_silent(rig)
                drives.append(rig.device.status(rig.world.clock()[1]).drive_v)
                control.resume()

            threading.Thread(target=look).start()

        finished = run(
            experiment, tmp_path, ("sweep",), control=control, companion=RunAtPoint(3, hold_and_look)
        )
    assert drives == [0.0]
    assert len(finished.points) == 15


def test_a_watcher_that_fails_does_not_stop_the_measurement(tmp_path):
    def fail(events):
        raise ValueError("a plot went wrong")

    with formula_rig(tmp_path) as (_, experiment):
        finished = run(experiment, tmp_path, ("sweep",), watch=fail)
    assert len(finished.points) == 15


def test_a_step_that_a_person_declines_is_left_out_for_good(tmp_path):
    with formula_rig(tmp_path) as (_, experiment):
        control, stop = RunControl(), RunControl()
        first = run(
            experiment, tmp_path, ("sweep",), control=control, companion=AtStep(98.0, control.decline)
        )
        assert len(first.points) == 14
        assert 98.0 not in [p.frequency_hz for p in first.points]
        both = AtStep(98.0, stop.decline), RunAtPoint(5, lambda: stop.abort("broken off"))
        with pytest.raises(RigStopped, match="broken off"):
            run(experiment, tmp_path, ("sweep",), control=stop, companion=Both(both))
        (folder,) = tmp_path.glob("*.running")
        carried_on = run(experiment, tmp_path, ("sweep",), resume=folder)
    kept = [p.frequency_hz for p in carried_on.points]
    assert kept == [p.frequency_hz for p in first.points]
    with SessionFile(carried_on.session) as file:
        assert replay(file, fit=no_fit).differences == []


class AtStep(Companion):
    """Does something as soon as a step at a frequency has begun."""

    def __init__(self, frequency_hz, do):
        self._frequency_hz, self._do = frequency_hz, do

    def happened(self, event):
        step = isinstance(event, StepBegan) and event.purpose == "step"
        if step and event.frequency_hz == self._frequency_hz:
            self._do()


class Both(Companion):
    """Told of everything, each of them."""

    def __init__(self, each):
        self._each = each

    def happened(self, event):
        for one in self._each:
            one.happened(event)
