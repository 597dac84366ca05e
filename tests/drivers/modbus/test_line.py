"""Which answer is an answer to what was asked."""

import pytest
from pymodbus.exceptions import ModbusIOException
from pymodbus.pdu.register_message import ReadHoldingRegistersResponse, WriteMultipleRegistersResponse

from drivers.errors import Garbled, TimedOut
from drivers.modbus.heard import Heard
from drivers.modbus.line import ModbusLine


class Client:
    """Answers with what it was given, one after the other."""

    def __init__(self, *answers):
        self._answers, self.closed = list(answers), 0

    def connect(self):
        return True

    def close(self):
        self.closed += 1

    def _answer(self, *_, **__):
        found = self._answers.pop(0)
        if isinstance(found, BaseException):
            raise found
        return found

    read_holding_registers = write_registers = _answer


def line(client, retries=1, **serial):
    return ModbusLine(client, "shaker", unit=1, timeout_s=0.1, retries=retries, **serial)


def receipt(address, count=1):
    return WriteMultipleRegistersResponse(address=address, count=count)


def test_a_late_receipt_of_another_write_is_none():
    client = Client(receipt(8), receipt(7))
    line(client).write("control", 7, [0])
    assert client.closed == 1
    with pytest.raises(Garbled, match="another's came"):
        line(Client(receipt(8), receipt(7, 2))).write("control", 7, [0])


def test_an_answer_of_another_length_or_kind_is_none():
    words = ReadHoldingRegistersResponse(registers=[1, 2])
    client = Client(receipt(7), ReadHoldingRegistersResponse(registers=[9]), words)
    assert line(client, retries=2).read("status", 20, 2) == [1, 2]


def test_a_transaction_that_is_broken_off_leaves_no_answer_for_the_next():
    client = Client(KeyboardInterrupt())
    with pytest.raises(KeyboardInterrupt):
        line(client).write("heartbeat", 8, [1])
    assert client.closed == 1


def no_answer():
    return ModbusIOException("No response received after 0 retries")


def test_answers_that_were_asked_for_again_are_counted_as_lost():
    noisy = line(Client(no_answer(), receipt(8), receipt(7)), retries=2)
    noisy.write("control", 7, [0])
    assert noisy.lost_answers == 2


def test_a_silent_serial_line_asks_for_its_settings_and_another_for_its_unit_alone():
    with pytest.raises(TimedOut, match=r"none came within 0\.1 s .*: check cable, baud \(9600\) and unit$"):
        line(Client(no_answer()), retries=0, settings="baud (9600) and unit").write("control", 7, [0])
    with pytest.raises(TimedOut, match=r": is its unit 1\?$"):
        line(Client(no_answer()), retries=0).write("control", 7, [0])


def test_a_damaged_answer_is_no_silence():
    heard = Heard()

    class Noisy(Client):
        def write_registers(self, *_, **__):
            heard(False, b"\x01\x10\x00")
            raise no_answer()

    with pytest.raises(Garbled, match=r"3 bytes came that are none \(01 10 00\), in each of 1 attempts"):
        line(Noisy(), retries=0, heard=heard).write("control", 7, [0])
