"""A serial port that does not open says why."""

import errno
import os
import pty
import termios
import time
import tty

import pytest
from serial import SerialException

from drivers.modbus import serial_client
from drivers.modbus.serial_client import SerialClient, why_not_open


@pytest.fixture
def port():
    there, here = pty.openpty()
    yield os.ttyname(here)
    os.close(there)
    os.close(here)


def said_by(path):
    with pytest.raises(OSError, match="port") as problem:
        SerialClient(path).connect()
    return why_not_open(problem.value, "in each of 3 attempts")


def test_a_port_that_is_not_there_is_said_with_the_adapter_in_question():
    assert said_by("/dev/no-such-port") == (
        "could not open port /dev/no-such-port: No such file or directory, in each of 3 attempts: "
        "is its adapter plugged in, the address its port's?"
    )


def test_a_port_that_another_has_is_said_to_be_in_use(port):
    first = SerialClient(port)
    assert first.connect()
    assert "another program has it" in said_by(port)
    first.close()
    assert SerialClient(port).connect()


def test_a_file_that_is_no_port_is_said_to_be_none():
    assert said_by("/dev/null") == (
        "Could not configure port: Inappropriate ioctl for device, in each of 3 attempts: "
        "is the address a serial port's, and free?"
    )


def test_a_port_without_the_settings_asked_for_has_them_in_question(port, monkeypatch):
    def refused(*_, **__):
        raise termios.error(errno.EINVAL, "Invalid argument")

    monkeypatch.setattr(serial_client, "serial_for_url", refused)
    said = said_by(port)
    assert said.startswith(f"could not set up port {port}: Invalid argument, in each")
    assert said.endswith("does the port have this baud, parity and number of stop bits?")


def test_a_port_that_this_user_may_not_open_asks_for_the_group_of_ports():
    denied = SerialException(errno.EACCES, "could not open port x: [Errno 13] Permission denied: 'x'")
    said = why_not_open(denied, "tried once")
    assert said.startswith("could not open port x: Permission denied, tried once: may this user open it?")
    assert "dialout" in said


@pytest.mark.parametrize(("came", "is_answer"), [(bytes(7), True), (bytes(2), False)])
def test_what_is_heard_out_is_dropped_and_a_byte_or_two_are_no_answer(came, is_answer):
    there, here = pty.openpty()
    tty.setraw(here)
    client = SerialClient(os.ttyname(here))
    client.connect()
    os.write(there, came)
    began_s = time.monotonic()
    assert client.listen(began_s + 0.3) is is_answer
    assert (time.monotonic() - began_s < 0.25) is is_answer
    assert client.socket.in_waiting == 0
    client.close()
    os.close(there)
    os.close(here)
