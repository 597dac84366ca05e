import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.errors import Refused
from drivers.shaker.interface import Alarm
from drivers.simulated.drive import DrivePiece
from drivers.simulated.shaker_device import ShakerDevice


@pytest.fixture
def pieces():
    return []


@pytest.fixture
def device(pieces):
    return ShakerDevice(pieces.append, limit_v=5.0, heartbeat_timeout_s=2.0, emergency_ramp_s=0.1)


def running_at_2_v(device):
    """2 V at 50 Hz, standing still since 2 s."""
    device.start(0.0, wall_s=0.0)
    device.command(50.0, 2.0, 1.0, 0.0)
    device.advance(3.0)


def whats(device):
    return [entry.what for entry in device.log]


def test_ramp_begins_at_the_command_and_ends_at_its_exact_time(device, pieces):
    device.start(0.25)
    assert device.command(50.0, 2.0, 0.8, 0.5) == 2.0
    assert pieces == [DrivePiece(0.5, 50.0, 0.0, 0.8, 0.0)]
    assert device.status(1.0).ramping
    assert device.status(1.0).drive_v == pytest.approx(0.4)
    device.advance(7.3)
    _, still = pieces
    assert still.begin_s == 0.5 + 2.0 / 0.8
    assert (still.amplitude_v, still.slope_v_s) == (2.0, 0.0)
    assert not device.status(7.3).ramping
    assert device.status(7.3).drive_v == 2.0


def test_the_end_of_a_ramp_is_given_out_by_the_first_call_at_it(device, pieces):
    device.start(0.0)
    device.command(50.0, 2.0, 1.0, 0.0)
    device.advance(math.nextafter(2.0, 0.0))
    assert len(pieces) == 1
    device.advance(2.0)
    assert len(pieces) == 2


def test_a_new_frequency_amid_a_ramp_keeps_phase_and_amplitude(device, pieces):
    device.start(0.0)
    device.command(50.0, 2.0, 1.0, 0.0)
    device.command(73.7, 0.5, 4.0, 1.2345)
    before, after = pieces
    assert after.frequency_hz == 73.7
    assert after.amplitude_v == pytest.approx(1.2345)
    assert after.slope_v_s == -4.0
    turns = (after.phase_rad - before.phase_at(1.2345)) / math.tau
    assert turns == pytest.approx(round(turns), abs=1e-9)
    device.advance(9.0)
    assert pieces[-1].begin_s == pytest.approx(1.2345 + 0.7345 / 4.0, abs=1e-12)
    assert pieces[-1].amplitude_v == 0.5


def test_the_same_amplitude_again_needs_no_ramp(device, pieces):
    running_at_2_v(device)
    device.command(51.0, 2.0, 1.0, 3.0)
    assert (pieces[-1].amplitude_v, pieces[-1].slope_v_s) == (2.0, 0.0)
    assert not device.status(3.0).ramping


COMMANDS = st.lists(
    st.tuples(st.floats(0.0, 2.0), st.floats(1.0, 500.0), st.floats(0.0, 9.9), st.floats(0.1, 50.0)),
    min_size=1,
    max_size=8,
)


@given(COMMANDS, st.floats(0.0, 2.0))
def test_whatever_is_asked_the_drive_is_continuous_within_the_limit_and_ends_silent(commands, last):
    pieces = []
    device = ShakerDevice(pieces.append, limit_v=5.0)
    device.start(0.0)
    now = 0.0
    for pause, frequency, drive, ramp in commands:
        now += pause
        assert device.command(frequency, drive, ramp, now) == min(drive, 5.0)
        assert device.status(now).limited == (drive > 5.0)
    device.stop(now + last)
    device.advance(now + last + 60.0)
    for before, after in pairwise(pieces):
        assert before.begin_s <= after.begin_s
        assert before.amplitude_at(after.begin_s) == pytest.approx(after.amplitude_v, abs=1e-9)
        difference = after.phase_rad - before.phase_at(after.begin_s)
        assert math.remainder(difference, math.tau) == pytest.approx(0.0, abs=1e-8)
        assert -1e-12 <= after.amplitude_v <= 5.0
    if pieces:
        assert (pieces[-1].amplitude_v, pieces[-1].slope_v_s) == (0.0, 0.0)
    assert device.log[-1].what == "silent"
    assert device.log[-1].drive_v == 0.0


