"""A simulated Polytec vibrometer: a pseudo-terminal that answers in its serial language.

One rule: the head's lock is held while it is read or changed, and while `on_range` runs.
"""

import os
import pty
import select
import tempfile
import tty
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from threading import RLock, Thread
from types import TracebackType

from drivers.errors import Garbled
from drivers.vibrometer import polytec
from drivers.vibrometer.driver import Optics
from drivers.vibrometer.interface import Range
from drivers.vibrometer.polytec import PolytecCommand
from drivers.vibrometer.polytec_models import MODELS, PolytecModel

DECODER = 1
"""Index of the velocity decoder; index 0 is an empty slot, as in many real controllers."""
NOISE = b"\xff\x00\x9a\xb5~"
"""What a garbled reply looks like."""


@dataclass
class Head:
    """What the instrument looks at and how it is set."""

    model: str = "OFV-5000"
    range_name: str = "5mm/s/V"
    signal_level: float = 0.9
    """0 to 1."""
    delay_s: dict[str, float] = field(default_factory=dict)
    """By name of range, where it differs from the model's."""
    focus: str = "Found"
    """The outcome of the next search of focus."""
    laser_on: bool = True
    on_range: Callable[[Range], None] | None = None
    """Called with the new range, the lock held."""

    @property
    def range(self) -> Range:
        """The measuring range that is set."""
        return MODELS[self.model].range_named(self.range_name)

    def signal_delay_s(self) -> float | None:
        """Of the range in use; None where nobody stated one."""
        return self.delay_s.get(self.range_name, self.range.delay_s)


@dataclass
class Faults:
    """How the device misbehaves. Counters run down by themselves."""

    garbled_replies: int = 0
    silent_replies: int = 0
    noise_before_reply: int = 0
    stuck_range: bool = False
    """A new range is acknowledged and not taken."""
    stuck_echo: bool = False
    """Every command comes back, whatever is set."""


