"""The simulated LAN-XI module: its recorder over HTTP on 127.0.0.1, samples from a `Source`.

One rule: the states are the real module's. A request in a wrong one is answered with 403.
"""

import json
import socket
from collections.abc import Callable, Mapping
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Lock, Thread
from types import MappingProxyType, TracebackType
from typing import Any, Literal
from urllib.parse import urlsplit

import numpy as np

from drivers.errors import Garbled, Refused, Unreachable
from drivers.front_end import lan_xi_documents as documents
from drivers.front_end.lan_xi_documents import ModuleInfo
from drivers.simulated.lan_xi_measurement import Acquired, Measurement, Source

__all__ = ["Acquired", "LanXiServer", "Source"]

_DETECTION_POLLS = 2
_OPERATOR_CHANNEL = "/simulated/"


class LanXiServer:
    """Serves at `url` until closed, one client at a time.

    Parameters
    ----------
    source
        Of the samples.
    channels
        Number of inputs.
    sample_rates
        Hz, those that the module can do.
    port
        Of HTTP; 0 takes a free one.
    pace
        "real": by the wall clock; "asked": virtual time, see `lan_xi_measurement`.
    operator_channel
        What a person would do at a rig: told the name and the JSON of PUT `/simulated/<name>`. Refusals are
        `ValueError` or `Refused`. `/simulated/hang` is the server's own: see `hang`.
    transducers
        What sensors with a memory say of themselves, by input.
    """

    def __init__(
        self,
        source: Source,
        *,
        channels: int,
        sample_rates: tuple[float, ...],
        port: int = 0,
        pace: Literal["real", "asked"] = "real",
        ranges_v: tuple[float, ...] = (10.0, 31.6),
        serial: str = "000001",
        operator_channel: Callable[[str, Any], None] | None = None,
        transducers: Mapping[int, dict[str, Any]] = MappingProxyType({}),
    ) -> None:
        rates_hz = tuple(sorted(float(rate) for rate in sample_rates))
        self.info = ModuleInfo("SIM-LAN-XI", serial, channels, rates_hz, tuple(sorted(ranges_v)))
        self._source, self._pace, self._operator_channel = source, pace, operator_channel
        self._transducers = [transducers.get(number) for number in range(1, channels + 1)]
        self._recorder = Lock()
        self._state, self._tag, self._detecting = documents.IDLE, 0, 0
        self._setup: dict[str, Any] = documents.default_setup(self.info)
        self._listener: socket.socket | None = None
        self._stream: Measurement | None = None
        self._status: list[dict[str, str]] = []
        try:
            self._http = ThreadingHTTPServer(("127.0.0.1", port), self._handler())
        except OSError as error:
            raise Unreachable(
                f"simulated front-end: cannot serve at 127.0.0.1:{port}: {error.strerror or error}"
            ) from error
        self._http.daemon_threads = False
        self._thread = Thread(target=self._http.serve_forever, args=(0.05,), name="lan-xi http")
        self._thread.start()
        self.url = f"http://127.0.0.1:{self._http.server_address[1]}"

    def __enter__(self) -> "LanXiServer":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    @property
    def state(self) -> str:
        """As `/onchange` says it."""
        return self._state

    def close(self) -> None:
        """End the threads and let go of the ports."""
        self._http.shutdown()
        self._thread.join()
        self._http.server_close()
        with self._recorder:
            self._end_stream()
            self._close_listener()

    def cut_stream(self) -> None:
        """A fault: the connection breaks off."""
        if self._stream is not None:
            self._stream.cut()

    def garbage(self) -> None:
        """A fault: the next message is none."""
        if self._stream is not None:
            self._stream.garbage.set()

    def lose(self, samples: int, *, flagged: bool = False) -> None:
        """A fault: so many samples go missing before the next ones, with or without a word about it."""
        if self._stream is not None:
            self._stream.lose(samples, flagged=flagged)

    def hang(self) -> None:
        """A fault: the stream falls silent, its connection stands. Refused where there is none."""
        if self._stream is None:
            raise Refused("no stream to hang")
        self._stream.hung.set()

    def _handler(self) -> type[BaseHTTPRequestHandler]:
        server = self

        class Handler(BaseHTTPRequestHandler):
            timeout = 5.0

            def do_GET(self) -> None:
                self._answer("GET")

            def do_PUT(self) -> None:
                self._answer("PUT")

            def do_POST(self) -> None:
                self._answer("POST")

            def log_message(self, format: str, *args: object) -> None:
                """Nowhere: a simulator is not a web server."""

            def _answer(self, method: str) -> None:
                length = int(self.headers.get("Content-Length") or 0)
                status, text = server._dispatch(method, urlsplit(self.path).path, self.rfile.read(length))
                body = text.encode()
                self.send_response(status)
                self.send_header("Content-Type", "application/json")
                self.send_header("Content-Length", str(len(body)))
                self.end_headers()
                self.wfile.write(body)

        return Handler

    def _dispatch(self, method: str, path: str, body: bytes) -> tuple[int, str]:
        requests: dict[tuple[str, str], tuple[tuple[str, ...], Callable[[Any], Any]]] = {
            ("GET", "/module/info"): ((), lambda _: documents.write_module_info(self.info)),
            ("GET", "/onchange"): ((), self._on_change),
            ("PUT", "/open"): ((documents.IDLE,), lambda _: self._go(documents.OPENED)),
            ("PUT", "/create"): ((documents.OPENED,), lambda _: self._go(documents.CONFIGURING)),
            ("POST", "/channels/input/all/transducers/detect"): (
                (documents.OPENED, documents.CONFIGURING),
                self._detect,
            ),
            ("GET", "/channels/input/all/transducers"): ((), lambda _: self._transducers),
            ("GET", "/channels/input/default"): ((), lambda _: documents.default_setup(self.info)),
            ("GET", "/channels/input"): ((), lambda _: self._setup),
            ("PUT", "/channels/input"): ((documents.CONFIGURING, documents.STREAMING), self._put_setup),
            ("GET", "/destination/socket"): ((documents.STREAMING, documents.RECORDING), self._get_port),
            ("POST", "/measurements"): ((documents.STREAMING,), self._measure),
            ("PUT", "/measurements/stop"): ((documents.RECORDING,), self._stop_measuring),
            ("PUT", "/finish"): ((documents.CONFIGURING, documents.STREAMING), self._finish),
            ("PUT", "/close"): ((documents.OPENED,), lambda _: self._go(documents.IDLE)),
        }
        if method == "PUT" and path.startswith(_OPERATOR_CHANNEL) and self._operator_channel is not None:
            return self._at_operator_channel(path.removeprefix(_OPERATOR_CHANNEL), body)
        states, request = requests.get((method, path.removeprefix("/rest/rec")), ((), None))
        if request is None or not path.startswith("/rest/rec/"):
            return 404, "no such request"
        with self._recorder:
            if states and self._state not in states:
                return 403, f"not in state {self._state}"
            try:
                return 200, json.dumps(request(json.loads(body) if body else None))
            except (ValueError, Garbled, Refused) as error:
                return 400, str(error)

    def _at_operator_channel(self, name: str, body: bytes) -> tuple[int, str]:
        assert self._operator_channel is not None
        try:
            if name == "hang":
                self.hang()
            else:
                self._operator_channel(name, json.loads(body) if body else None)
            return 200, "null"
        except (ValueError, KeyError, TypeError, Refused) as error:
            return 400, str(error)

    def _go(self, state: str) -> None:
        self._state = state
        self._tag += 1

    def _on_change(self, _: Any) -> dict[str, Any]:
        if self._detecting:
            self._detecting -= 1
            self._tag += 1
        status = self._stream.status() if self._stream is not None else self._status
        return {
            "lastUpdateTag": self._tag,
            "moduleState": self._state,
            "transducerDetectionActive": self._detecting > 0,
            "recordingStatus": {"channelStatus": status},
        }

    def _detect(self, _: Any) -> None:
        self._detecting = _DETECTION_POLLS
        self._tag += 1

    def _put_setup(self, setup: Any) -> None:
        channels, rate_hz = documents.read_setup(setup)
        documents.choose_rate(self.info, rate_hz)
        for channel in channels:
            if channel.range_v not in self.info.ranges_v:
                raise Refused(f"range {channel.range_v:g} V of channel {channel.number} is not to be had")
        self._setup = setup
        self._close_listener()
        self._listener = socket.create_server(("127.0.0.1", 0))
        self._go(documents.STREAMING)

    def _get_port(self, _: Any) -> dict[str, int]:
        if self._listener is None:
            raise Refused("no stream is set up")
        return {"tcpPort": self._listener.getsockname()[1]}

    def _measure(self, _: Any) -> str:
        if self._listener is None:
            raise Refused("no stream is set up")
        channels, asked_hz = documents.read_setup(self._setup)
        rate_hz = documents.choose_rate(self.info, asked_hz)
        full_scale_v = np.array([channel.range_v * documents.HEADROOM for channel in channels])
        self._source.start(tuple(channel.number for channel in channels), full_scale_v, rate_hz)
        self._stream = Measurement(
            self._source, self._listener, full_scale_v, rate_hz, asked=self._pace == "asked"
        )
        self._go(documents.RECORDING)
        return "/rest/rec/measurements"

    def _stop_measuring(self, _: Any) -> None:
        self._end_stream()
        self._go(documents.STREAMING)

    def _finish(self, _: Any) -> None:
        self._close_listener()
        self._go(documents.OPENED)

    def _end_stream(self) -> None:
        if self._stream is not None:
            self._status = self._stream.status()
            self._stream.end()
        self._stream = None

    def _close_listener(self) -> None:
        if self._listener is not None:
            self._listener.close()
        self._listener = None