def test_the_device_holds_its_limit_and_says_so(device):
    device.start(0.0)
    assert device.command(50.0, 10.0, 100.0, 0.0) == 5.0
    status = device.status(1.0)
    assert status.limited
    assert status.drive_v == status.limit_v == 5.0
    device.command(50.0, 4.0, 100.0, 1.0)
    assert not device.status(1.0).limited


def test_asking_far_above_the_limit_is_an_alarm(device, pieces):
    running_at_2_v(device)
    with pytest.raises(Refused, match=r"10\.1 V is over 2 times the limit of 5 V"):
        device.command(50.0, 10.1, 1.0, 3.0)
    assert device.status(3.0).alarm is Alarm.OVERDRIVE
    assert device.status(3.1).drive_v == 0.0
    assert pieces[-1] == DrivePiece(3.1, 50.0, 0.0, 0.0, pieces[-1].phase_rad)
    device.reset_alarm(3.2)
    assert device.status(3.2).alarm is Alarm.NONE


def test_nothing_comes_out_before_a_start(device, pieces):
    with pytest.raises(Refused, match="start first"):
        device.command(50.0, 1.0, 1.0, 0.0)
    assert pieces == []
    device.start(1.0)
    assert device.status(1.0).drive_v == 0.0
    assert pieces == []


def test_stop_is_at_rest_in_time_however_gently_the_last_command_ramped(device, pieces):
    running_at_2_v(device)
    device.stop(3.0)
    device.stop(3.02)
    status = device.status(3.05)
    assert not status.running
    assert status.ramping
    assert status.drive_v == pytest.approx(1.0)
    device.stop(5.5)
    assert [p.begin_s for p in pieces] == pytest.approx([0.0, 2.0, 3.0, 3.1])
    assert whats(device) == ["started", "command 50 Hz 2 V at 1 V/s", "ramp ended", "stopped", "silent"]


def test_stop_at_the_very_sample_of_a_command_leaves_no_drive_behind(device, pieces):
    device.start(0.0)
    device.command(50.0, 2.0, 1.0, 1.0)
    device.stop(1.0)
    device.advance(10.0)
    assert device.status(10.0).drive_v == 0.0
    assert (pieces[-1].amplitude_v, pieces[-1].slope_v_s) == (0.0, 0.0)


def test_an_alarm_at_the_very_sample_of_a_command_leaves_no_drive_behind(device, pieces):
    device.start(0.0)
    device.command(50.0, 2.0, 1.0, 1.0)
    device.trip_amplifier(1.0)
    assert (pieces[-1].amplitude_v, pieces[-1].slope_v_s) == (0.0, 0.0)
    assert whats(device)[-1] == "silent"


def test_a_heartbeat_gone_stale_silences(device):
    running_at_2_v(device)
    device.check_heartbeat(wall_s=2.0, now_s=3.0)
    assert device.status(3.0).alarm is Alarm.NONE
    device.check_heartbeat(wall_s=2.01, now_s=3.0)
    assert device.status(3.0).alarm is Alarm.HEARTBEAT
    device.advance(3.2, wall_s=2.2)
    alarm, silent = device.log[-2:]
    assert (alarm.what, alarm.now_s, alarm.drive_v, alarm.wall_s) == ("alarm HEARTBEAT", 3.0, 2.0, 2.01)
    assert (silent.what, silent.now_s, silent.drive_v, silent.wall_s) == ("silent", 3.1, 0.0, 2.2)


def test_beats_keep_it_running(device):
    running_at_2_v(device)
    for wall_s in (1.5, 3.0, 4.5):
        device.beat(wall_s)
        device.check_heartbeat(wall_s + 1.9, 3.0)
    assert device.status(3.0).running


def test_the_heartbeat_counts_only_while_running(device):
    device.check_heartbeat(wall_s=1000.0, now_s=0.0)
    device.start(0.0, wall_s=1000.0)
    device.check_heartbeat(wall_s=1001.9, now_s=0.0)
    assert device.status(0.0).running
    device.stop(0.0)
    device.check_heartbeat(wall_s=2000.0, now_s=0.0)
    assert device.status(0.0).alarm is Alarm.NONE


