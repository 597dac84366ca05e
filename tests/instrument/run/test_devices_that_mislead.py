"""Instruments that answer well and do something else: no step of theirs counts, and the shaker is silent."""

import time
from dataclasses import replace

import numpy as np
import pytest
from engine_cases import is_silent
from formula_rig import formula_rig, gain
from quick_run import run
from run_at_point import RunAtPoint
from sessions import points_of

from drivers.errors import DriverError
from drivers.simulated.lan_xi_measurement import Acquired
from drivers.vibrometer.polytec_vibrometer import PolytecVibrometer
from instrument.errors import RigStopped, StoppedByUser
from instrument.run import watching
from instrument.run.companion import Companion
from instrument.run.control import RunControl
from instrument.session.configuration import read_whole_experiment
from instrument.stream.derived import StepSettled


def points_in(folder):
    (session,) = folder.glob("*.h5")
    return points_of(session)


def all_are_right(points):
    return all(
        abs(p.velocity_m_s / p.base_m_s2)
        == pytest.approx(
            abs(gain("velocity", p.frequency_hz) / gain("base_acceleration", p.frequency_hz)), rel=2e-3
        )
        for p in points
    )


def change_range(rig):
    """As a hand at the panel does."""
    with rig.world.lock:
        rig.vibrometer.head.range_name = "50mm/s/V"
        rig.world.laser.scale_m_s_v = 0.05


def switch_off(rig):
    with rig.world.lock:
        rig.device.stop(rig.world.clock()[1])


def drive_at(rig, factor):
    """From now on it makes another frequency than it is told."""
    honest = rig.device.command
    rig.device.command = lambda f, *rest: honest(factor * f, *rest)


def say_that_it_runs_at(rig, factor):
    """From now on its status names another frequency than the one that it makes."""
    honest = rig.device.status

    def status(*now):
        told = honest(*now)
        return replace(told, frequency_hz=factor * told.frequency_hz)

    rig.device.status = status


def drive_at_unsaid(rig, factor):
    """From now on it makes another frequency than it is told, and its status names the one it was told."""
    drive_at(rig, factor)
    say_that_it_runs_at(rig, 1 / factor)


def loosen_cable(rig):
    """The module flags the base's input from now on."""
    acquire = rig.world.acquire

    def with_fault(samples):
        found = acquire(samples)
        fault = found.cable_fault.copy()
        fault[0] = True
        return Acquired(found.first_sample, found.counts, found.overload, fault)

    rig.world.acquire = with_fault


def hold_velocity(rig):
    """The velocity's input reads the same count from now on, as with a cable that is off."""
    acquire = rig.world.acquire

    def with_a_dead_input(samples):
        found = acquire(samples)
        counts = found.counts.copy()
        counts[1] = 12345
        return replace(found, counts=counts)

    rig.world.acquire = with_a_dead_input


def lose_velocity_in_noise(rig):
    """The velocity's input reads noise from now on, as with a beam that is off its spot."""
    acquire, random = rig.world.acquire, np.random.default_rng(1)

    def with_noise(samples):
        found = acquire(samples)
        counts = found.counts.copy()
        counts[1] = random.integers(-(2**16), 2**16, counts.shape[1])
        return replace(found, counts=counts)

    rig.world.acquire = with_noise


MISLEADS = {
    "a velocity that stands still": (hold_velocity, "velocity lost: readings in a row"),
    "its range changed by hand": (change_range, "range is 50mm/s/V, it was set to"),
    "switched off at its panel": (switch_off, "switched off by somebody|output is not allowed"),
    "another frequency by its word alone": (
        lambda rig: say_that_it_runs_at(rig, 1.01),
        "says that it runs at",
    ),
    "another frequency by the clock alone": (lambda rig: drive_at_unsaid(rig, 1.01), "front-end's clock"),
}


@pytest.mark.parametrize("name", MISLEADS)
def test_what_misleads_ends_the_run_before_it_counts(tmp_path, monkeypatch, name):
    mislead, said = MISLEADS[name]
    # The shaker is asked between any two blocks, however fast this computer makes them.
    monkeypatch.setattr(watching, "BEAT_S", 0.0)
    with formula_rig(tmp_path) as (rig, experiment):
        with pytest.raises(RigStopped, match=said):
            run(experiment, tmp_path, companion=RunAtPoint(3, lambda: mislead(rig)))
        assert is_silent(rig)
    points = points_in(tmp_path)
    assert 3 <= len(points) < 6
    assert all_are_right(points)


