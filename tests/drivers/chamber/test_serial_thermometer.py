import os
import pty
import select
import threading
import tty
from contextlib import suppress

import pytest

from drivers.chamber.ascii_line import decode
from drivers.chamber.serial_port import SerialThermometer
from drivers.errors import Garbled, Refused, TimedOut, Unreachable


class Wire:
    """The far end of a serial cable: answers a query, or says what it is told to."""

    def __init__(self, answers: list[bytes], query: bytes = b"T?\r\n") -> None:
        self._here, self._there = pty.openpty()
        tty.setraw(self._there)
        self.path = os.ttyname(self._there)
        self.asked: list[bytes] = []
        self._answers, self._query = answers, query
        self._wake, self._end = os.pipe()
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def say(self, words: bytes) -> None:
        os.write(self._here, words)

    def close(self) -> None:
        os.write(self._end, b"x")
        self._thread.join(5)
        for end in (self._here, self._there):
            with suppress(OSError):
                os.close(end)

    def _serve(self) -> None:
        received = b""
        while True:
            ready, _, _ = select.select([self._here, self._wake], [], [])
            if self._wake in ready:
                return
            received += os.read(self._here, 256)
            if received.endswith(self._query):
                self.asked.append(received)
                received = b""
                self.say(self._answers.pop(0) if len(self._answers) > 1 else self._answers[0])


@pytest.fixture
def plug():
    wires = []

    def plug(*answers: bytes, query: str = "T?"):
        wires.append(Wire(list(answers)))
        thermometer = SerialThermometer(wires[-1].path, query=query, timeout_s=0.3, retries=1)
        wires[-1].thermometer = thermometer
        return wires[-1], thermometer

    yield plug
    for wire in wires:
        wire.thermometer.close()
        wire.close()


def test_it_is_asked_and_answers(plug):
    wire, thermometer = plug(b"+23.45 C\r\n")
    assert thermometer.temperature_c() == 23.45
    assert thermometer.identity() == f"thermometer at {wire.path}"
    assert wire.asked == [b"T?\r\n"] * 2
    assert thermometer.set_point_c() is None
    with pytest.raises(Refused, match="takes no set point"):
        thermometer.go_to(30.0)


def test_what_was_said_before_is_no_answer(plug):
    wire, thermometer = plug(b"23.5\r")
    assert thermometer.temperature_c() == 23.5
    wire.say(b"99.9\r\n")
    assert thermometer.temperature_c() == 23.5


def test_a_thermometer_that_talks_is_listened_to_from_the_next_line_on(plug):
    wire, thermometer = plug(b"", query="")
    talking = threading.Event()

    def talk():
        wire.say(b"99.9\r\n3.4")
        while not talking.wait(0.1):
            wire.say(b"23.4\r\n")

    thread = threading.Thread(target=talk)
    thread.start()
    try:
        assert {thermometer.temperature_c() for _ in range(3)} == {23.4}
    finally:
        talking.set()
        thread.join()


def test_one_bad_answer_is_asked_for_again(plug):
    wire, thermometer = plug(b"\xff\xfe?\r\n", b"23.5\r\n")
    assert thermometer.temperature_c() == 23.5
    assert len(wire.asked) == 2


def test_garbage_is_given_up(plug):
    _, thermometer = plug(b"\xff\xfe?\r\n")
    with pytest.raises(Garbled, match=r"^thermometer at .*a line with one number expected.*2 attempts$"):
        thermometer.temperature_c()


def test_a_line_without_end_is_garbled(plug):
    _, thermometer = plug(b"23.5")
    with pytest.raises(Garbled, match=r"b'23\.5' and no end of line in 0\.3 s"):
        thermometer.temperature_c()


def test_silence_is_timed_out(plug):
    _, thermometer = plug(b"", query="")
    with pytest.raises(TimedOut, match=r"^thermometer at .*no line in 0\.3 s, 2 attempts$"):
        thermometer.temperature_c()


def test_unplugged_is_unreachable(plug):
    wire, thermometer = plug(b"23.5\r\n")
    assert thermometer.temperature_c() == 23.5
    wire.close()
    wire.close = lambda: None
    with pytest.raises(Unreachable, match=r"^thermometer at .*is it plugged in and on\?, 2 attempts$"):
        thermometer.temperature_c()


@pytest.mark.parametrize(
    ("line", "expected"),
    [(b"23.4", 23.4), (b"T1: -3.5 \xb0C", -3.5), (b"23.4C", 23.4), (b"2.34e1", 23.4), (b"+022", 22.0)],
)
def test_lines_with_one_number(line, expected):
    assert decode(line) == expected


@pytest.mark.parametrize(
    "line", [b"", b"T1", b"23.4 50.1", b"23,4", b"OPEN", b"74.1 F", b"296.5 K", b"9999", b"-300.0"]
)
def test_lines_that_are_no_temperature(line):
    with pytest.raises(Garbled):
        decode(line)
