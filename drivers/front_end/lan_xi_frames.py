"""The LAN-XI stream: bytes to messages and back. No I/O.

One rule: however the bytes are split, the messages are the same. `Decoder.feed` takes what arrived and
returns the messages that are complete.

    header, 28 bytes    "BK", u16 header length (20: from the type to the ticks), u16 type, u16 and u32
                        reserved, 4 x u8 time family (k, l, m, n), u64 ticks, u32 content length
    1 data              u16 signals, u16 reserved, then of each: s16 id, s16 count, count x 24-bit signed
    2 quality           u16 signals, then of each: u16 id, u16 flags, u16 reserved
    8 interpretation    one after the other: u16 id, u16 descriptor, u16 reserved, u16 value length, value,
                        padded to 4

All little-endian. A second has 2^k 3^l 5^m 7^n ticks. A value is sample / 2^23 x scale factor. Signals count
from 1 in the order of the enabled channels. Quality is sent when it changes, and holds from its time on.

Source: HBK's public Open API tutorials (`openapi_message.ksy`) and Wireshark dissector.
"""

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum, IntFlag

import numpy as np
from numpy.typing import NDArray

from drivers.errors import Garbled

Counts = NDArray[np.int32]

HEADER_BYTES = 28
LONGEST_CONTENT = 1 << 24
"""Bytes; 12 channels with all the samples a block can count are a tenth of it."""
FULL_SCALE_COUNTS = 1 << 23

_HEADER = struct.Struct("<2sHHHI4BQI")
_DESCRIPTOR = struct.Struct("<HHHH")
_SIGNAL = struct.Struct("<hh")
_QUALITY = struct.Struct("<HHH")
_HEADER_LENGTH = 20


class MessageType(IntEnum):
    """Kinds of messages, as a message's header numbers them."""

    DATA = 1
    QUALITY = 2
    INTERPRETATION = 8


class Flags(IntFlag):
    """Bits of a quality message."""

    NONE = 0
    UNKNOWN = 1
    OVERLOAD = 2
    SETTLING = 4
    INVALID = 8
    """The sensor's conditioning is at fault: an open or shorted cable."""
    OVERRUN = 16
    """Samples were lost on the way out."""


class DescriptorType(IntEnum):
    """Numbers of what an interpretation message describes."""

    DATA_TYPE = 1
    SCALE_FACTOR = 2
    OFFSET = 3
    PERIOD_TIME = 4
    UNIT = 5
    VECTOR_LENGTH = 6
    CHANNEL_TYPE = 7


@dataclass(frozen=True)
class Time:
    """A moment or a period on the device's clock."""

    ticks: int
    family: tuple[int, int, int, int] = (32, 0, 0, 0)
    """Powers of 2, 3, 5 and 7 in a second. The devices known stamp with 2^32."""

    @property
    def ticks_per_s(self) -> int:
        """Exact."""
        k, l, m, n = self.family  # noqa: E741
        return int(2**k * 3**l * 5**m * 7**n)

    @property
    def seconds(self) -> float:
        """Rounded to a double."""
        return self.ticks / self.ticks_per_s


@dataclass(frozen=True, eq=False)
class Signal:
    """Samples in a row of one channel."""

    id: int
    counts: Counts


@dataclass(frozen=True)
class Data:
    """Samples; the time is that of the first one of each signal."""

    time: Time
    signals: tuple[Signal, ...]


@dataclass(frozen=True)
class Quality:
    """Flags that hold from this time on."""

    time: Time
    flags: tuple[tuple[int, Flags], ...]
    """By id of signal."""


@dataclass(frozen=True)
class Descriptor:
    """One thing to know of a signal before its samples."""

    id: int
    type: int
    value: float | str | Time | bytes
    """Bytes where the type is not known."""


@dataclass(frozen=True)
class Interpretation:
    """What is needed to read the samples."""

    time: Time
    descriptors: tuple[Descriptor, ...]


@dataclass(frozen=True)
class Other:
    """A message of a type that does not matter here, as CAN."""

    time: Time
    type: int


Message = Data | Quality | Interpretation | Other


class Decoder:
    """Bytes in, messages out.

    After `Garbled` there is no way back: nothing marks where the next message begins.
    """

    def __init__(self) -> None:
        self._buffer = bytearray()

    def feed(self, received: bytes) -> list[Message]:
        """Take in received bytes: the messages that are now complete. Raises `Garbled`."""
        self._buffer += received
        messages: list[Message] = []
        done = 0
        while len(self._buffer) - done >= HEADER_BYTES:
            message_type, time, length = _header(self._buffer, done)
            end = done + HEADER_BYTES + length
            if len(self._buffer) < end:
                break
            messages.append(_message(message_type, time, bytes(self._buffer[done + HEADER_BYTES : end])))
            done = end
        del self._buffer[:done]
        return messages


def encode(message: Data | Quality | Interpretation) -> bytes:
    """One message with its header."""
    if isinstance(message, Data):
        return _frame(MessageType.DATA, message.time, _data_content(message.signals))
    if isinstance(message, Quality):
        content = b"".join(_QUALITY.pack(id, flags, 0) for id, flags in message.flags)
        return _frame(MessageType.QUALITY, message.time, struct.pack("<H", len(message.flags)) + content)
    content = b"".join(_descriptor_content(d) for d in message.descriptors)
    return _frame(MessageType.INTERPRETATION, message.time, content)


