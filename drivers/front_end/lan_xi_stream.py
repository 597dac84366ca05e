"""Messages of the LAN-XI stream to blocks of samples. No I/O.

One rule: a block has every sample since the last one, or there is no block. Flags are put into the block they
fall in by their time stamp, whenever they arrive.
"""

from collections import deque

import numpy as np
from numpy.typing import NDArray

from drivers.errors import DriverError, Garbled
from drivers.front_end.interface import Block
from drivers.front_end.lan_xi_frames import (
    FULL_SCALE_COUNTS,
    Counts,
    Data,
    DescriptorType,
    Flags,
    Interpretation,
    Message,
    Quality,
    Time,
)


class StreamReader:
    """Gathers what `Decoder` gives.

    Parameters
    ----------
    full_scale_v
        Nominal range of each channel, shape (channels,). Signal k + 1 is channel k of them.
    sample_rate_hz
        As set; the stream's own statement has to agree.
    """

    def __init__(self, full_scale_v: NDArray[np.float64], sample_rate_hz: float) -> None:
        self._full_scale_v, self._sample_rate_hz = full_scale_v, sample_rate_hz
        channels = len(full_scale_v)
        self._scale = np.full(channels, np.nan)
        self._pieces: list[deque[Counts]] = [deque() for _ in range(channels)]
        self._arrived = [0] * channels
        self._taken = 0
        self._block_begin = 0
        self._start: Time | None = None
        self._changes: deque[tuple[Time, int, Flags]] = deque()
        self._flags = [Flags.NONE] * channels

    @property
    def available(self) -> int:
        """Samples that every channel has."""
        return min(self._arrived) - self._taken

    def take(self, message: Message) -> None:
        """Raises `Garbled`, and `DriverError` where samples were lost."""
        if isinstance(message, Data):
            self._take_data(message)
        elif isinstance(message, Quality):
            for id, flags in message.flags:
                if flags & Flags.OVERRUN:
                    raise DriverError(
                        f"samples of signal {id} were lost in the device: the network is too slow"
                    )
                self._changes.append((message.time, self._index(id), flags))
        elif isinstance(message, Interpretation):
            self._take_interpretation(message)

    def block(self, samples: int) -> Block:
        """The next `samples`, which have to be available."""
        first = self._taken
        counts = np.empty((len(self._pieces), samples), np.int32)
        for row, pieces in zip(counts, self._pieces, strict=True):
            _fill(row, pieces)
        self._taken += samples
        flags = self._flags_until(self._taken)
        return Block(
            first_sample=first,
            counts=counts,
            volts_per_count=self._scale / FULL_SCALE_COUNTS,
            full_scale_v=self._full_scale_v.copy(),
            overload=np.array([bool(f & Flags.OVERLOAD) for f in flags]),
            cable_fault=np.array([bool(f & Flags.INVALID) for f in flags]),
        )

    def _index(self, id: int) -> int:
        if not 1 <= id <= len(self._pieces):
            raise Garbled(f"stream: signal {id}, expected 1 to {len(self._pieces)}")
        return id - 1

    def _take_data(self, message: Data) -> None:
        if self._start is None:
            self._start = message.time
        at = self._sample_at(message.time)
        for signal in message.signals:
            k = self._index(signal.id)
            if np.isnan(self._scale[k]):
                raise Garbled(f"stream: samples of signal {signal.id} before its scale factor")
            # Stamps are rounded to ticks: half a sample tells a gap from rounding.
            missing = at - self._arrived[k]
            if abs(missing) > 0.5:
                raise DriverError(
                    f"samples were lost: signal {signal.id} goes on at sample {at:.0f}, "
                    f"expected {self._arrived[k]}: the network is slower than the stream"
                )
            self._pieces[k].append(signal.counts)
            self._arrived[k] += signal.counts.size

    def _take_interpretation(self, message: Interpretation) -> None:
        for one in message.descriptors:
            if one.type == DescriptorType.SCALE_FACTOR and isinstance(one.value, float):
                if not 0 < one.value < np.inf:
                    raise Garbled(f"stream: signal {one.id} has a scale factor of {one.value}")
                self._scale[self._index(one.id)] = one.value
            elif one.type == DescriptorType.UNIT and one.value != "V":
                raise Garbled(f"stream: signal {one.id} is in {one.value!r}, expected 'V'")
            elif one.type == DescriptorType.PERIOD_TIME and isinstance(one.value, Time):
                period_s, expected_s = one.value.seconds, 1 / self._sample_rate_hz
                if abs(period_s - expected_s) > 1e-4 * expected_s:
                    stated = f"signal {one.id}: a sample every {period_s:.6g} s"
                    raise Garbled(f"stream: {stated}, expected {expected_s:.6g} s")

    def _sample_at(self, time: Time) -> float:
        """Index of the sample at a stamp. In whole ticks first: stamps are large."""
        if self._start is None or time.family != self._start.family:
            raise Garbled("stream: the time family changed")
        return (time.ticks - self._start.ticks) / time.ticks_per_s * self._sample_rate_hz

    def _flags_until(self, end: int) -> list[Flags]:
        """Of the block up to sample `end`: what held at its begin, and whatever came up in it."""
        begin = [*self._flags]
        seen = [Flags.NONE] * len(begin)
        later: deque[tuple[Time, int, Flags]] = deque()
        first = self._block_begin
        for time, k, flags in self._changes:
            at = self._sample_at(time)
            if at > end - 0.5:
                later.append((time, k, flags))
                continue
            self._flags[k] = flags
            if at <= first + 0.5:
                begin[k] = flags
            else:
                seen[k] |= flags
        self._changes = later
        self._block_begin = end
        return [a | b for a, b in zip(begin, seen, strict=True)]


def _fill(row: Counts, pieces: deque[Counts]) -> None:
    filled = 0
    while filled < row.size:
        piece = pieces.popleft()
        used = min(piece.size, row.size - filled)
        row[filled : filled + used] = piece[:used]
        filled += used
        if used < piece.size:
            pieces.appendleft(piece[used:])
