"""On a serial line an answer that comes late is nobody's."""

import os
import pty
import threading
import time
import tty

import pytest
from pymodbus.framer.rtu import FramerRTU

from drivers.errors import TimedOut
from drivers.modbus.line import ModbusLine
from drivers.modbus.serial_client import SerialClient

REQUEST_BYTES = 8
TIMEOUT_S = 0.15
LATE_S = 0.24
PATIENCE_S = 0.2


class Device:
    """Answers each reading of one register with the register's address, as late as it is told."""

    def __init__(self, *delays_s):
        self._delays_s = list(delays_s)
        self._wire, self._port = pty.openpty()
        tty.setraw(self._port)
        self.path = os.ttyname(self._port)
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def close(self):
        os.write(self._port, bytes(REQUEST_BYTES))
        self._thread.join(5.0)
        os.close(self._wire)
        os.close(self._port)

    def _serve(self):
        while True:
            request = b""
            while len(request) < REQUEST_BYTES:
                request += os.read(self._wire, REQUEST_BYTES - len(request))
            if request == bytes(REQUEST_BYTES):
                return
            # The last one is for all further questions; None is an answer that never comes.
            delay_s = self._delays_s.pop(0) if len(self._delays_s) > 1 else self._delays_s[0]
            if delay_s is None:
                continue
            time.sleep(delay_s)
            body = b"\x01\x03\x02" + request[2:4]
            os.write(self._wire, body + FramerRTU.compute_CRC(body).to_bytes(2, "big"))


@pytest.fixture
def asked():
    """A line to a device that is so late, answer by answer."""
    opened = []

    def asked(*delays_s):
        device = Device(*delays_s)
        line = ModbusLine.rtu(
            "shaker",
            device.path,
            baud=115200,
            parity="N",
            stop_bits=1,
            unit=1,
            timeout_s=TIMEOUT_S,
            retries=2,
            patience_s=PATIENCE_S,
        )
        opened.append((line, device))
        return line

    yield asked
    for line, device in opened:
        line.close()
        device.close()


def test_one_late_answer_is_not_the_next_questions(asked):
    line = asked(LATE_S, 0.03, 0.0)
    assert [line.read("number", address, 1) for address in range(5)] == [[0], [1], [2], [3], [4]]
    assert line.lost_answers == 1


def test_a_device_that_is_always_late_answers_no_question_with_anothers_answer(asked):
    line = asked(LATE_S)
    for address in range(3):
        with pytest.raises(TimedOut, match="in each of 3 attempts"):
            line.read("number", address, 1)
        time.sleep(0.02)
    assert line.lost_answers == 9


def test_a_late_answer_to_what_was_given_up_is_not_the_next_questions(asked):
    line = asked(None, None, LATE_S, 0.0)
    with pytest.raises(TimedOut):
        line.read("number", 1, 1)
    assert line.read("number", 2, 1) == [2]


def test_the_answer_to_a_question_that_was_broken_off_is_not_the_next_questions(asked, monkeypatch):
    line = asked(0.05)
    assert line.read("number", 0, 1) == [0]

    def broken_off(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(SerialClient, "recv", broken_off)
        with pytest.raises(KeyboardInterrupt):
            line.read("number", 1, 1)
    assert line.read("number", 2, 1) == [2]
    assert line.lost_answers == 0


def test_two_lost_in_a_row_are_listened_for_no_longer_than_the_patience(asked):
    line = asked(None, None, 0.0)
    began_s = time.monotonic()
    assert line.read("number", 7, 1) == [7]
    pauses_s = 0.1
    assert time.monotonic() - began_s < 2 * TIMEOUT_S + PATIENCE_S + pauses_s + 0.15
