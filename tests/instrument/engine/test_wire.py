"""What goes into the pipe comes out of it."""

import io
from pathlib import Path

import numpy as np
import pytest
from result_cases import identification

from drivers.shaker.modbus_driver import ModbusTcpOptions
from instrument.check.piece import TimedPiece
from instrument.engine.messages import (
    Answered,
    BlocksDropped,
    Decided,
    Ended,
    Happened,
    HoldWanted,
    Logged,
    Message,
    OperatorAsked,
    Order,
    OverruleWanted,
    Planned,
    Progressed,
    RecordingBegan,
    RigOpened,
    ShakerSeen,
    StopPathChanged,
)
from instrument.engine.wire import encode, read
from instrument.stream.derived import FitUpdated
from instrument.stream.raw import BlockAcquired, StepBegan

MESSAGES = (
    Order(Path("a b/é.toml"), Path("out"), ("sweep",), Path("x.running"), ask_content=True),
    HoldWanted(),
    Answered("content"),
    Decided("rejected", 3),
    OverruleWanted("add", 45.2),
    OperatorAsked("follow-up", "aim it elsewhere", at_mm=(250.0, 100.0), mark="laser"),
    Happened(FitUpdated(1, 7, identification(rms_percent=0.1 + 0.2), "a message")),
    Happened(StepBegan(1, "step", 1, 1, 100.0, None, 0.5, 8.0)),
    BlocksDropped(7),
    Progressed("forecasting", 0.5),
    Planned((TimedPiece("hit", 15.0), TimedPiece("step", 1.0, 2.5)), ((1, 15.2, 25.4),)),
    ShakerSeen(0.5, 12.25),
    OperatorAsked("mount", "bare"),
    Logged("2026-04-01T08:00:05+00:00", "WARNING", "line\nand another"),
    RecordingBegan(Path("x.running"), Path("x.h5")),
    RigOpened(ModbusTcpOptions(address="127.0.0.1:502", registers={"heartbeat": 108})),
    StopPathChanged(False, "why"),
    Ended("done", "", Path("x.h5"), None),
)


def block(samples: int = 5, first: int = 0) -> BlockAcquired:
    counts = np.arange(2 * samples, dtype=np.int32).reshape(2, samples) * 321 - 2**23
    two = (False, True)
    return BlockAcquired(first, samples, (1e-6, 2e-6), (10.0, 10.0), two, two, counts)


@pytest.mark.parametrize("message", MESSAGES, ids=lambda m: type(m).__name__)
def test_a_message_comes_out_as_it_went_in(message):
    assert read(io.BytesIO(encode(message))) == message


def test_samples_travel_to_the_bit():
    sent = block()
    received = read(io.BytesIO(encode(Happened(sent))))
    assert received.event == sent
    assert received.event.counts.dtype == np.int32
    assert np.array_equal(received.event.counts, sent.counts)


def test_samples_out_of_order_in_memory_travel_too():
    counts = np.asfortranarray(block().counts)
    sent = BlockAcquired(0, 5, (1.0, 1.0), (1.0, 1.0), (False,) * 2, (False,) * 2, counts)
    assert np.array_equal(read(io.BytesIO(encode(Happened(sent)))).event.counts, counts)


def test_messages_follow_each_other_and_then_the_pipe_ends():
    pipe = io.BytesIO(b"".join(encode(m) for m in MESSAGES))
    assert [read(pipe) for _ in MESSAGES] == list(MESSAGES)
    assert read(pipe) is None


@pytest.mark.parametrize("left", [0, 3, 8, 20, -1])
def test_a_message_broken_off_is_the_end(left):
    assert read(io.BytesIO(encode(MESSAGES[0])[:left])) is None


@pytest.mark.parametrize(
    "text",
    [
        '{"says": "Nothing"}',
        '{"says": ["Decided"]}',
        '{"says": "Decided", "what": "smashed"}',
        '{"event": "Nothing"}',
        '{"event": "StepBegan", "step": 1}',
        '{"says": "Happened", "event": {}}',
        "[]",
        "no JSON",
    ],
)
def test_what_is_no_message_is_refused(text):
    frame = len(text).to_bytes(4, "little") + bytes(4) + text.encode()
    with pytest.raises(ValueError, match=r".+"):
        read(io.BytesIO(frame))


def test_an_absurd_length_is_refused_before_it_is_read():
    with pytest.raises(ValueError, match="bytes"):
        read(io.BytesIO(b"\xff" * 100))


def test_samples_that_do_not_fit_their_block_are_refused():
    frame = bytearray(encode(Happened(block())))
    frame[4:8] = (36).to_bytes(4, "little")
    with pytest.raises(ValueError, match="reshape"):
        read(io.BytesIO(bytes(frame)))


def test_every_kind_of_message_can_be_sent():
    shown = {type(m).__name__ for m in MESSAGES}
    bare = set(Message.known) - shown
    assert bare
    assert all(read(io.BytesIO(encode(Message.known[n]()))) == Message.known[n]() for n in bare)
