import itertools
import re
import socket
import struct
import threading
import time

import pytest

from drivers.errors import Garbled, Refused, TimedOut, Unreachable
from drivers.shaker.interface import Alarm, Shaker, ShakerStatus
from drivers.shaker.modbus import ModbusShaker
from drivers.shaker.register_map import DEFAULT

DEADLINE_S = 5.0
IDLE = ShakerStatus(False, False, False, False, Alarm.NONE, 0.0, 0.0, 5.0)


def running(rig, shaker):
    """2 V at 50 Hz, standing still."""
    shaker.start()
    shaker.command(50.0, 2.0, 4.0)
    rig.pass_time(1.0)


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
    running(rig, shaker)
    other = ModbusShaker.tcp(*rig.server.address)
    assert [other.command(50.0, 1.0, 4.0).sequence for _ in range(3)] == [2, 3, 4]
    other.close()


def test_stop_works_from_another_connection_at_rest_and_in_an_alarm(rig, shaker):
    shaker.stop()
    running(rig, shaker)
    rig.device.trip_amplifier(rig.sample / 5000.0)
    shaker.stop()
    assert shaker.status().alarm is Alarm.AMPLIFIER


def test_stop_needs_nothing_but_the_control_word(rig, shaker):
    running(rig, shaker)
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
    running(rig, shaker)
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
    running(rig, shaker)
    rig.pass_wall_time(2.1)
    with pytest.raises(Refused, match=r"exception 7 \(NEGATIVE_ACKNOWLEDGE\).* alarm HEARTBEAT is latched"):
        shaker.reset_alarm()
    shaker.beat()
    shaker.reset_alarm()
    assert shaker.status().alarm is Alarm.NONE
    assert not shaker.status().running
    shaker.start()


def test_resetting_no_alarm_does_not_stop(rig, shaker):
    running(rig, shaker)
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
    running(rig, shaker)
    with pytest.raises(Refused, match="alarm OVERDRIVE is latched"):
        shaker.command(50.0, 10.5, 1.0)
    rig.pass_time(0.1)
    assert shaker.status().drive_v == 0.0


def test_a_senseless_command_is_not_sent(rig, shaker):
    running(rig, shaker)
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
        running(rig, shaker)
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


def test_a_server_that_comes_back_is_found_again_and_stopped(rig, shaker):
    running(rig, shaker)
    rig.server.stop()
    rig.server.start()
    assert shaker.status().running
    assert shaker.command(55.0, 1.0, 4.0).drive_v == 1.0
    rig.server.stop()
    rig.server.start()
    shaker.stop()
    assert rig.whats()[-1] == "stopped"


def test_a_server_that_comes_back_during_the_retries_is_enough(rig):
    shaker = ModbusShaker.tcp(*rig.server.address, timeout_s=0.5, retries=6)
    shaker.start()
    rig.server.stop()
    stopped = threading.Thread(target=shaker.stop)
    stopped.start()
    rig.server.start()
    stopped.join(DEADLINE_S)
    assert rig.whats() == ["started", "stopped", "silent"]
    shaker.close()


@pytest.mark.parametrize("wired", ["tcp", "rtu"], indirect=True)
def test_a_server_that_is_gone_is_unreachable_in_bounded_time(wired):
    rig, shaker = wired
    shaker.start()
    rig.server.stop()
    for call in (shaker.stop, shaker.status, shaker.beat, lambda: shaker.command(50.0, 1.0, 1.0)):
        began = time.monotonic()
        with pytest.raises(Unreachable, match=r"^shaker at .*attempts") as problem:
            call()
        assert time.monotonic() - began < 2.0
        assert "\n" not in str(problem.value)


def test_nobody_there_from_the_beginning():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
    shaker = ModbusShaker.tcp("127.0.0.1", port, timeout_s=0.5, retries=1)
    with pytest.raises(Unreachable, match=r"reading .*: no connection within 0.5 s in each of 2 attempts"):
        shaker.status()
    with pytest.raises(Unreachable, match="no connection"):
        ModbusShaker.rtu("/dev/no-such-port", retries=0).status()


