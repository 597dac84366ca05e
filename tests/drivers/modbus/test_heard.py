"""Silence, an echo and a damaged answer are told apart."""

from drivers.modbus.heard import Heard


def heard(sent, *came):
    line = Heard()
    line(True, sent)
    for data in came:
        assert line(False, data) == data
    return line


def test_silence_is_no_damaged_answer():
    assert heard(b"ask").damaged == ""


def test_what_comes_is_shown_as_far_as_there_is_room():
    assert heard(b"ask", b"\x01", b"\x01\x03").damaged == "2 bytes came that are none (01 03)"
    assert heard(b"ask", bytes(9)).damaged == "9 bytes came that are none (00 00 00 00 00 00 00 00 ...)"


def test_what_was_sent_and_comes_back_is_called_an_echo():
    assert "does its adapter echo?" in heard(b"ask", b"ask and answer").damaged


def test_an_attempt_answers_for_itself_alone():
    line = heard(b"ask", b"torn")
    line.forget()
    assert line.damaged == ""
