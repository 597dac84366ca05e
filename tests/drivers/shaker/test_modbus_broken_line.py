"""A shaker whose line is broken, silent, babbling or shared by threads."""

import itertools
import socket
import struct
import threading
import time

import pytest

from drivers.errors import Garbled, TimedOut, Unreachable
from drivers.shaker.modbus import ModbusShaker
from drivers.shaker.register_map import DEFAULT

DEADLINE_S = 5.0


def test_a_server_that_comes_back_is_found_again_and_stopped(rig, shaker):
    rig.set_running(shaker)
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
    with pytest.raises(Unreachable, match="could not open port /dev/no-such-port: No such file"):
        ModbusShaker.rtu("/dev/no-such-port", retries=0).status()


def test_silence_is_timed_out_in_bounded_time():
    with socket.create_server(("127.0.0.1", 0)) as mute:
        shaker = ModbusShaker.tcp(*mute.getsockname(), timeout_s=0.2, retries=1)
        began = time.monotonic()
        with pytest.raises(TimedOut, match=r"none came within 0.2 s in each of 2 attempts: is its unit 1\?"):
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
    rig.set_running(shaker)
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