def test_silence_is_timed_out_in_bounded_time():
    with socket.create_server(("127.0.0.1", 0)) as mute:
        shaker = ModbusShaker.tcp(*mute.getsockname(), timeout_s=0.2, retries=1)
        began = time.monotonic()
        with pytest.raises(TimedOut, match=r"none came within 0.2 s in each of 2 attempts"):
            shaker.stop()
        assert time.monotonic() - began < 2.0
        shaker.close()


def test_after_silence_the_next_attempt_is_on_a_new_connection():
    with socket.create_server(("127.0.0.1", 0)) as half_mute:
        half_mute.settimeout(DEADLINE_S)

        def serve():
            mute, _ = half_mute.accept()
            answering, _ = half_mute.accept()
            with mute, answering:
                transaction = answering.recv(260)[:2]
                answering.sendall(transaction + bytes.fromhex("0000 0006 01 10 0007 0001"))
                answering.recv(1)

        thread = threading.Thread(target=serve, daemon=True)
        thread.start()
        shaker = ModbusShaker.tcp(*half_mute.getsockname(), timeout_s=0.2, retries=1)
        shaker.stop()
        shaker.close()
        thread.join(DEADLINE_S)


@pytest.mark.parametrize(
    ("reply", "says"),
    [
        (bytes([0x63, 0]), "a Modbus answer expected"),
        (bytes([3, 2, 0, 0]), "8 registers from 20 expected, 1 came"),
    ],
)
def test_an_answer_that_is_none_is_garbled(reply, says):
    """From one that answers with a few bytes of its own in a proper frame."""
    with socket.create_server(("127.0.0.1", 0)) as babbler:
        babbler.settimeout(DEADLINE_S)

        def babble():
            wire, _ = babbler.accept()
            with wire:
                transaction = wire.recv(260)[:2]
                wire.sendall(transaction + struct.pack(">HHB", 0, len(reply) + 1, 1) + reply)
                wire.recv(1)

        thread = threading.Thread(target=babble, daemon=True)
        thread.start()
        shaker = ModbusShaker.tcp(*babbler.getsockname(), timeout_s=0.5, retries=0)
        with pytest.raises(Garbled, match=says):
            shaker.status()
        shaker.close()
        thread.join(DEADLINE_S)


def test_a_stop_gets_through_while_a_command_waits_for_its_receipt(rig):
    # The client looks for the receipt where the heartbeat is, so none ever comes.
    swapped = DEFAULT.with_addresses({"echo_sequence": 8, "heartbeat": 28})
    shaker = ModbusShaker.tcp(*rig.server.address, registers=swapped)
    shaker.start()
    problems = []

    def command():
        try:
            shaker.command(50.0, 2.0, 4.0)
        except TimedOut as problem:
            problems.append(str(problem))

    waiting = threading.Thread(target=command)
    waiting.start()
    rig.wait_for(lambda: rig.pieces)
    shaker.stop()
    assert waiting.is_alive()
    assert "stopped" in rig.whats()
    waiting.join(DEADLINE_S)
    assert "receipt of command 1 expected within 1 s, the last one is of 0" in problems[0]
    shaker.close()


def test_many_threads_share_one_connection(rig, shaker):
    running(rig, shaker)
    problems, ending = [], threading.Event()

    def hammer(call):
        try:
            while not ending.is_set():
                call()
        except Exception as problem:
            problems.append(problem)

    numbers = itertools.cycle((20.0, 30.0, 40.0))
    calls = (shaker.status, shaker.beat, shaker.identity, lambda: shaker.command(next(numbers), 1.0, 9.0))
    threads = [threading.Thread(target=hammer, args=(call,)) for call in calls]
    for thread in threads:
        thread.start()
    rig.wait_for(lambda: len(rig.pieces) > 20)
    ending.set()
    for thread in threads:
        thread.join(DEADLINE_S)
    shaker.stop()
    assert problems == []
    assert not shaker.status().running


def test_two_servers_cannot_have_one_port(rig, make_rig):
    other = make_rig(port=rig.server.address[1])
    with pytest.raises(Unreachable, match=r"cannot serve at 127\.0\.0\.1"):
        other.server.start()
    other.server.stop()
