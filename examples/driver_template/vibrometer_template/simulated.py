"""A device that answers on loopback in the device's own language, and misbehaves on request."""

import socket
import socketserver
import threading
from contextlib import suppress
from dataclasses import dataclass
from typing import Literal

from drivers.vibrometer.driver import Optics
from vibrometer_template.protocol import RANGES

Fault = Literal["silent", "torn", "garbled", "hangs up", "no vibrometer"]


@dataclass
class Faults:
    """What the next answers are like. Each is used up by the answers it spoils."""

    kind: Fault | None = None
    answers: int = 0
    stuck_range: bool = False
    """A new range is acknowledged and not taken."""

    def next(self) -> Fault | None:
        """Of one answer."""
        if self.answers <= 0:
            return None
        self.answers -= 1
        return self.kind


class SimulatedVibrometer:
    """Stands from entering to leaving the context; entered it gives its address."""

    def __init__(self, optics: Optics) -> None:
        self.faults, self._optics = Faults(), optics
        self.range_number = 0
        self._connections: set[socket.socket] = set()
        self._server = _Server(("127.0.0.1", 0), _Handler)
        self._server.device = self
        self._thread = threading.Thread(target=self._server.serve_forever, args=(0.01,), daemon=True)

    def __enter__(self) -> str:
        self._optics.choose(RANGES[self.range_number])
        self._thread.start()
        return self.address

    def __exit__(self, *_: object) -> None:
        self._server.shutdown()
        self._server.server_close()
        self.unplug()
        self._thread.join()

    @property
    def address(self) -> str:
        """host:port."""
        host, port = self._server.server_address[:2]
        return f"{host!s}:{port}"

    def unplug(self) -> None:
        """Every connection is lost; a new one is taken."""
        for connection in list(self._connections):
            with suppress(OSError):
                connection.shutdown(socket.SHUT_RDWR)

    def answer(self, request: str) -> bytes:
        """To one line."""
        fault = self.faults.next()
        text = "EXACTLY NOT" if fault == "no vibrometer" else self._text(request)
        match fault:
            case "silent":
                return b""
            case "torn":
                return text.encode()
            case "garbled":
                return b"\xff\x9a~\n"
            case _:
                return f"{text}\n".encode()

    def _text(self, request: str) -> str:
        if request == "ID?":
            return "VIBRO 1,serial 42"
        if request == "RANGE?":
            return str(self.range_number)
        if request == "LEVEL?":
            return str(round(100 * self._optics.signal_level))
        word, _, number = request.partition(" ")
        if word == "RANGE" and number.isdecimal() and int(number) < len(RANGES):
            if not self.faults.stuck_range:
                self.range_number = int(number)
                self._optics.choose(RANGES[self.range_number])
            return "OK"
        return "ERR what?"


class _Server(socketserver.ThreadingTCPServer):
    daemon_threads = True
    device: SimulatedVibrometer


class _Handler(socketserver.StreamRequestHandler):
    server: _Server

    def handle(self) -> None:
        device = self.server.device
        device._connections.add(self.connection)
        with suppress(OSError):
            while line := self.rfile.readline():
                if device.faults.kind == "hangs up" and device.faults.next():
                    break
                self.wfile.write(device.answer(line.decode("ascii", "replace").strip()))
        device._connections.discard(self.connection)
