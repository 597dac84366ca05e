"""Messages that wait: nothing waits for them, and only blocks are dropped."""

import threading

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from instrument.engine.mailbox import Mailbox
from instrument.engine.messages import BlocksDropped, Happened, Logged
from instrument.stream.raw import BlockAcquired


def block(number: int) -> Happened:
    counts = np.zeros((1, 10), np.int32)
    return Happened(BlockAcquired(number, 10, (1.0,), (1.0,), (False,), (False,), counts))


def test_old_blocks_give_way_where_they_stood():
    box = Mailbox(most_samples=20)
    said = Logged("", "INFO", "kept")
    for message in (block(1), said, block(2), block(3), said, block(4)):
        box.put(message)
    assert box.drain() == [BlocksDropped(1), said, BlocksDropped(1), block(3), said, block(4)]


@given(st.lists(st.booleans(), max_size=60), st.integers(0, 60))
def test_whatever_comes_the_others_are_all_there_and_every_block_is_counted(kinds, taken_after):
    box = Mailbox(most_samples=30)
    received = []
    for k, is_block in enumerate(kinds):
        box.put(block(k) if is_block else Logged("", "INFO", str(k)))
        if k == taken_after:
            received += box.drain()
    received += box.drain()
    texts = [m.text for m in received if isinstance(m, Logged)]
    assert texts == [str(k) for k, is_block in enumerate(kinds) if not is_block]
    dropped = sum(m.count for m in received if isinstance(m, BlocksDropped))
    assert dropped + sum(isinstance(m, Happened) for m in received) == sum(kinds)


def test_a_block_larger_than_the_room_is_kept_while_it_is_the_newest():
    box = Mailbox(most_samples=5)
    box.put(block(1))
    assert box.drain() == [block(1)]


def test_drain_gives_no_more_than_asked_for():
    box = Mailbox()
    for k in range(5):
        box.put(block(k))
    assert box.drain(2) == [block(0), block(1)]
    assert len(box.drain()) == 3


def test_take_waits_for_a_message_and_ends_with_the_box():
    box, taken = Mailbox(), []

    def work() -> None:
        while (message := box.take()) is not None:
            taken.append(message)

    thread = threading.Thread(target=work)
    thread.start()
    box.put(block(1))
    box.put(block(2))
    box.close()
    thread.join(10)
    assert taken == [block(1), block(2)]
    box.put(block(3))
    assert box.drain() == []
