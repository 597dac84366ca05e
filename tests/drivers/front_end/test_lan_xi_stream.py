import numpy as np
import pytest

from drivers.errors import DriverError, Garbled
from drivers.front_end.lan_xi_frames import (
    Data,
    Descriptor,
    DescriptorType,
    Flags,
    Interpretation,
    Quality,
    Signal,
    Time,
)
from drivers.front_end.lan_xi_stream import StreamReader

RATE = 4096
EPOCH = 1_700_000_000 << 32


def at(sample):
    return Time(EPOCH + (sample << 20))


def reader(channels=2):
    made = StreamReader(np.full(channels, 10.0), RATE)
    for k in range(channels):
        made.take(Interpretation(at(0), (Descriptor(k + 1, DescriptorType.SCALE_FACTOR, 8.0),)))
    return made


def data(first, *rows):
    return Data(at(first), tuple(Signal(k + 1, np.array(row, np.int32)) for k, row in enumerate(rows)))


def quality(sample, id, flags):
    return Quality(at(sample), ((id, flags),))


def overloads(made, samples, blocks):
    return [made.block(samples).overload.tolist() for _ in range(blocks)]


def test_blocks_of_any_length_from_messages_of_any_length():
    made = reader()
    for first, stop in ((0, 3), (3, 4), (4, 10)):
        made.take(data(first, range(first, stop), range(-stop + 1, -first + 1)))
    blocks = [made.block(n) for n in (1, 5, 4)]
    assert [b.first_sample for b in blocks] == [0, 1, 6]
    assert np.hstack([b.counts for b in blocks])[0].tolist() == list(range(10))
    assert blocks[0].volts_per_count.tolist() == [8.0 / 2**23] * 2
    assert blocks[0].full_scale_v.tolist() == [10.0, 10.0]


def test_signals_may_arrive_apart():
    made = reader()
    made.take(Data(at(0), (Signal(2, np.arange(4, dtype=np.int32)),)))
    assert made.available == 0
    made.take(Data(at(0), (Signal(1, np.arange(4, dtype=np.int32)),)))
    assert made.available == 4


def test_a_gap_in_the_stamps_is_an_error():
    made = reader(1)
    made.take(data(0, range(5)))
    with pytest.raises(DriverError, match="goes on at sample 6, expected 5"):
        made.take(data(6, range(5)))


def test_an_overrun_is_an_error():
    with pytest.raises(DriverError, match="samples of signal 2 were lost"):
        reader().take(quality(0, 2, Flags.OVERRUN))


def test_a_flag_holds_until_it_is_taken_back():
    made = reader()
    made.take(quality(4, 1, Flags.OVERLOAD))
    made.take(quality(12, 1, Flags.NONE))
    made.take(data(0, range(20), range(20)))
    assert overloads(made, 4, 5) == [[False] * 2, [True, False], [True, False], [False] * 2, [False] * 2]


def test_a_flag_inside_a_block_marks_that_block_only():
    made = reader(1)
    made.take(data(0, range(12)))
    made.take(quality(5, 1, Flags.OVERLOAD))
    made.take(quality(6, 1, Flags.NONE))
    assert overloads(made, 4, 3) == [[False], [True], [False]]


def test_a_flag_that_comes_late_marks_the_next_block():
    made = reader(1)
    made.take(data(0, range(8)))
    assert overloads(made, 4, 1) == [[False]]
    made.take(quality(1, 1, Flags.OVERLOAD))
    assert overloads(made, 4, 1) == [[True]]


def test_a_cable_fault_is_no_overload():
    made = reader()
    made.take(quality(0, 2, Flags.INVALID))
    made.take(data(0, range(4), range(4)))
    block = made.block(4)
    assert block.cable_fault.tolist() == [False, True]
    assert not block.overload.any()


@pytest.mark.parametrize(
    ("message", "said"),
    [
        (data(0, [1], [2], [3]), "signal 3, expected 1 to 2"),
        (Interpretation(at(0), (Descriptor(1, DescriptorType.UNIT, "Pa"),)), "in 'Pa', expected 'V'"),
        (
            Interpretation(at(0), (Descriptor(1, DescriptorType.PERIOD_TIME, Time(1 << 21)),)),
            "a sample every 0.000488281 s, expected 0.000244141 s",
        ),
    ],
)
def test_what_does_not_fit_the_setup_is_garbled(message, said):
    with pytest.raises(Garbled, match=said):
        reader().take(message)


def test_samples_before_their_scale_are_garbled():
    with pytest.raises(Garbled, match="before its scale factor"):
        StreamReader(np.ones(1), RATE).take(data(0, [1]))


@pytest.mark.parametrize("scale", [0.0, -10.0, float("inf"), float("nan")])
def test_a_scale_factor_that_cannot_be_is_garbled(scale):
    with pytest.raises(Garbled, match="scale factor of"):
        reader().take(Interpretation(at(0), (Descriptor(1, DescriptorType.SCALE_FACTOR, scale),)))


def test_stamps_that_count_otherwise_than_before_are_garbled():
    made = reader()
    made.take(data(0, [1], [2]))
    other = Time(at(1).ticks, family=(31, 0, 0, 0))
    with pytest.raises(Garbled, match="the time family changed"):
        made.take(Data(other, (Signal(1, np.array([2], np.int32)),)))
