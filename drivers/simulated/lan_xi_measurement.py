"""The simulated LAN-XI module's stream: samples of a `Source`, framed and sent at one of two paces.

Pace "real" makes samples by the wall clock and drops none. Pace "asked" makes as many as the reader asks for,
on the stream's connection, as 32-bit little-endian numbers: virtual time, the simulator's extension.
"""

import select
import socket
import struct
import time
from contextlib import suppress
from dataclasses import dataclass
from threading import Event, Lock, Thread
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from drivers.front_end import lan_xi_frames as frames
from drivers.front_end.lan_xi_frames import Descriptor, DescriptorType, Flags, Signal, Time

BLOCK_SAMPLES = 8192
"""Most samples of one data message, and of one `acquire`."""
_SHORTEST_BLOCK_S = 0.02
"""In real pace: fewer messages a second than this allows."""
_ACCEPT_S = 5.0
_CREDIT = struct.Struct("<I")


@dataclass(frozen=True)
class Acquired:
    """Samples in a row from every channel."""

    first_sample: int
    counts: NDArray[np.int32]
    """Shape (channels, samples), within 24 bits."""
    overload: NDArray[np.bool_]
    """Shape (channels,): somewhere in these samples."""
    cable_fault: NDArray[np.bool_]
    """Shape (channels,)."""


class Source(Protocol):
    """What the inputs are connected to. Called from the server's threads, one call at a time."""

    def start(
        self, channel_numbers: tuple[int, ...], full_scale_v: NDArray[np.float64], sample_rate_hz: float
    ) -> None:
        """Sampling begins: index 0 comes next.

        `full_scale_v`, shape (channels,), is what 2^23 counts stand for: the nominal range and the headroom
        above it. A volt is 2^23 / full_scale_v counts.
        """
        ...

    def acquire(self, samples: int) -> Acquired:
        """The next samples of every input."""
        ...

    def stop(self) -> None:
        """Sampling has ended."""
        ...


