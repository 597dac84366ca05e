"""The simulated shaker as a foreign master meets it: plain bytes, and the command line program mbpoll.

By hand, with PORT and /dev/pts/N as the server says:

    mbpoll -m tcp -p PORT -a 1 -0 -1 -t 4:float -B -r 26 127.0.0.1                        the limit
    mbpoll -m tcp -p PORT -a 1 -0 -1 -t 4 -r 7 127.0.0.1 1                                start
    mbpoll -m tcp -p PORT -a 1 -0 -1 -t 4 -r 0 127.0.0.1 17056 0 16256 0 16672 0 1        80 Hz, 1 V, 10 V/s
    mbpoll -m tcp -p PORT -a 1 -0 -1 -t 4 -r 7 127.0.0.1 0                                stop
    mbpoll -m rtu -b 115200 -P none -a 1 -0 -1 -t 4:float -B -r 26 /dev/pts/N             the same over RTU
"""

import shutil
import socket
import subprocess

import pytest

COMMAND = "42a0 0000 3f80 0000 4120 0000 0001"  # 80 Hz, 1 V, 10 V/s, number 1
START = "10 0007 0001 02 0001"
WRITE_COMMAND = f"10 0000 0007 0e {COMMAND}"
DONE = "10 0000 0007"


@pytest.fixture
def ask(rig):
    with socket.create_connection(rig.server.address, timeout=5.0) as wire:

        def ask(request):
            body = bytes.fromhex("01" + request)
            wire.sendall(bytes.fromhex("0001 0000") + len(body).to_bytes(2, "big") + body)
            head = wire.recv(6, socket.MSG_WAITALL)
            answer = wire.recv(int.from_bytes(head[4:], "big"), socket.MSG_WAITALL)
            assert answer[0] == 1
            return answer[1:].hex()

        yield ask


def same(answer, expected):
    return answer == expected.replace(" ", "")


def test_command_and_receipt_byte_by_byte(rig, ask):
    assert same(ask(START), "10 0007 0001")
    rig.pass_time(20.0)
    assert same(ask(WRITE_COMMAND), DONE)
    assert same(ask("03 001c 0007"), "03 0e 0001 0000 0000 0001 86a0 3f80 0000")
    assert same(ask("03 0000 0007"), f"03 0e {COMMAND}")
    rig.pass_time(0.05)
    assert same(ask("03 0014 0008"), "03 10 0003 0000 3f00 0000 42a0 0000 40a0 0000")


def test_the_same_command_sent_twice_takes_effect_once(rig, ask):
    ask(START)
    assert same(ask(WRITE_COMMAND), DONE)
    assert same(ask(WRITE_COMMAND), DONE)
    assert rig.whats() == ["started", "command 80 Hz 1 V at 10 V/s"]


def test_a_command_takes_effect_with_its_number_only(rig, ask):
    ask(START)
    ask("10 0000 0006 0c 42a0 0000 3f80 0000 4120 0000")
    assert rig.pieces == []
    ask("06 0006 0001")
    assert rig.whats()[-1] == "command 80 Hz 1 V at 10 V/s"


def test_a_single_write_is_answered_with_the_word_as_written(rig, ask):
    assert same(ask("06 0007 0002"), "06 0007 0002")
    assert same(ask("03 0007 0001"), "03 02 0000")


def test_the_same_number_again_is_no_beat(rig, ask):
    ask(START)
    ask("06 0008 0005")
    rig.pass_wall_time(1.9)
    ask("06 0008 0005")
    rig.pass_wall_time(0.2)
    assert rig.whats() == ["started", "alarm HEARTBEAT", "silent"]


def test_writing_some_and_reading_others_in_one_request(rig, ask):
    answer = ask("17 0014 0001 0007 0001 02 0001")
    assert same(answer, "17 02 0001")


ILLEGAL_FUNCTION, ILLEGAL_ADDRESS, ILLEGAL_VALUE, NOT_NOW = "01", "02", "03", "07"


@pytest.mark.parametrize(
    ("request_bytes", "exception"),
    [
        ("03 000b 0001", "83" + ILLEGAL_ADDRESS),
        ("03 0008 0004", "83" + ILLEGAL_ADDRESS),
        ("03 ffff 0001", "83" + ILLEGAL_ADDRESS),
        ("06 0014 0001", "86" + ILLEGAL_ADDRESS),
        ("10 0000 0001 02 0001 ", None),
        ("06 0007 0003", "86" + ILLEGAL_VALUE),
        ("06 0007 0080", "86" + ILLEGAL_VALUE),
        ("10 0009 0002 04 7fc0 0000", "90" + ILLEGAL_VALUE),
        ("10 0009 0002 04 42f0 0000", "90" + ILLEGAL_VALUE),
        ("10 0000 0007 0e 7fc0 0000 3f80 0000 4120 0000 0001", "90" + ILLEGAL_VALUE),
        ("10 0000 0007 0e 42a0 0000 3f80 0000 4120 0000 0000", "90" + ILLEGAL_VALUE),
        (WRITE_COMMAND, "90" + NOT_NOW),
        ("04 0014 0001", "84" + ILLEGAL_FUNCTION),
        ("01 0007 0001", "81" + ILLEGAL_FUNCTION),
        ("05 0007 ff00", "85" + ILLEGAL_FUNCTION),
    ],
)
def test_what_may_not_be_is_answered_with_a_modbus_exception(rig, ask, request_bytes, exception):
    answer = ask(request_bytes)
    assert answer == (exception or "1000000001")
    assert rig.whats() == []


@pytest.fixture
def mbpoll(make_rig):
    if shutil.which("mbpoll") is None:
        pytest.skip("mbpoll is not installed: no foreign master to try")
    rig = make_rig(rtu=True)
    with rig.server:
        wires = {
            "tcp": ["-m", "tcp", "-p", str(rig.server.address[1]), "127.0.0.1"],
            "rtu": ["-m", "rtu", "-b", "115200", "-P", "none", rig.server.rtu_path],
        }

        def run(wire, *options, write=()):
            *how, where = wires[wire]
            command = ["mbpoll", *how, "-a", "1", "-0", "-1", *options, where, *write]
            return subprocess.run(command, capture_output=True, text=True, timeout=10, check=False)

        yield rig, run


@pytest.mark.parametrize("wire", ["tcp", "rtu"])
def test_mbpoll_starts_commands_reads_and_stops(mbpoll, wire):
    rig, run = mbpoll
    assert run(wire, "-t", "4", "-r", "7", write=["1"]).returncode == 0
    block = ["17056", "0", "16256", "0", "16672", "0", "1"]
    assert run(wire, "-t", "4", "-r", "0", write=block).returncode == 0
    rig.pass_time(1.0)
    seen = run(wire, "-t", "4:float", "-B", "-r", "22", "-c", "3").stdout
    assert "[22]: \t1\n[24]: \t80\n[26]: \t5\n" in seen
    assert run(wire, "-t", "4", "-r", "7", write=["0"]).returncode == 0
    rig.pass_time(1.0)
    assert rig.whats() == ["started", "command 80 Hz 1 V at 10 V/s", "ramp ended", "stopped", "silent"]


@pytest.mark.parametrize("wire", ["tcp", "rtu"])
def test_mbpoll_is_told_what_may_not_be(mbpoll, wire):
    _, run = mbpoll
    assert "Illegal data address" in run(wire, "-t", "4", "-r", "11").stderr
    assert "Illegal data value" in run(wire, "-t", "4", "-r", "7", write=["9"]).stderr
