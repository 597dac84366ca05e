"""A queue of messages between two threads in which old blocks of samples give way, and nothing else does."""

import threading
from collections import deque
from dataclasses import dataclass

from instrument.engine.messages import BlocksDropped, Happened, Message
from instrument.stream.raw import BlockAcquired

MOST_SAMPLES = 4_000_000
"""Of all channels together, in the blocks that wait: 16 MB."""


@dataclass
class _Place:
    message: Message | None
    """None: a block that was dropped."""


class Mailbox:
    """Putting never waits. Where blocks were dropped, `BlocksDropped` stands in their place."""

    def __init__(self, most_samples: int = MOST_SAMPLES) -> None:
        self._most_samples, self._samples = most_samples, 0
        self._changed = threading.Condition()
        self._line: deque[_Place] = deque()
        self._blocks: deque[tuple[_Place, int]] = deque()
        """Those in line that may be dropped, and how many samples each holds."""
        self._closed = False

    def put(self, message: Message) -> None:
        """To the end of the line; what comes after `close` is forgotten."""
        with self._changed:
            if self._closed:
                return
            place = _Place(message)
            self._line.append(place)
            if isinstance(message, Happened) and isinstance(message.event, BlockAcquired):
                self._blocks.append((place, message.event.counts.size))
                self._samples += message.event.counts.size
                self._make_room()
            self._changed.notify()

    def take(self) -> Message | None:
        """Wait for the next message; None once it is closed and empty."""
        with self._changed:
            self._changed.wait_for(lambda: self._line or self._closed)
            return self._next()

    def drain(self, most: int | None = None) -> list[Message]:
        """What there is, at most so many; never waits."""
        found: list[Message] = []
        with self._changed:
            while self._line and (most is None or len(found) < most):
                message = self._next()
                assert message is not None
                found.append(message)
        return found

    def close(self) -> None:
        """Nothing more comes."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()

    def _make_room(self) -> None:
        # The newest block stays, however large: it is what is looked at.
        while self._samples > self._most_samples and len(self._blocks) > 1:
            place, samples = self._blocks.popleft()
            place.message = None
            self._samples -= samples

    def _next(self) -> Message | None:
        dropped = 0
        while self._line and self._line[0].message is None:
            self._line.popleft()
            dropped += 1
        if dropped:
            return BlocksDropped(dropped)
        if not self._line:
            return None
        place = self._line.popleft()
        if self._blocks and self._blocks[0][0] is place:
            self._samples -= self._blocks.popleft()[1]
        return place.message