def test_a_velocity_that_is_noise_ends_the_run_and_its_points_say_so(tmp_path):
    with formula_rig(tmp_path) as (rig, experiment):
        with pytest.raises(RigStopped, match="velocity lost: points in a row within its own noise"):
            run(experiment, tmp_path, companion=RunAtPoint(3, lambda: lose_velocity_in_noise(rig)))
        assert is_silent(rig)
    noisy = [any("within its noise" in r for r in p.remarks) for p in points_in(tmp_path)]
    assert not any(noisy[:3])
    assert noisy.count(True) >= 5


class AtSettled(Companion):
    """Does something once a step of a number has settled: what is read next would be its point."""

    def __init__(self, number, do):
        self._left, self._do = number, do

    def happened(self, event):
        if isinstance(event, StepSettled):
            self._left -= 1
            if self._left == 0:
                self._do()


def test_a_dwell_in_which_a_cable_came_loose_is_no_point(tmp_path):
    with formula_rig(tmp_path) as (rig, experiment):
        with pytest.raises(RigStopped, match="cable fault on base"):
            run(experiment, tmp_path, companion=AtSettled(4, lambda: loosen_cable(rig)))
        assert is_silent(rig)
    assert len(points_in(tmp_path)) == 3


@pytest.mark.parametrize(
    "took", [lambda drive_v: 0.0, lambda drive_v: 1.01 * drive_v, lambda drive_v: 1.5 * drive_v]
)
def test_a_receipt_of_another_drive_ends_the_run(tmp_path, took):
    with formula_rig(tmp_path) as (rig, experiment):
        honest = rig.device.command
        rig.device.command = lambda f, v, *rest: took(honest(f, v, *rest))
        with pytest.raises(RigStopped, match=r"took 0\.1 V for"):
            run(experiment, tmp_path)
        assert is_silent(rig)


def test_a_step_beyond_what_its_range_reads_is_not_measured(tmp_path, monkeypatch):
    chosen = PolytecVibrometer.set_range

    def with_a_filter(self, name):
        return replace(chosen(self, name), highest_hz=100.0)

    monkeypatch.setattr(PolytecVibrometer, "set_range", with_a_filter)
    with formula_rig(tmp_path) as (rig, experiment):
        with pytest.raises(RigStopped, match=r"101 Hz: the vibrometer's range .* reads up to 100 Hz"):
            run(experiment, tmp_path)
        assert is_silent(rig)
    assert max(p.frequency_hz for p in points_in(tmp_path)) < 100.0


def test_drivers_errors_are_still_told_first(tmp_path):
    def unplug(rig):
        rig.vibrometer.unplug()

    with formula_rig(tmp_path) as (rig, experiment), pytest.raises(RigStopped) as stopped:
        run(experiment, tmp_path, companion=RunAtPoint(3, lambda: unplug(rig)))
    assert isinstance(stopped.value.__cause__, DriverError)
    assert "AMPLIFIER" not in str(stopped.value)


def test_a_sensor_turned_round_ends_a_calibration(tmp_path):
    with formula_rig(tmp_path) as (rig, experiment):
        text = experiment.path.read_text().replace("calibration = false\n", "")
        experiment.path.write_text(text)
        sensor = rig.world.wiring.inputs[1]
        rig.world.wiring.inputs[1] = replace(sensor, volts_per_unit=-sensor.volts_per_unit)
        with pytest.raises(RigStopped, match=r"no delay explains.*invert = true"):
            run(read_whole_experiment(experiment.path), tmp_path)
        assert is_silent(rig)


def test_a_stop_of_the_user_that_python_lost_is_heard_between_blocks(tmp_path):
    """An exception raised in a destructor or a weak reference's callback goes nowhere."""
    control = RunControl()
    with formula_rig(tmp_path) as (rig, experiment):
        with pytest.raises(StoppedByUser, match="3 steps kept"):
            run(experiment, tmp_path, control=control, companion=RunAtPoint(3, control.interrupt))
        assert is_silent(rig)


def drive(rig):
    with rig.world.lock:
        now_s = rig.world.clock()[1]
        rig.device.start(now_s, time.monotonic())
        rig.device.command(50.0, 0.5, 100.0, now_s)


def test_a_rig_that_another_program_drives_is_left_to_it(tmp_path, monkeypatch):
    monkeypatch.setattr("instrument.run.rig._MARGIN_S", -1.9)
    with formula_rig(tmp_path, virtual=False) as (rig, experiment):
        drive(rig)
        with pytest.raises(RigStopped, match="another program uses this rig"):
            run(experiment, tmp_path)
        with rig.world.lock:
            assert rig.device.status(rig.world.clock()[1]).drive_v > 0


def test_the_shaker_of_a_program_that_was_killed_is_waited_out(tmp_path):
    with formula_rig(tmp_path, heartbeat_timeout_s=0.5) as (rig, experiment):
        drive(rig)
        assert len(run(experiment, tmp_path).points) == 15
