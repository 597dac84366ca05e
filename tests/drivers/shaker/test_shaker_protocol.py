import math
import struct

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from drivers.errors import Garbled, Refused
from drivers.shaker.interface import Alarm, Echo, ShakerStatus
from drivers.shaker.protocol import (
    Identity,
    SineCommand,
    decode,
    decode_command,
    decode_echo,
    decode_identity,
    decode_span,
    decode_status,
    encode,
    encode_command,
    encode_echo,
    encode_identity,
    encode_span,
    encode_status,
    limit_objection,
    next_sequence,
    word_order_hint,
)
from drivers.shaker.register_map import DEFAULT, ECHO, IDENTITY, STATUS

ALL_ONES = [0xFFFF] * 4


def test_a_command_block_is_encoded_as_the_map_has_it():
    words = [0x42A0, 0x0000, 0x3F80, 0x0000, 0x4120, 0x0000, 0x0007]
    command = SineCommand(frequency_hz=80.0, drive_v=1.0, ramp_v_s=10.0, sequence=7)
    assert encode_command(DEFAULT, command) == words
    assert decode_command(DEFAULT, words) == command


def test_a_status_block_is_decoded_and_encoded_back():
    (span,) = DEFAULT.spans(STATUS)
    words = [0x001C, 0x0002, 0x3E80, 0x0000, 0x41C8, 0x0000, 0x40A0, 0x0000]
    status = ShakerStatus(
        running=False,
        ramping=False,
        limited=True,
        interlock_open=True,
        alarm=Alarm.INTERLOCK,
        drive_v=0.25,
        frequency_hz=25.0,
        limit_v=5.0,
    )
    assert decode_status(decode_span(DEFAULT, span, words)) == status
    assert encode_span(DEFAULT, span, encode_status(status)) == words


@pytest.mark.parametrize(
    ("bit", "name"), [(1, "running"), (2, "ramping"), (4, "limited"), (8, "interlock_open"), (0x8000, None)]
)
def test_status_bits_one_by_one(bit, name):
    values = {"status": bit, "alarm": 0, "drive_v_now": 0.0, "frequency_hz_now": 0.0, "limit_v": 5.0}
    status = decode_status(values)
    set_bits = [n for n in ("running", "ramping", "limited", "interlock_open") if getattr(status, n)]
    assert set_bits == ([name] if name else [])


@pytest.mark.parametrize(
    ("words", "echo"),
    [
        ([0x0009, 0, 0, 0x0001, 0x86A0, 0x3F00, 0x0000], Echo(9, 100_000, 0.5)),
        ([0x0009, 0, 1, 0, 0, 0x3F00, 0x0000], Echo(9, 2**32, 0.5)),
        ([0x0001, *ALL_ONES, 0x0000, 0x0000], Echo(1, None, 0.0)),
    ],
)
def test_an_echo_block_is_decoded_and_encoded_back(words, echo):
    (span,) = DEFAULT.spans(ECHO)
    assert decode_echo(decode_span(DEFAULT, span, words)) == echo
    assert encode_span(DEFAULT, span, encode_echo(echo)) == words


def test_an_identity_block_is_decoded_and_encoded_back():
    (span,) = DEFAULT.spans(IDENTITY)
    words = [1, 0x0001, 0x0002, 0x4142, 0x4300, *[0] * 14]
    assert decode_identity(decode_span(DEFAULT, span, words)) == Identity("ABC", 65538)
    assert encode_span(DEFAULT, span, encode_identity(Identity("ABC", 65538))) == words


def status_values(**other):
    return {"status": 0, "alarm": 0, "drive_v_now": 0.0, "frequency_hz_now": 0.0, "limit_v": 5.0} | other


