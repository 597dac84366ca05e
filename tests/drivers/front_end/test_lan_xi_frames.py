import struct
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.errors import Garbled
from drivers.front_end.lan_xi_frames import (
    LONGEST_CONTENT,
    Data,
    Decoder,
    Descriptor,
    DescriptorType,
    Flags,
    Interpretation,
    Other,
    Quality,
    Signal,
    Time,
    encode,
    pack_24,
    unpack_24,
)


def header(message_type, length, ticks=7):
    return (
        b"BK\x14\x00"
        + struct.pack("<HHI", message_type, 0, 0)
        + b"\x20\0\0\0"
        + struct.pack("<QI", ticks, length)
    )


DATA = (
    header(1, 4 + 4 + 9 + 4 + 3, ticks=1 << 33)
    + b"\x02\x00\x00\x00"
    + b"\x01\x00\x03\x00"
    + b"\x01\x00\x00\xff\xff\xff\x00\x00\x80"
    + b"\x02\x00\x01\x00"
    + b"\xff\xff\x7f"
)
QUALITY = header(2, 14) + b"\x02\x00" + b"\x01\x00\x02\x00\x00\x00" + b"\x03\x00\x18\x00\x00\x00"
INTERPRETATION = (
    header(8, 16 + 12 + 20 + 12)
    + b"\x01\x00\x02\x00\x00\x00\x08\x00"
    + struct.pack("<d", 11.885)
    + b"\x01\x00\x05\x00\x00\x00\x03\x00\x01\x00V\x00"
    + b"\x01\x00\x04\x00\x00\x00\x0c\x00\x20\x00\x00\x00\x00\x80\x00\x00\x00\x00\x00\x00"
    + b"\x01\x00\x01\x00\x00\x00\x02\x00\x03\x00\x00\x00"
)


def told(message):
    """What a message says, comparable."""
    if isinstance(message, Data):
        return message.time, [(s.id, s.counts.tolist()) for s in message.signals]
    return message


def test_a_data_message_of_known_bytes():
    (message,) = Decoder().feed(DATA)
    assert told(message) == (Time(1 << 33), [(1, [1, -1, -(1 << 23)]), (2, [(1 << 23) - 1])])
    assert message.time.seconds == 2.0
    assert encode(message) == DATA


def test_a_quality_message_of_known_bytes():
    (message,) = Decoder().feed(QUALITY)
    assert message == Quality(Time(7), ((1, Flags.OVERLOAD), (3, Flags.INVALID | Flags.OVERRUN)))
    assert encode(message) == QUALITY


def test_an_interpretation_message_of_known_bytes():
    (message,) = Decoder().feed(INTERPRETATION)
    assert message.descriptors == (
        Descriptor(1, DescriptorType.SCALE_FACTOR, 11.885),
        Descriptor(1, DescriptorType.UNIT, "V"),
        Descriptor(1, DescriptorType.PERIOD_TIME, Time(1 << 15)),
        Descriptor(1, DescriptorType.DATA_TYPE, 3.0),
    )
    assert encode(message) == INTERPRETATION
    assert 1 / message.descriptors[2].value.seconds == 131072


def test_the_stated_length_of_a_value_counts_not_the_one_expected():
    wide = header(8, 12 + 16) + b"\x01\x00\x01\x00\x00\x00\x04\x00\x03\x00\x00\x00" + INTERPRETATION[28:44]
    (message,) = Decoder().feed(wide)
    assert [d.value for d in message.descriptors] == [3.0, 11.885]


def test_a_message_of_an_unknown_type_is_passed_over():
    assert [type(m) for m in Decoder().feed(header(11, 3) + b"abc" + QUALITY)] == [Other, Quality]


def test_every_split_in_two_gives_the_same_messages():
    stream = INTERPRETATION + QUALITY + DATA
    whole = [told(m) for m in Decoder().feed(stream)]
    for cut in range(len(stream) + 1):
        decoder = Decoder()
        messages = decoder.feed(stream[:cut]) + decoder.feed(stream[cut:])
        assert [told(m) for m in messages] == whole


@given(
    counts=st.lists(st.lists(st.integers(-(1 << 23), (1 << 23) - 1), max_size=20), min_size=1, max_size=4),
    cuts=st.lists(st.integers(0, 400)),
    ticks=st.integers(0, 2**64 - 1),
)
def test_however_split_what_went_in_comes_out(counts, cuts, ticks):
    signals = tuple(Signal(k + 1, np.array(row, np.int32)) for k, row in enumerate(counts))
    sent = [Data(Time(ticks), signals), Quality(Time(ticks), ((1, Flags.OVERLOAD),)), Data(Time(0), signals)]
    stream = b"".join(encode(m) for m in sent)
    edges = [0, *sorted(min(c, len(stream)) for c in cuts), len(stream)]
    decoder = Decoder()
    received = [m for a, b in pairwise(edges) for m in decoder.feed(stream[a:b])]
    assert [told(m) for m in received] == [told(m) for m in sent]


def test_24_bits_at_their_limits_and_in_bulk():
    counts = np.random.default_rng(1).integers(-(1 << 23), 1 << 23, 100_000, dtype=np.int32)
    counts[:4] = [-(1 << 23), -1, 0, (1 << 23) - 1]
    packed = pack_24(counts)
    assert packed[:12].hex() == "000080ffffff000000ffff7f"
    np.testing.assert_array_equal(unpack_24(b"\x99" + packed, 1, counts.size), counts)


@pytest.mark.parametrize(
    ("broken", "said"),
    [
        (b"XK" + DATA[2:], "a message begins with"),
        (b"BK\x15\x00" + DATA[4:], "a message begins with"),
        (header(1, LONGEST_CONTENT + 1), "limit 16777216"),
        (header(1, 2) + b"\x01\x00", "2 bytes"),
        (header(1, 11) + b"\x01\0\0\0\x01\0\x02\0\0\0\0", "2 samples of signal 1 in 3 bytes"),
        (header(1, 8) + b"\x01\0\0\0\x01\0\xff\xff", "-1 samples"),
        (header(1, 12) + b"\x00\0\0\0" + bytes(8), "8 bytes after the last"),
        (header(2, 4) + b"\x01\0\0\0", "message of type 2"),
        (header(8, 8) + b"\x01\0\x02\0\0\0\x08\0", "a value of 8 bytes in 0"),
        (header(8, 12) + b"\x01\0\x02\0\0\0\x04\0\0\0\0\0", "message of type 8"),
    ],
)
def test_what_no_module_sends_is_garbled(broken, said):
    with pytest.raises(Garbled, match=said):
        Decoder().feed(broken)


@given(st.binary(max_size=80), st.sampled_from([1, 2, 8, 11]))
def test_no_content_whatever_breaks_the_decoder(content, message_type):
    try:
        Decoder().feed(header(message_type, len(content)) + content)
    except Garbled:
        return


def test_an_interpretation_round_trip():
    sent = Interpretation(
        Time(3, (0, 1, 2, 3)),
        (
            Descriptor(1, DescriptorType.UNIT, "m/s²"),
            Descriptor(2, DescriptorType.OFFSET, -0.5),
            Descriptor(2, DescriptorType.CHANNEL_TYPE, 1.0),
            Descriptor(2, 77, b"xyz"),
        ),
    )
    assert Decoder().feed(encode(sent)) == [sent]
    assert sent.time.ticks_per_s == 3 * 25 * 343