def unpack_24(content: bytes, start: int, samples: int) -> Counts:
    """`samples` 24-bit numbers from byte `start` on, which is not the first byte."""
    # Four bytes from one before each sample, shifted down arithmetically: sign and all, in one pass.
    wide = np.ndarray((samples,), np.dtype("<i4"), content, offset=start - 1, strides=(3,))
    return np.right_shift(wide, 8).astype(np.int32, copy=False)


def pack_24(counts: Counts) -> bytes:
    """The low 24 bits of each."""
    wide = np.ascontiguousarray(counts, "<i4").view(np.uint8).reshape(-1, 4)
    narrow = np.empty((counts.size, 3), np.uint8)
    for byte in range(3):
        narrow[:, byte] = wide[:, byte]
    return narrow.tobytes()


def _header(buffer: bytearray, start: int) -> tuple[int, Time, int]:
    magic, rest, message_type, _, _, k, l, m, n, ticks, length = _HEADER.unpack_from(buffer, start)  # noqa: E741
    if magic != b"BK" or rest != _HEADER_LENGTH:
        begin = bytes(buffer[start : start + 4])
        raise Garbled(f"stream: a message begins with {begin!r}, expected b'BK\\x14\\x00'")
    if length > LONGEST_CONTENT:
        raise Garbled(f"stream: a message of {length} bytes (limit {LONGEST_CONTENT})")
    return message_type, Time(ticks, (k, l, m, n)), length


def _message(message_type: int, time: Time, content: bytes) -> Message:
    try:
        if message_type == MessageType.DATA:
            return Data(time, _signals(content))
        if message_type == MessageType.QUALITY:
            return Quality(time, _flags(content))
        if message_type == MessageType.INTERPRETATION:
            return Interpretation(time, _descriptors(content))
    except (struct.error, UnicodeDecodeError) as error:
        raise Garbled(f"stream: message of type {message_type}, {len(content)} bytes: {error}") from error
    return Other(time, message_type)


def _signals(content: bytes) -> tuple[Signal, ...]:
    expected, _ = struct.unpack_from("<HH", content)
    found, at = [], 4
    for _ in range(expected):
        id, samples = _SIGNAL.unpack_from(content, at)
        at += _SIGNAL.size
        if samples < 0 or at + 3 * samples > len(content):
            raise Garbled(f"stream: {samples} samples of signal {id} in {len(content) - at} bytes")
        found.append(Signal(id, unpack_24(content, at, samples)))
        at += 3 * samples
    # The device may round the length up; more than that is not ours to guess.
    if len(content) - at > 3:
        raise Garbled(f"stream: {len(content) - at} bytes after the last of {expected} signals")
    return tuple(found)


def _flags(content: bytes) -> tuple[tuple[int, Flags], ...]:
    (expected,) = struct.unpack_from("<H", content)
    blocks = [_QUALITY.unpack_from(content, 2 + _QUALITY.size * k) for k in range(expected)]
    return tuple((id, Flags(flags)) for id, flags, _ in blocks)


def _descriptors(content: bytes) -> tuple[Descriptor, ...]:
    found, at = [], 0
    while at < len(content):
        id, descriptor, _, length = _DESCRIPTOR.unpack_from(content, at)
        at += _DESCRIPTOR.size
        if at + length > len(content):
            raise Garbled(f"stream: a value of {length} bytes in {len(content) - at}")
        found.append(Descriptor(id, descriptor, _value(descriptor, content[at : at + length])))
        at += -(-length // 4) * 4
    return tuple(found)


def _value(descriptor: int, value: bytes) -> float | str | Time | bytes:
    match descriptor:
        case DescriptorType.SCALE_FACTOR | DescriptorType.OFFSET:
            return float(struct.unpack_from("<d", value)[0])
        case DescriptorType.PERIOD_TIME:
            k, l, m, n, ticks = struct.unpack_from("<4BQ", value)  # noqa: E741
            return Time(ticks, (k, l, m, n))
        case DescriptorType.UNIT:
            (length,) = struct.unpack_from("<H", value)
            return value[2 : 2 + length].decode("utf-8")
        case DescriptorType.DATA_TYPE | DescriptorType.VECTOR_LENGTH | DescriptorType.CHANNEL_TYPE:
            # Two bytes in one of the maker's descriptions, four in another: the length said so.
            return float(int.from_bytes(value, "little"))
    return value


def _frame(message_type: MessageType, time: Time, content: bytes) -> bytes:
    header = _HEADER.pack(b"BK", _HEADER_LENGTH, message_type, 0, 0, *time.family, time.ticks, len(content))
    return header + content


def _data_content(signals: Sequence[Signal]) -> bytes:
    pieces = [struct.pack("<HH", len(signals), 0)]
    for signal in signals:
        pieces += [_SIGNAL.pack(signal.id, signal.counts.size), pack_24(signal.counts)]
    return b"".join(pieces)


def _descriptor_content(descriptor: Descriptor) -> bytes:
    value = _value_bytes(descriptor)
    head = _DESCRIPTOR.pack(descriptor.id, descriptor.type, 0, len(value))
    return head + value + bytes(-len(value) % 4)


def _value_bytes(descriptor: Descriptor) -> bytes:
    value = descriptor.value
    if isinstance(value, Time):
        return struct.pack("<4BQ", *value.family, value.ticks)
    if isinstance(value, str):
        text = value.encode("utf-8")
        return struct.pack("<H", len(text)) + text
    if isinstance(value, bytes):
        return value
    if descriptor.type in (DescriptorType.SCALE_FACTOR, DescriptorType.OFFSET):
        return struct.pack("<d", value)
    return struct.pack("<H", int(value))