@pytest.mark.parametrize(
    ("read", "says"),
    [
        (
            lambda: decode(DEFAULT["drive_v"], [0x7FC0, 0]),
            "drive_v: a finite number expected, nan came as 7fc0 0000",
        ),
        (lambda: decode(DEFAULT["limit_v"], [0xFF80, 0]), "finite number expected, -inf"),
        (lambda: decode(DEFAULT["limit_v"], [0x4080]), "limit_v: 2 registers expected, 1 came"),
        (
            lambda: decode_span(DEFAULT, DEFAULT.spans(STATUS)[0], [0] * 7),
            "8 registers from 20 expected, 7 came",
        ),
        (lambda: decode(DEFAULT["identity"], [0x41FF] + [0] * 15), "printable ASCII expected"),
        (lambda: decode(DEFAULT["identity"], [0x410A, 0x4200] + [0] * 14), "printable ASCII expected"),
        (
            lambda: decode_status(status_values(status=16, alarm=9)),
            "alarm: one of 0 NONE, .* expected, 9 came",
        ),
        (lambda: decode_status(status_values(status=16)), "contradict alarm 0"),
        (lambda: decode_status(status_values(alarm=1)), "contradict alarm 1"),
        (lambda: decode_status(status_values(drive_v_now=-0.1)), "drive_v_now: no negative number"),
        (lambda: decode_echo({"echo_sequence": 1, "echo_sample": 0, "echo_drive_v": -1.0}), "echo_drive_v"),
        (
            lambda: decode_identity({"map_version": 2, "serial_number": 0, "identity": ""}),
            "map_version: 1 expected, 2 came",
        ),
        (lambda: decode_command(DEFAULT, [0, 0, 0x3F80, 0, 0x4120, 0, 1]), "frequency_hz = 0 is outside"),
        (lambda: decode_command(DEFAULT, [0x42A0, 0, 0xBF80, 0, 0x4120, 0, 1]), "drive_v = -1 is outside"),
        (lambda: decode_command(DEFAULT, [0x42A0, 0, 0x3F80, 0, 0, 0, 1]), "ramp_v_s = 0 is outside"),
        (
            lambda: decode_command(DEFAULT, [0x42A0, 0, 0x3F80, 0, 0x4120, 0, 0]),
            "command_sequence = 0 is outside",
        ),
    ],
)
def test_what_cannot_be_is_garbled(read, says):
    with pytest.raises(Garbled, match=says) as problem:
        read()
    assert "\n" not in str(problem.value)


@pytest.mark.parametrize(
    "command",
    [
        SineCommand(math.nan, 1.0, 1.0, 1),
        SineCommand(80.0, math.inf, 1.0, 1),
        SineCommand(80.0, 1e300, 1.0, 1),
        SineCommand(80.0, -0.1, 1.0, 1),
        SineCommand(0.0, 1.0, 1.0, 1),
        SineCommand(80.0, 1.0, 0.0, 1),
        SineCommand(80.0, 1.0, 1e-300, 1),
        SineCommand(80.0, 1.0, 1.0, 0),
        SineCommand(80.0, 1.0, 1.0, 65536),
    ],
)
def test_a_command_out_of_range_is_not_sent(command):
    with pytest.raises(Refused, match=r"command not sent: .* is outside"):
        encode_command(DEFAULT, command)


def test_sequence_numbers_go_round_without_zero():
    assert [next_sequence(n) for n in (0, 1, 65534, 65535)] == [1, 2, 65535, 1]


FLOAT32 = st.floats(0.0, 900.0, width=32)
COMMANDS = st.builds(
    SineCommand,
    frequency_hz=st.floats(1.0, 1e5, width=32),
    drive_v=FLOAT32,
    ramp_v_s=st.floats(2**-19, 1e6, width=32),
    sequence=st.integers(1, 65535),
)


@given(COMMANDS)
def test_commands_come_back_as_sent(command):
    assert decode_command(DEFAULT, encode_command(DEFAULT, command)) == command


def nearest_float32(value):
    return struct.unpack(">f", struct.pack(">f", value))[0]


