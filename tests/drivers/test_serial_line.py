import os
import pty
import time
import tty

import pytest

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


def _wait_for(line, count):
    """A cable takes a moment."""
    deadline = time.monotonic() + 5.0
    while line.waiting < count:
        assert time.monotonic() < deadline
        time.sleep(0.001)
