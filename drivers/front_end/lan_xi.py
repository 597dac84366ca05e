"""An HBK LAN-XI module, over its open interface: JSON over HTTP to set it, a TCP stream of samples.

One rule: the module is taken over as it is found. A program that was killed leaves it open or even recording;
it is stopped, finished and closed first.

With `paced_by_reader` the driver reads from the simulated module in virtual time: before it waits for samples
it sends, on the stream's own connection, how many it lacks as a 32-bit little-endian number. That is the
simulator's extension; a real module is never sent anything.
"""

import socket
import struct
import time
from contextlib import suppress
from typing import Any, NoReturn

import numpy as np

from drivers.errors import DriverError, Refused, TimedOut, Unreachable
from drivers.front_end import lan_xi_documents as documents
from drivers.front_end.interface import Block, InputChannel, Transducer
from drivers.front_end.lan_xi_address import host_of
from drivers.front_end.lan_xi_documents import ChannelSetup
from drivers.front_end.lan_xi_frames import Decoder
from drivers.front_end.lan_xi_http import ModuleHttp
from drivers.front_end.lan_xi_stream import StreamReader

_DETECTION_S = 60.0
"""Sensors with a chip are read one by one; longer than this the module hangs."""
_POLL_S = 0.05
_PIECE_BYTES = 1 << 20
_CREDIT = struct.Struct("<I")