@given(st.floats(0.01, 1e5), st.floats(0, 1e3), st.floats(1e-6, 1e6))
def test_every_command_that_may_be_sent_is_understood_as_its_nearest_float32(frequency, drive, ramp):
    got = decode_command(DEFAULT, encode_command(DEFAULT, SineCommand(frequency, drive, ramp, 1)))
    assert got == SineCommand(*map(nearest_float32, (frequency, drive, ramp)), 1)
    assert got.frequency_hz == pytest.approx(frequency, rel=6e-8)


@given(
    st.builds(
        ShakerStatus,
        running=st.booleans(),
        ramping=st.booleans(),
        limited=st.booleans(),
        interlock_open=st.booleans(),
        alarm=st.sampled_from(Alarm),
        drive_v=FLOAT32,
        frequency_hz=FLOAT32,
        limit_v=FLOAT32,
    )
)
def test_status_comes_back(status):
    (span,) = DEFAULT.spans(STATUS)
    words = encode_span(DEFAULT, span, encode_status(status))
    assert decode_status(decode_span(DEFAULT, span, words)) == status


@given(st.integers(0, 65535), st.none() | st.integers(0, 2**64 - 2), FLOAT32)
def test_echo_comes_back_with_registers_scattered(sequence, sample, drive):
    scattered = DEFAULT.with_addresses({"echo_sample": 900, "echo_drive_v": 800})
    values = {}
    for span in scattered.spans(ECHO):
        words = encode_span(scattered, span, encode_echo(Echo(sequence, sample, drive)))
        values |= decode_span(scattered, span, words)
    assert decode_echo(values) == Echo(sequence, sample, drive)


@given(st.lists(st.integers(0, 65535), min_size=8, max_size=8))
def test_any_words_are_a_status_or_garbled(words):
    (span,) = DEFAULT.spans(STATUS)
    try:
        status = decode_status(decode_span(DEFAULT, span, words))
    except Garbled:
        return
    assert status.alarm in Alarm
    assert all(math.isfinite(v) and v >= 0 for v in (status.drive_v, status.frequency_hz, status.limit_v))


@given(st.text(st.characters(min_codepoint=33, max_codepoint=126), max_size=32))
def test_identity_text_comes_back(text):
    assert decode(DEFAULT["identity"], encode(DEFAULT["identity"], text)) == text


@given(st.floats(width=32))
def test_floats_are_big_endian_pairs(value):
    assume(math.isfinite(value))
    assert struct.pack(">2H", *encode(DEFAULT["drive_v"], value)) == struct.pack(">f", value)


def exchanged(value):
    """As a device reads out a float32 low word first."""
    return struct.unpack(">f", struct.pack(">HH", *reversed(struct.unpack(">HH", struct.pack(">f", value)))))[
        0
    ]


@pytest.mark.parametrize("limit_v", [5.0, 10.0, 3.3])
def test_a_drive_limit_whose_words_are_exchanged_is_none(limit_v):
    assert limit_objection(limit_v) is None
    said = limit_objection(exchanged(limit_v))
    assert said.endswith(f"(with its words exchanged {limit_v:g}: word order?)")


def test_a_drive_limit_of_nothing_is_none_in_any_order_of_words():
    assert limit_objection(0.0) == "its limit_v is 0 V, at least 0.001 V expected"


def test_a_drive_limit_that_no_amplifier_has_protects_nothing_and_is_none():
    assert limit_objection(1000.0) is None
    assert limit_objection(5e30) == "its limit_v is 5e+30 V, at most 1000 V expected"


def test_what_is_not_finite_or_negative_may_be_a_matter_of_word_order():
    with pytest.raises(Garbled, match=r"finite number expected.*words exchanged 3\.281: word order"):
        decode(DEFAULT["limit_v"], [0xFF80, 0x4051])
    hint = word_order_hint(exchanged(0.1))
    assert exchanged(0.1) < 0
    assert hint == " (with its words exchanged 0.1: word order?)"
    assert word_order_hint(-1.0) == ""