def test_a_start_without_wall_time_is_given_the_whole_timeout(device):
    device.start(0.0)
    device.check_heartbeat(wall_s=500.0, now_s=0.0)
    device.check_heartbeat(wall_s=501.9, now_s=0.0)
    assert device.status(0.0).running
    device.check_heartbeat(wall_s=502.1, now_s=0.0)
    assert device.status(0.0).alarm is Alarm.HEARTBEAT


def stale(device, now_s):
    device.check_heartbeat(1e6, now_s)


CAUSES = {
    Alarm.HEARTBEAT: (stale, lambda d, now_s: d.beat(1e6)),
    Alarm.INTERLOCK: (ShakerDevice.open_interlock, ShakerDevice.close_interlock),
    Alarm.AMPLIFIER: (ShakerDevice.trip_amplifier, ShakerDevice.restore_amplifier),
}


@pytest.mark.parametrize("alarm", CAUSES)
def test_an_alarm_stays_until_its_cause_is_gone_and_it_is_reset(device, alarm):
    cause, remedy = CAUSES[alarm]
    running_at_2_v(device)
    cause(device, 3.0)
    assert device.status(3.05).drive_v == pytest.approx(1.0)
    status = device.status(3.1)
    assert (status.alarm, status.running, status.drive_v) == (alarm, False, 0.0)
    with pytest.raises(Refused, match=f"alarm {alarm.name} stays"):
        device.reset_alarm(3.2)
    remedy(device, 3.3)
    assert device.status(3.3).alarm is alarm
    with pytest.raises(Refused, match="reset it first"):
        device.start(3.4)
    device.reset_alarm(3.5)
    with pytest.raises(Refused, match="start first"):
        device.command(50.0, 1.0, 1.0, 3.6)
    device.start(3.7)
    assert device.status(3.7).drive_v == 0.0
    assert device.command(50.0, 1.0, 1.0, 3.8) == 1.0


def test_without_an_emergency_ramp_the_drive_is_zero_at_once(pieces):
    device = ShakerDevice(pieces.append, emergency_ramp_s=0.0)
    running_at_2_v(device)
    device.trip_amplifier(3.0)
    assert (pieces[-1].begin_s, pieces[-1].amplitude_v, pieces[-1].slope_v_s) == (3.0, 0.0, 0.0)
    assert (device.log[-1].what, device.log[-1].drive_v) == ("silent", 0.0)


def test_an_alarm_overtakes_a_slow_stop(device):
    running_at_2_v(device)
    device.stop(3.0)
    device.open_interlock(3.05)
    assert device.status(3.16).drive_v == 0.0
    assert device.status(3.16).alarm is Alarm.INTERLOCK


def test_an_interlock_opened_at_rest_refuses_the_start_and_latches_nothing(device):
    device.open_interlock(0.0)
    status = device.status(0.0)
    assert status.interlock_open
    assert status.alarm is Alarm.NONE
    with pytest.raises(Refused, match="the interlock is open"):
        device.start(0.0)
    device.close_interlock(0.0)
    device.start(0.0)


def test_the_first_alarm_names_the_cause_and_every_cause_must_go(device):
    running_at_2_v(device)
    device.trip_amplifier(3.0)
    device.open_interlock(3.0)
    device.restore_amplifier(3.2)
    assert device.status(3.2).alarm is Alarm.AMPLIFIER
    with pytest.raises(Refused, match="the interlock is open"):
        device.reset_alarm(3.2)


def test_stop_in_an_alarm_changes_nothing(device, pieces):
    running_at_2_v(device)
    device.trip_amplifier(3.0)
    before = list(pieces)
    device.stop(3.05)
    assert pieces == before
    assert device.status(3.05).alarm is Alarm.AMPLIFIER


def test_sample_time_does_not_go_back(device):
    device.advance(2.0)
    with pytest.raises(ValueError, match=r"went back from 2 s to 1\.9 s"):
        device.advance(1.9)


@pytest.mark.parametrize("timeout_s", [0.0, -1.0, 61.0, math.nan])
def test_a_senseless_heartbeat_timeout_is_refused(device, timeout_s):
    with pytest.raises(Refused, match="heartbeat_timeout_s"):
        device.set_heartbeat_timeout(timeout_s)
    assert device.heartbeat_timeout_s == 2.0