class Measurement:
    """A thread that sends what the source gives, from now until its end."""

    def __init__(
        self,
        source: Source,
        listener: socket.socket,
        full_scale_v: NDArray[np.float64],
        sample_rate_hz: float,
        *,
        asked: bool,
    ) -> None:
        self._source, self._listener, self._asked = source, listener, asked
        self._full_scale_v, self._rate_hz = full_scale_v, sample_rate_hz
        self._epoch_ticks = int(time.time()) << 32
        self._ids = range(1, len(full_scale_v) + 1)
        self._flags = [Flags.NONE] * len(full_scale_v)
        self._seen = [Flags.NONE] * len(full_scale_v)
        self._lost, self._lost_flagged = 0, False
        self._stop, self.garbage, self.hung = Event(), Event(), Event()
        self._connection: socket.socket | None = None
        self._connection_lock = Lock()
        # Readable once the stream is to end: it wakes whoever waits for the reader.
        self._wake, self._waker = socket.socketpair()
        self._thread = Thread(target=self._run, name="lan-xi stream")
        self._thread.start()

    def end(self) -> None:
        """Stop, and wait for the thread."""
        self._stop.set()
        self.cut()
        self._thread.join()
        self._wake.close()
        self._waker.close()

    def cut(self) -> None:
        """Break the connection off."""
        self._waker.sendall(b"x")
        with self._connection_lock, suppress(OSError):
            if self._connection is not None:
                self._connection.shutdown(socket.SHUT_RDWR)

    def lose(self, samples: int, *, flagged: bool) -> None:
        """Let so many samples go missing before the next ones, with or without a word about it."""
        self._lost, self._lost_flagged = samples, flagged

    def status(self) -> list[dict[str, str]]:
        """Of each channel, as `/onchange` says it: none, curr or prev."""

        def word(k: int, flag: Flags) -> str:
            return "curr" if self._flags[k] & flag else "prev" if self._seen[k] & flag else "none"

        return [
            {"anol": word(k, Flags.OVERLOAD), "cmol": "none", "cf": word(k, Flags.INVALID)}
            for k in range(len(self._flags))
        ]

    def _run(self) -> None:
        try:
            connection = self._accept()
            if connection is None:
                return
            with connection, suppress(OSError):
                connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                connection.sendall(frames.encode(self._interpretation()))
                self._pump_asked(connection) if self._asked else self._pump_real(connection)
        finally:
            self._source.stop()

    def _accept(self) -> socket.socket | None:
        ready, _, _ = select.select([self._listener, self._wake], [], [], _ACCEPT_S)
        if self._listener not in ready or self._wake in ready:
            return None
        connection, _ = self._listener.accept()
        with self._connection_lock:
            self._connection = connection
        return connection

    def _pump_real(self, connection: socket.socket) -> None:
        begun, sent = time.monotonic(), 0
        shortest = max(1, min(BLOCK_SAMPLES, int(self._rate_hz * _SHORTEST_BLOCK_S)))
        while not self._wake_is_readable(0.0):
            due = int((time.monotonic() - begun) * self._rate_hz) - sent
            if due < shortest:
                self._wake_is_readable((shortest - due) / self._rate_hz)
                continue
            sent += self._send(connection, min(due, BLOCK_SAMPLES))

    def _pump_asked(self, connection: socket.socket) -> None:
        received = b""
        while not self._stop.is_set():
            select.select([connection, self._wake], [], [])
            if self._wake_is_readable(0.0):
                return
            piece = connection.recv(4096)
            if not piece:
                return
            received += piece
            while len(received) >= _CREDIT.size:
                (credit,) = _CREDIT.unpack_from(received)
                received = received[_CREDIT.size :]
                while credit > 0:
                    credit -= self._send(connection, min(credit, BLOCK_SAMPLES))

    def _wake_is_readable(self, timeout_s: float) -> bool:
        ready, _, _ = select.select([self._wake], [], [], timeout_s)
        return bool(ready)

    def _send(self, connection: socket.socket, samples: int) -> int:
        """One block, its flags before it where they changed. Returns how many samples went out.

        Hung, nothing goes out though the connection stands; samples that nobody gets are not asked for in
        virtual time.
        """
        if self.hung.is_set():
            if not self._asked:
                self._source.acquire(samples)
            return samples
        if self._lost:
            self._lose(connection)
        acquired = self._source.acquire(samples)
        now = self._time(acquired.first_sample)
        changed = self._changed(acquired)
        out = [frames.encode(frames.Quality(now, changed))] if changed else []
        if self.garbage.is_set():
            self.garbage.clear()
            out.append(b"\x00garbage" * 8)
        rows = zip(self._ids, acquired.counts, strict=True)
        out.append(frames.encode(frames.Data(now, tuple(Signal(id, row) for id, row in rows))))
        connection.sendall(b"".join(out))
        return samples

    def _lose(self, connection: socket.socket) -> None:
        gone = self._source.acquire(self._lost)
        self._lost = 0
        if self._lost_flagged:
            overrun = tuple((id, Flags.OVERRUN) for id in self._ids)
            connection.sendall(frames.encode(frames.Quality(self._time(gone.first_sample), overrun)))

    def _changed(self, acquired: Acquired) -> tuple[tuple[int, Flags], ...]:
        changed = []
        for k, (overload, fault) in enumerate(zip(acquired.overload, acquired.cable_fault, strict=True)):
            flags = (Flags.OVERLOAD if overload else Flags.NONE) | (Flags.INVALID if fault else Flags.NONE)
            if flags != self._flags[k]:
                changed.append((self._ids[k], flags))
                self._flags[k] = flags
                self._seen[k] |= flags
        return tuple(changed)

    def _time(self, sample: int) -> Time:
        return Time(self._epoch_ticks + round(sample * 2**32 / self._rate_hz))

    def _interpretation(self) -> frames.Interpretation:
        descriptors: list[Descriptor] = []
        for id, scale in zip(self._ids, self._full_scale_v, strict=True):
            descriptors += [
                Descriptor(id, DescriptorType.DATA_TYPE, 3.0),
                Descriptor(id, DescriptorType.SCALE_FACTOR, float(scale)),
                Descriptor(id, DescriptorType.OFFSET, 0.0),
                Descriptor(id, DescriptorType.PERIOD_TIME, Time(round(2**32 / self._rate_hz))),
                Descriptor(id, DescriptorType.UNIT, "V"),
                Descriptor(id, DescriptorType.VECTOR_LENGTH, 0.0),
                Descriptor(id, DescriptorType.CHANNEL_TYPE, 1.0),
            ]
        return frames.Interpretation(self._time(0), tuple(descriptors))