class VibrometerServer:
    """Answers at `path` until closed.

    Parameters
    ----------
    head
        Its state.
    lock
        Guards the head.
    """

    def __init__(self, head: Head, *, lock: AbstractContextManager[object]) -> None:
        self.head, self.faults = head, Faults()
        self._lock = lock
        self._echo, self._acknowledge = True, False
        # The name stays when the device is unplugged and plugged in again, as under /dev/serial/by-id.
        self._folder = tempfile.TemporaryDirectory(prefix="vibrometer-")
        self.path = str(Path(self._folder.name) / "port")
        self._thread: Thread | None = None
        self.plug()

    def __enter__(self) -> "VibrometerServer":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def plug(self) -> None:
        """Connect: the port appears, with echo on and acknowledge off."""
        self._echo, self._acknowledge = True, False
        master, self._slave = pty.openpty()
        self._master = master
        tty.setraw(self._slave)
        os.set_blocking(master, False)
        os.symlink(os.ttyname(self._slave), self.path)
        wake, self._wake = os.pipe()
        self._thread = Thread(target=self._serve, args=(master, wake), name="vibrometer")
        self._thread.start()

    def unplug(self) -> None:
        """Disconnect: the port vanishes. Works also twice."""
        if self._thread is None:
            return
        os.unlink(self.path)
        os.close(self._wake)
        self._thread.join()
        os.close(self._slave)
        self._thread = None

    def chatter(self, line: bytes) -> None:
        """A fault: the device says something nobody asked for."""
        os.write(self._master, line + b"\n")

    def close(self) -> None:
        """End the thread and remove the port."""
        self.unplug()
        self._folder.cleanup()

    def _serve(self, master: int, wake: int) -> None:
        received = b""
        try:
            while True:
                ready, _, _ = select.select([master, wake], [], [])
                if wake in ready:
                    return
                received += os.read(master, 4096)
                *lines, received = received.split(b"\n")
                for line in lines:
                    # A full line means that nobody reads: the answer is lost, as on a wire.
                    with suppress(BlockingIOError):
                        os.write(master, self._answer(line))
        finally:
            os.close(master)
            os.close(wake)

    def _answer(self, line: bytes) -> bytes:
        text = polytec.decode(line)
        sent = f"{text}\n".encode() if self._echo or self.faults.stuck_echo else b""
        with self._lock:
            reply = self._reply(text)
        if reply is None:
            return sent
        if self.faults.silent_replies > 0:
            self.faults.silent_replies -= 1
            return sent
        if self.faults.garbled_replies > 0:
            self.faults.garbled_replies -= 1
            return sent + NOISE + b"\n"
        if self.faults.noise_before_reply > 0:
            self.faults.noise_before_reply -= 1
            sent += NOISE + b"\n"
        return sent + reply.encode("latin-1") + b"\n"

    def _reply(self, text: str) -> str | None:
        try:
            command = polytec.parse_command(text)
        except Garbled:
            return "Error"
        if command.verb == "Set":
            accepted = self._set(command)
            return ("OK" if accepted else "Error") if self._acknowledge else None
        return self._value(command) or polytec.NOT_AVAILABLE

    def _set(self, command: PolytecCommand) -> bool:
        place, value = (command.device.lower(), command.index, command.item.lower()), command.value or ""
        if place == ("velodec", DECODER, "range"):
            return self._set_range(value)
        if place == ("sensorhead", 0, "autofocus"):
            return value in ("Search", "Stop")
        with suppress(Garbled):
            if place == ("interface", 0, "echo"):
                self._echo = polytec.parse_switch(value)
                return True
            if place == ("interface", 0, "acknowledge"):
                self._acknowledge = polytec.parse_switch(value)
                return True
            if place == ("sensorhead", 0, "laser"):
                self.head.laser_on = polytec.parse_switch(value)
                return True
        return False

    def _set_range(self, name: str) -> bool:
        found = next((r for r in self._model.ranges if polytec.is_same_name(r.name, name)), None)
        if found is None:
            return False
        if found.name != self.head.range_name and not self.faults.stuck_range:
            self.head.range_name = found.name
            if self.head.on_range is not None:
                self.head.on_range(found)
        return True

    def _value(self, command: PolytecCommand) -> str | None:
        head, model = self.head, self._model
        asked = (command.verb, command.device.lower(), command.index, command.item.lower())
        texts: dict[tuple[str, str, int, str], Callable[[], str]] = {
            ("GetDevInfo", "controller", 0, "name"): lambda: model.controller,
            ("Get", "controller", 0, "name"): lambda: model.controller,
            ("GetDevInfo", "sensorhead", 0, "name"): lambda: "OFV-505",
            ("Get", "sensorhead", 0, "name"): lambda: "OFV-505",
            ("Get", "sensorhead", 0, "laser"): lambda: "1" if head.laser_on else "0",
            ("Get", "sensorhead", 0, "autofocusresult"): lambda: head.focus,
            ("Get", "signallevel", 0, "value"): lambda: str(
                round(head.signal_level * model.signal_level_full)
            ),
            ("Get", "velodec", DECODER, "name"): lambda: model.decoder,
            ("GetDevInfo", "velodec", DECODER, "name"): lambda: model.decoder,
            ("GetDevInfo", "velodec", DECODER, "range"): lambda: ",".join(r.name for r in model.ranges),
            ("Get", "velodec", DECODER, "range"): lambda: head.range_name,
            ("Get", "velodec", DECODER, "maxfreq"): lambda: f"{head.range.highest_hz / 1e3:g} kHz",
            ("Get", "velodec", DECODER, "signaldelay"): lambda: _delay_text(head.signal_delay_s()),
        }
        return texts[asked]() if asked in texts else None

    @property
    def _model(self) -> PolytecModel:
        return MODELS[self.head.model]


@contextmanager
def simulated_polytec(optics: Optics, model: str = "OFV-5000") -> Iterator[VibrometerServer]:
    """A vibrometer of a model that looks at the simulated plant; chooses its range at its beginning."""
    head = Head(model=model, signal_level=optics.signal_level, on_range=optics.choose)
    optics.choose(head.range)
    with VibrometerServer(head, lock=RLock()) as server:
        yield server


def _delay_text(delay_s: float | None) -> str:
    if delay_s is None:
        return polytec.NOT_AVAILABLE
    return f"{delay_s * 1e3:.9g} ms" if delay_s >= 1e-3 else f"{delay_s * 1e6:.9g} µs"
