import re

import pytest

from drivers.errors import Garbled, Refused
from drivers.shaker import Alarm, Shaker, ShakerStatus
from drivers.shaker.modbus import ModbusShaker
from drivers.shaker.register_map import DEFAULT

DEADLINE_S = 5.0
IDLE = ShakerStatus(False, False, False, False, Alarm.NONE, 0.0, 0.0, 5.0)


def test_a_run_from_start_to_silence(wired):
    rig, shaker = wired
    assert shaker.identity() == "simulated shaker 1.0, serial number 1"
    assert shaker.status() == IDLE
    shaker.start()
    assert shaker.status().running
    rig.pass_time(0.2)
    echo = shaker.command(50.0, 2.0, 4.0)
    assert (echo.sequence, echo.sample, echo.drive_v) == (1, 1000, 2.0)
    assert rig.pieces[0].begin_s == 0.2
    rig.pass_time(0.25)
    assert shaker.status() == ShakerStatus(True, True, False, False, Alarm.NONE, 1.0, 50.0, 5.0)
    rig.pass_time(0.25)
    assert shaker.status() == ShakerStatus(True, False, False, False, Alarm.NONE, 2.0, 50.0, 5.0)
    assert shaker.command(60.0, 7.0, 4.0).drive_v == 5.0
    assert shaker.status().limited
    shaker.stop()
    shaker.stop()
    rig.pass_time(1.0)
    assert shaker.status() == ShakerStatus(False, False, False, False, Alarm.NONE, 0.0, 60.0, 5.0)
    assert rig.whats()[-2:] == ["stopped", "silent"]


def test_it_is_a_shaker(shaker):
    shaker_of_any_make: Shaker = shaker
    assert isinstance(shaker_of_any_make, ModbusShaker)


def test_each_command_has_a_number_of_its_own_also_from_another_connection(rig, shaker):
    rig.set_running(shaker)
    other = ModbusShaker.tcp(*rig.server.address)
    assert [other.command(50.0, 1.0, 4.0).sequence for _ in range(3)] == [2, 3, 4]
    other.close()


def test_stop_works_from_another_connection_at_rest_and_in_an_alarm(rig, shaker):
    shaker.stop()
    rig.set_running(shaker)
    rig.device.trip_amplifier(rig.sample / 5000.0)
    shaker.stop()
    assert shaker.status().alarm is Alarm.AMPLIFIER


def test_stop_needs_nothing_but_the_control_word(rig, shaker):
    rig.set_running(shaker)
    elsewhere = DEFAULT.with_addresses({"alarm": 7000, "map_version": 7001, "echo_sequence": 7002})
    other = ModbusShaker.tcp(*rig.server.address, registers=elsewhere)
    with pytest.raises(Refused):
        other.status()
    other.stop()
    assert rig.whats()[-1] == "stopped"
    other.close()


def test_without_beats_the_device_silences_itself(wired):
    rig, shaker = wired
    shaker.set_heartbeat_timeout_s(1.5)
    assert shaker.heartbeat_timeout_s() == 1.5
    rig.set_running(shaker)
    for _ in range(3):
        shaker.beat()
        rig.pass_wall_time(1.4)
    assert shaker.status().running
    rig.pass_wall_time(0.2)
    rig.pass_time(0.2)
    alarm, silent = rig.device.log[-2:]
    assert (alarm.what, alarm.wall_s, alarm.drive_v) == ("alarm HEARTBEAT", rig.wall_s, 2.0)
    assert (silent.what, silent.drive_v) == ("silent", 0.0)
    assert shaker.status().alarm is Alarm.HEARTBEAT


def test_an_alarm_is_reset_when_its_cause_is_gone(rig, shaker):
    rig.set_running(shaker)
    rig.pass_wall_time(2.1)
    with pytest.raises(Refused, match=r"exception 7 \(NEGATIVE_ACKNOWLEDGE\).* alarm HEARTBEAT is latched"):
        shaker.reset_alarm()
    shaker.beat()
    shaker.reset_alarm()
    assert shaker.status().alarm is Alarm.NONE
    assert not shaker.status().running
    shaker.start()


