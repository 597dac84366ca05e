import pytest
from vibrometer_template import protocol

from drivers.errors import Garbled, Refused


def test_a_request_is_a_line():
    assert protocol.encode("RANGE 1") == b"RANGE 1\n"


def test_answers_are_understood():
    assert protocol.parse_identity(protocol.decode(b"VIBRO 1,serial 42\r\n")) == "VIBRO 1,serial 42"
    assert protocol.parse_range("1").name == "100mm/s/V"
    assert protocol.parse_level("87") == 0.87


def test_every_range_has_its_number():
    assert [protocol.parse_range(str(protocol.number_of(r.name))) for r in protocol.RANGES] == [
        *protocol.RANGES
    ]


@pytest.mark.parametrize(
    ("parse", "text"),
    [
        (protocol.parse_identity, "OTHER"),
        (protocol.parse_range, "9"),
        (protocol.parse_range, "-1"),
        (protocol.parse_level, "101"),
        (protocol.parse_level, ""),
        (protocol.check_done, "O"),
    ],
)
def test_what_the_protocol_does_not_allow_is_garbled(parse, text):
    with pytest.raises(Garbled, match="expected"):
        parse(text)


def test_bytes_that_are_no_text_are_garbled():
    with pytest.raises(Garbled):
        protocol.decode(b"\xff\n")


def test_a_no_of_the_device_is_refused_in_its_words():
    with pytest.raises(Refused, match="'ERR what"):
        protocol.decode(b"ERR what?\n")


def test_a_range_that_there_is_not_is_refused_naming_those_there_are():
    with pytest.raises(Refused, match="there are 20mm/s/V, 100mm/s/V, 500mm/s/V"):
        protocol.number_of("7mm/s/V")
