"""Messages on a pipe: two lengths, a JSON object, and the samples of a block as they are.

    u32 length of the JSON, u32 length of the samples, JSON (UTF-8), int32 samples; all numbers little-endian

An event goes as the line it is in a session file, any other message under its name. What is read is checked
against the message's own types: nothing of it is ever run.
"""

import json
import struct
from dataclasses import replace
from functools import cache
from typing import IO, Any

import numpy as np
from pydantic import TypeAdapter

import instrument.stream.derived  # noqa: F401 -- an event is known by its name once its class is
from instrument.engine.messages import Happened, Message
from instrument.stream.event import from_line, to_line
from instrument.stream.raw import BlockAcquired

_LENGTHS = struct.Struct("<II")
_MOST_BYTES = 1 << 28
"""Of one frame's parts: beyond it the stream is not one of ours."""
_COUNTS = np.dtype("<i4")


def encode(message: Message) -> bytes:
    """One frame. Raises `ValueError` for numbers that JSON does not know."""
    samples = b""
    if isinstance(message, Happened):
        text = to_line(message.event)
        if isinstance(message.event, BlockAcquired):
            samples = np.ascontiguousarray(message.event.counts, _COUNTS).tobytes()
    else:
        facts = _adapter(type(message).__name__).dump_python(message, mode="json")
        text = json.dumps({"says": type(message).__name__, **facts}, allow_nan=False)
    head = text.encode()
    return b"".join((_LENGTHS.pack(len(head), len(samples)), head, samples))


def read(file: IO[bytes]) -> Message | None:
    """Wait for the next message; None at the end of the pipe. Raises `ValueError` for what is none."""
    lengths = file.read(_LENGTHS.size)
    if len(lengths) < _LENGTHS.size:
        return None
    sizes = _LENGTHS.unpack(lengths)
    if max(sizes) > _MOST_BYTES:
        raise ValueError(f"a message of {max(sizes)} bytes, expected at most {_MOST_BYTES}")
    head, samples = (file.read(size) for size in sizes)
    if (len(head), len(samples)) != sizes:
        return None
    return _message(head.decode(), samples)


def _message(text: str, samples: bytes) -> Message:
    if text.startswith('{"event"'):
        return Happened(_with_samples(text, samples))
    facts = json.loads(text)
    name = str(facts.pop("says", "")) if isinstance(facts, dict) else ""
    if name not in Message.known or name == Happened.__name__:
        raise ValueError(f"no message is called {name!r}")
    message: Message = _adapter(name).validate_python(facts)
    return message


def _with_samples(line: str, samples: bytes) -> Any:
    event = from_line(line)
    if not isinstance(event, BlockAcquired) or not samples:
        return event
    counts = np.frombuffer(samples, _COUNTS).reshape(len(event.volts_per_count), event.samples)
    return replace(event, counts=counts)


@cache
def _adapter(name: str) -> TypeAdapter[Any]:
    return TypeAdapter(Message.known[name])