def test_resetting_no_alarm_does_not_stop(rig, shaker):
    rig.set_running(shaker)
    shaker.reset_alarm()
    assert shaker.status().running


def test_start_is_refused_naming_the_alarm(rig, shaker):
    rig.device.trip_amplifier(0.0)
    with pytest.raises(Refused, match="does not start: alarm AMPLIFIER is latched"):
        shaker.start()


def test_start_is_refused_naming_the_interlock(rig, shaker):
    rig.device.open_interlock(0.0)
    with pytest.raises(Refused, match="does not start: the interlock is open"):
        shaker.start()


def test_start_is_refused_where_the_drive_limit_s_words_are_exchanged(rig, shaker):
    rig.device.limit_v = 2.3183e-41
    with pytest.raises(
        Refused, match=r"does not start: its limit_v is 2\.32e-41 V.*exchanged 5: word order\?"
    ):
        shaker.start()
    assert rig.whats() == []


def test_a_command_at_rest_is_refused_with_the_exception_and_the_reason(rig, shaker):
    with pytest.raises(Refused) as refusal:
        shaker.command(50.0, 1.0, 1.0)
    here = re.escape("{}:{}".format(*rig.server.address))
    assert re.fullmatch(
        rf"shaker at {here} unit 1, writing command: refused with Modbus exception 7 "
        r"\(NEGATIVE_ACKNOWLEDGE\): output is not allowed: start first",
        str(refusal.value),
    )


def test_an_overdrive_is_refused_and_silences(rig, shaker):
    rig.set_running(shaker)
    with pytest.raises(Refused, match="alarm OVERDRIVE is latched"):
        shaker.command(50.0, 10.5, 1.0)
    rig.pass_time(0.1)
    assert shaker.status().drive_v == 0.0


def test_a_senseless_command_is_not_sent(rig, shaker):
    rig.set_running(shaker)
    with pytest.raises(Refused, match=r"shaker at .*, command not sent: frequency_hz = nan"):
        shaker.command(float("nan"), 1.0, 1.0)
    with pytest.raises(Refused, match="heartbeat_timeout_s = 0"):
        shaker.set_heartbeat_timeout_s(0.0)
    assert len(rig.pieces) == 2


MOVED = DEFAULT.with_addresses(
    {
        "frequency_hz": 4000,
        "drive_v": 4002,
        "ramp_v_s": 4004,
        "command_sequence": 4006,
        "echo_sample": 100,
        "echo_sequence": 65535,
        "limit_v": 7000,
        "control": 0,
    }
)


def test_registers_that_lie_elsewhere(make_rig):
    rig = make_rig(MOVED)
    with rig.server:
        shaker = ModbusShaker.tcp(*rig.server.address, registers=MOVED)
        rig.set_running(shaker)
        rig.pass_time(0.5)
        assert shaker.command(60.0, 3.0, 4.0).sample == 7500
        assert shaker.status().limit_v == 5.0
        shaker.close()


def test_registers_that_are_not_there_are_refused_with_the_exception(rig):
    shaker = ModbusShaker.tcp(*rig.server.address, registers=MOVED)
    with pytest.raises(
        Refused, match=r"reading limit_v: refused with Modbus exception 2 \(ILLEGAL_ADDRESS\)"
    ):
        shaker.status()
    shaker.close()


def test_another_map_version_is_told(rig):
    elsewhere = DEFAULT.with_addresses({"map_version": 28, "echo_sequence": 40})
    shaker = ModbusShaker.tcp(*rig.server.address, registers=elsewhere)
    with pytest.raises(Garbled, match=r"shaker at .*, map_version: 1 expected, 0 came"):
        shaker.start()
    assert rig.whats() == []
    shaker.close()


def test_a_watchdog_that_keeps_another_time_is_refused(rig, shaker):
    rig.device.set_heartbeat_timeout = lambda timeout_s: None
    with pytest.raises(Refused, match="5 was asked, the device keeps 2: its watchdog is off"):
        shaker.set_heartbeat_timeout_s(5.0)
