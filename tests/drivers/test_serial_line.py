import os
import pty
import time
import tty

import pytest

from drivers.errors import Garbled, TimedOut, Unreachable
from drivers.serial_line import SerialLine


@pytest.fixture
def far_end():
    """Of a cable whose near end is at its path."""
    here, there = pty.openpty()
    tty.setraw(there)
    yield here, os.ttyname(there)
    os.close(there)
    os.close(here)


def test_all_that_has_come_is_read_at_once_and_silence_is_empty(far_end):
    here, path = far_end
    line = SerialLine(path, 9600, timeout_s=1.0)
    line.open()
    assert (line.waiting, line.read()) == (0, b"")
    os.write(here, b"23.5\r\n")
    _wait_for(line, 6)
    assert line.read() == b"23.5\r\n"
    line.write(b"T?\r\n")
    assert os.read(here, 16) == b"T?\r\n"
    line.close()


def test_what_is_closed_is_an_error_until_it_is_opened_again(far_end):
    here, path = far_end
    line = SerialLine(path, 9600, timeout_s=1.0)
    for use in (line.read, lambda: line.write(b"T?"), lambda: line.waiting):
        with pytest.raises(OSError, match="the port is closed"):
            use()
    line.close()
    for _ in range(2):
        line.open()
        assert line.is_open
        os.write(here, b"1")
        _wait_for(line, 1)
        assert line.read() == b"1"
        line.close()
        assert not line.is_open


def test_a_port_that_there_is_not_cannot_be_opened(tmp_path):
    line = SerialLine(str(tmp_path / "ttyUSB0"), 9600, timeout_s=1.0)
    with pytest.raises(OSError, match="ttyUSB0"):
        line.open()
    assert not line.is_open


@pytest.fixture
def line(far_end):
    """A near end that is open."""
    opened = SerialLine(far_end[1], 9600, timeout_s=0.1)
    opened.open()
    yield opened
    opened.close()


def test_lines_are_read_one_by_one_and_blank_ones_passed_over(far_end, line):
    os.write(far_end[0], b"\r\nfirst\r  \r\nsecond\r\nthi")
    received = bytearray()
    lines = [line.read_line(received, time.monotonic() + 5, longest=80, ends=b"\r\n") for _ in range(2)]
    assert lines == [b"first", b"second"]
    with pytest.raises(Garbled, match=r"^b'thi' and no end of line in 0\.1 s$"):
        line.read_line(received, time.monotonic(), longest=80, ends=b"\r\n")


def test_a_carriage_return_belongs_to_the_line_where_it_ends_none(far_end, line):
    os.write(far_end[0], b"one\rline\n")
    assert line.read_line(bytearray(), time.monotonic() + 5, longest=80) == b"one\rline"


def test_silence_and_lines_that_never_end_are_told_apart(far_end, line):
    with pytest.raises(TimedOut, match=r"^no line in 0\.1 s$"):
        line.read_line(bytearray(), time.monotonic(), longest=8)
    with pytest.raises(Garbled, match=r"^9 bytes without an end of line$"):
        line.read_line(bytearray(b"123456789"), time.monotonic() + 5, longest=8)


def test_attempts_end_with_the_first_that_succeeds(line):
    left = [Garbled("torn"), TimedOut("nothing"), None]

    def attempt():
        if (problem := left.pop(0)) is not None:
            raise problem
        return 23.5

    assert line.attempts(3, attempt, "thermometer") == 23.5
    assert line.is_open


@pytest.mark.parametrize(
    ("problem", "raised", "stays_open"),
    [
        (Garbled("torn"), Garbled("thermometer: torn, 2 attempts"), True),
        (OSError("gone"), Unreachable("thermometer: gone: is it plugged in and on?, 2 attempts"), False),
    ],
)
def test_attempts_in_vain_raise_the_last_error_and_close_a_lost_port(line, problem, raised, stays_open):
    def attempt():
        raise problem

    with pytest.raises(type(raised)) as caught:
        line.attempts(2, attempt, "thermometer")
    assert str(caught.value) == str(raised)
    assert line.is_open == stays_open


def _wait_for(line, count):
    """A cable takes a moment."""
    deadline = time.monotonic() + 5.0
    while line.waiting < count:
        assert time.monotonic() < deadline
        time.sleep(0.001)
