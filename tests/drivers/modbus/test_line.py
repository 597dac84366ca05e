"""Which answer is an answer to what was asked."""

import pytest
from pymodbus.pdu.register_message import ReadHoldingRegistersResponse, WriteMultipleRegistersResponse

from drivers.errors import Garbled
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


def line(client, retries=1):
    return ModbusLine(client, "shaker", unit=1, timeout_s=0.1, retries=retries)


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