class LanXiFrontEnd:
    """A `FrontEnd`.

    Parameters
    ----------
    url
        `http://<address>`.
    timeout_s
        For one request, and for silence of the stream.
    retries
        More attempts to connect.
    paced_by_reader
        Of the simulated module only, see the module's docstring.
    take_over
        False to ask who it is and no more: the module is left as it is, and cannot be started.

    Raises
    ------
    Unreachable, TimedOut, Garbled, Refused
    """

    def __init__(
        self,
        url: str,
        *,
        timeout_s: float = 5.0,
        retries: int = 2,
        paced_by_reader: bool = False,
        take_over: bool = True,
    ) -> None:
        self._url, self._timeout_s, self._paced = url.rstrip("/"), timeout_s, paced_by_reader
        try:
            self._host = host_of(self._url)
        except ValueError as error:
            raise Refused(f"LAN-XI: {error}") from None
        self._http = ModuleHttp(self._url, self._me, timeout_s, retries)
        self._socket: socket.socket | None = None
        self._reader: StreamReader | None = None
        self._decoder = Decoder()
        self._sample_rate_hz, self._taken = 0.0, take_over
        self.transducers: tuple[Transducer | None, ...] = ()
        """Of the sensors that say who they are, by input."""
        try:
            self._info = documents.read_module_info(self._http.json("/module/info"))
            if take_over:
                self._take_over()
                self.transducers = self._detect()
        except BaseException:
            self._http.close()
            raise

    @property
    def sample_rate_hz(self) -> float:
        """As the device runs, after `start`."""
        return self._sample_rate_hz

    def identity(self) -> str:
        """Model and serial number, as the device states them."""
        return f"LAN-XI {self._info.type}, serial number {self._info.serial}"

    def objection(self, channels: tuple[InputChannel, ...], sample_rate_hz: float) -> str:
        """Why it would refuse to start with these; empty where it would not."""
        try:
            documents.choose_rate(self._info, sample_rate_hz)
            self._setups(channels)
        except Refused as refusal:
            return str(refusal)
        return ""

    def start(self, channels: tuple[InputChannel, ...], sample_rate_hz: float) -> None:
        """Begin to sample; index 0 is the first sample after it. Refused where the rate is not to be had."""
        if not self._taken:
            raise Refused(f"{self._me}: it was only asked who it is")
        if self._reader is not None:
            raise Refused(f"{self._me}: it is sampling: stop it first")
        rate_hz = documents.choose_rate(self._info, sample_rate_hz)
        setups = self._setups(channels)
        self._http.request("PUT", "/create")
        try:
            default = self._http.json("/channels/input/default")
            self._http.request("PUT", "/channels/input", documents.fill_setup(default, setups, rate_hz))
            self._connect(documents.read_port(self._http.json("/destination/socket")))
            self._decoder = Decoder()
            # The device counts its signals in the order of its inputs, whatever the order asked for.
            order = sorted(range(len(setups)), key=lambda k: setups[k].number)
            self._order = np.argsort(order)
            full_scale_v = np.array([setups[k].range_v for k in order])
            self._reader = StreamReader(full_scale_v, rate_hz)
            self._sample_rate_hz = rate_hz
            self._http.request("POST", "/measurements")
        except BaseException:
            with suppress(DriverError):
                self._stop()
            raise

    def read(self, samples: int) -> Block:
        """The next `samples` of each channel, none lost, or a `DriverError`."""
        reader = self._reader
        if reader is None:
            raise Refused(f"{self._me}: it is not sampling: start it first")
        if self._paced and reader.available < samples:
            self._send_credit(samples - reader.available)
        had, deadline = reader.available, time.monotonic() + self._timeout_s
        while reader.available < samples:
            for message in self._decoder.feed(self._receive()):
                reader.take(message)
            # Bytes that trickle in, or a channel that gives none, are no samples: the time-out is of those.
            if reader.available > had:
                had, deadline = reader.available, time.monotonic() + self._timeout_s
            elif time.monotonic() > deadline:
                raise TimedOut(
                    f"{self._me}: the stream has had no sample of every channel for {self._timeout_s:g} s"
                )
        return _in_order(reader.block(samples), self._order)

    def stop(self) -> None:
        """End sampling. Works in any state, also twice."""
        if self._reader is not None:
            self._stop()

    def close(self) -> None:
        """Let go of the connection; the module goes back to idle if it still answers."""
        if self._http.is_closed:
            return
        if self._taken:
            with suppress(DriverError):
                self.stop()
            with suppress(DriverError):
                self._http.request("PUT", "/close")
        self._disconnect()
        self._http.close()

    @property
    def _me(self) -> str:
        return f"front-end at {self._url}"

    def _setups(self, channels: tuple[InputChannel, ...]) -> list[ChannelSetup]:
        numbers = [channel.number for channel in channels]
        if not numbers or len(set(numbers)) < len(numbers):
            raise Refused(f"{self._me}: channels {numbers}: expected one or more, each once")
        for number in numbers:
            if not 1 <= number <= self._info.inputs:
                raise Refused(
                    f"{self._me}: channel {number}: {self._info.type} has inputs 1 to {self._info.inputs}"
                )
        return [
            ChannelSetup(c.number, c.name, documents.choose_range(self._info, c.range_v), c.iepe)
            for c in channels
        ]

    def _take_over(self) -> None:
        """Bring the module, whatever state a program left it in, to an open recorder."""
        state, _, _ = documents.read_status(self._http.json("/onchange"))
        undo = {
            documents.RECORDING: ("/measurements/stop", "/finish", "/close"),
            documents.STREAMING: ("/finish", "/close"),
            documents.CONFIGURING: ("/finish", "/close"),
            documents.OPENED: ("/close",),
        }
        for path in undo.get(state, ()):
            # States this driver does not know of lie between: what matters is that it opens in the end.
            with suppress(Refused):
                self._http.request("PUT", path)
        self._http.request("PUT", "/open", documents.OPEN_PARAMETERS)

    def _detect(self) -> tuple[Transducer | None, ...]:
        self._http.request("POST", "/channels/input/all/transducers/detect")
        deadline = time.monotonic() + _DETECTION_S
        tag, active = 0, True
        while True:
            _, tag, active = documents.read_status(self._http.json("/onchange", last=tag))
            if not active:
                return documents.read_transducers(self._http.json("/channels/input/all/transducers"))
            if time.monotonic() > deadline:
                raise TimedOut(
                    f"{self._me}: detecting sensors took over {_DETECTION_S:g} s: restart the module"
                )
            time.sleep(_POLL_S)

    def _stop(self) -> None:
        """The measurement first: a module whose reader goes away while it measures reports lost data."""
        problem: DriverError | None = None
        for path in ("/measurements/stop", "/finish"):
            try:
                self._http.request("PUT", path)
            except Refused:
                # Nothing to stop or to finish: a start that failed half way.
                continue
            except DriverError as error:
                problem = error
                break
        self._disconnect()
        self._reader = None
        if problem is not None:
            raise problem

    def _connect(self, port: int) -> None:
        self._disconnect()
        try:
            self._socket = socket.create_connection((self._host, port), self._timeout_s)
        except TimeoutError as error:
            raise TimedOut(f"{self._me}: no stream at port {port} in {self._timeout_s:g} s") from error
        except OSError as error:
            raise Unreachable(f"{self._me}: no stream at port {port}: {error}") from error
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def _disconnect(self) -> None:
        if self._socket is not None:
            # Closing alone does not wake a thread that waits in `recv`.
            with suppress(OSError):
                self._socket.shutdown(socket.SHUT_RDWR)
            self._socket.close()
        self._socket = None

    def _send_credit(self, samples: int) -> None:
        try:
            self._stream().sendall(_CREDIT.pack(samples))
        except OSError as error:
            self._lost(error)

    def _receive(self) -> bytes:
        try:
            received = self._stream().recv(_PIECE_BYTES)
        except TimeoutError as error:
            raise TimedOut(f"{self._me}: the stream is silent for {self._timeout_s:g} s") from error
        except OSError as error:
            self._lost(error)
        if not received:
            self._lost("it was closed by the module")
        return received

    def _stream(self) -> socket.socket:
        if self._socket is None:
            raise OSError("it is not connected")
        return self._socket

    def _lost(self, why: object) -> NoReturn:
        raise Unreachable(f"{self._me}: the stream broke off: {why}: samples are lost")


def _in_order(block: Block, order: Any) -> Block:
    """Rows by the order asked for."""
    if np.array_equal(order, np.arange(len(order))):
        return block
    return Block(
        first_sample=block.first_sample,
        counts=block.counts[order],
        volts_per_count=block.volts_per_count[order],
        full_scale_v=block.full_scale_v[order],
        overload=block.overload[order],
        cable_fault=block.cable_fault[order],
    )


def module_identity(url: str) -> str:
    """Model and serial number of the module there, whatever it does just now. Raises `DriverError`."""
    module = LanXiFrontEnd(url, take_over=False)
    try:
        return module.identity()
    finally:
        module.close()


def module_objection(url: str, channels: tuple[InputChannel, ...], sample_rate_hz: float) -> str:
    """Why the module there cannot sample these, whatever it does just now. Raises `DriverError`."""
    module = LanXiFrontEnd(url, take_over=False)
    try:
        return module.objection(channels, sample_rate_hz)
    finally:
        module.close()
