"""The window for a long time, and how long it ever keeps a person waiting.

    python tests/by_hand/window.py SESSION.h5

Repaints 10,000 times, opens and closes 50 times, replays an hour of recordings as fast as it goes, and prints
how memory grew; then runs an experiment at 50 kS/s with its fits and prints how late the main thread was.
"""

import argparse
import ctypes
import gc
import json
import os
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
from PySide6.QtCore import QCoreApplication, QEvent, QSettings, Qt, QTimer, qInstallMessageHandler
from PySide6.QtWidgets import QApplication

from gui.background.garbage import Collector
from gui.frame.settings import Settings
from gui.frame.window import Window
from gui.plots import Plot
from gui.style.theme import Appearance
from instrument.engine import Order
from instrument.simulated_case import write_case

TICK_MS = 5
SAMPLE_RATE_HZ = 65_536.0
"""The front-end's next one above 50 kS/s."""
PATIENCE_S = 600.0
_PAGE_EVERY_S = 2.0
_HARMLESS = "propagateSizeHints"
"""The offscreen screen has no frames."""


@dataclass
class Lateness:
    """Of a timer on the main thread."""

    late_s: list[float] = field(default_factory=list)
    worked_s: list[float] = field(default_factory=list)
    """Processor time of the main thread before each tick: what is late without it, others have caused."""

    def percentile_s(self, percent: float) -> float:
        """So many percent of all ticks came no later."""
        return float(np.percentile(self.late_s, percent))

    @property
    def largest_s(self) -> float:
        """The longest stall."""
        return max(self.late_s)

    def __str__(self) -> str:
        """For people."""
        return (
            f"{len(self.late_s)} ticks: median {1e3 * self.percentile_s(50):.1f} ms late, "
            f"99th percentile {1e3 * self.percentile_s(99):.1f} ms, largest {1e3 * self.largest_s:.1f} ms; "
            f"the main thread's own work: 99th percentile {1e3 * np.percentile(self.worked_s, 99):.1f} ms, "
            f"largest {1e3 * max(self.worked_s):.1f} ms"
        )


@contextmanager
def lateness() -> Iterator[Lateness]:
    """How late a timer of `TICK_MS` comes while the event loop runs."""
    found, last = Lateness(), [time.perf_counter(), time.thread_time()]

    def tick() -> None:
        now = [time.perf_counter(), time.thread_time()]
        found.late_s.append(max(0.0, now[0] - last[0] - 1e-3 * TICK_MS))
        found.worked_s.append(now[1] - last[1])
        last[:] = now

    timer = QTimer()
    timer.setTimerType(Qt.TimerType.PreciseTimer)
    timer.setInterval(TICK_MS)
    timer.timeout.connect(tick)
    timer.start()
    try:
        yield found
    finally:
        timer.stop()


def processor_stalls(seconds: float) -> Lateness:
    """The same timer where nothing else is done: what the machine itself is late by."""
    with lateness() as found:
        turn(seconds)
    return found


def turn(seconds: float, until: Callable[[], bool] = lambda: False) -> bool:
    """Let the event loop run; whether `until` came true."""
    end = time.monotonic() + seconds
    application = QApplication.instance()
    assert application is not None
    while time.monotonic() < end:
        application.processEvents()
        if until():
            return True
        time.sleep(0.0005)
    return until()


# At 50 kS/s


@contextmanager
def rig_in_real_time(folder: Path, *, points: int, mesh: str = "") -> Iterator[Path]:
    """Simulated instruments in a process of their own; the experiment on them."""
    experiment = write_case(folder)
    rig = folder / "rig.toml"
    rig.write_text(rig.read_text().replace("8192.0", f"{SAMPLE_RATE_HZ}"))
    command = [sys.executable, "-m", "instrument.cli", "simulate", str(rig)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            _connect(rig, json.loads(process.stdout.readline()))
            experiment.write_text(
                'specimen = "specimen.toml"\nrig = "rig.toml"\n'
                "[sweep]\nsentinel = false\ncalibration = false\n"
                f"[[sweep.segments]]\nmode = 3\nspan_percent = 25.0\npoints = {points}\n"
                f"[[sweep.segments]]\nlow_hz = 235.0\nhigh_hz = 295.0\npoints = {points}\n"
            )
            with (folder / "specimen.toml").open("a") as file:
                file.write(mesh)
            yield experiment
        finally:
            process.terminate()


def _connect(rig: Path, facts: dict[str, str]) -> None:
    head, _, _ = rig.read_text().partition("\n[simulation]")
    for device, address in (
        ("[shaker]", facts["modbus_tcp"]),
        ("[vibrometer]", facts["vibrometer_tty"]),
        ("[front_end]", facts["frontend_url"]),
    ):
        before, _, after = head.partition(device)
        head = before + device + after.replace('"simulated"', f'"{address}"', 1)
    rig.write_text(head)


def stalls_of_a_run(window: Window, experiment: Path, out: Path) -> Lateness:
    """Of the main thread from the run's first sample to its last point, every page shown in turn."""
    window.controller.start(Order(experiment, out, ("sweep",)))
    assert turn(PATIENCE_S, lambda: window.controller.live is not None)
    live = window.controller.live
    assert live is not None
    assert live.state is not None
    state = live.state
    assert turn(PATIENCE_S, lambda: state.time_s > 0 or live.ending is not None), "no sample came"
    page_at = [time.monotonic()]

    def over() -> bool:
        if time.monotonic() - page_at[0] > _PAGE_EVERY_S:
            page_at[0] = time.monotonic()
            show_next_page(window, window.tabs.currentIndex() + 1)
        return live.ending is not None

    with lateness() as found:
        assert turn(PATIENCE_S, over), "the run did not end"
    assert live.ending is not None
    assert live.ending.why == "done", live.ending
    return found


# For a long time


def memory_mb() -> float:
    """Of this process, now."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def show_next_page(window: Window, number: int) -> None:
    """Pages in turn."""
    window.show_page(window.pages[number % len(window.pages)].objectName())


def settle() -> None:
    """Everything that is to be deleted is, and what the allocator keeps for later is given back."""
    for _ in range(3):
        QCoreApplication.processEvents()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        gc.collect()
    with suppress(AttributeError):
        ctypes.CDLL(None).malloc_trim(0)


def grown_mb(one: Callable[[int], object], count: int) -> float:
    """Do something so many times; memory at the end over that after the first third, which warms caches."""
    warm, before = max(1, count // 3), 0.0
    for number in range(count):
        one(number)
        if number == warm:
            settle()
            before = memory_mb()
    settle()
    return memory_mb() - before


def repaint(window: Window, count: int) -> float:
    """Draw a page anew, page after page; MB grown."""

    def one(number: int) -> None:
        if number % 50 == 0:
            show_next_page(window, number // 50)
            QCoreApplication.processEvents()
        page = window.pages[window.tabs.currentIndex()]
        plots = [plot for plot in page.findChildren(Plot) if plot.isVisible()]
        if number % 10 == 0 and window.controller.state is not None:
            # As if all of it were new.
            window.controller.state.changed.update(tuple(window.controller.state.changed))
            window.turn()
        page.repaint()
        for plot in plots:
            plot.viewport().repaint()

    return grown_mb(one, count)


def open_and_close(make: Callable[[], Window], session: Path, count: int) -> float:
    """A new window, a session in it, closed again; MB grown."""

    def one(number: int) -> None:
        window = make()
        window.show()
        show_next_page(window, number)
        window.open(session)
        assert turn(PATIENCE_S, lambda: window.controller.recorded is not None)
        window.turn()
        window.close()
        window.deleteLater()
        settle()

    return grown_mb(one, count)


def replay(window: Window, seconds: float) -> float:
    """So many recorded seconds as fast as it goes, again and again from the beginning; MB grown."""
    feed = window.controller.recorded
    assert feed is not None

    def one(number: int) -> None:
        show_next_page(window, number)
        feed.play(None)
        assert turn(PATIENCE_S, lambda: not feed.playing)

    return grown_mb(one, max(6, round(seconds / feed.length_s)))


def main() -> None:
    """Do all of it and print."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("session", type=Path)
    options.add_argument("--repaints", type=int, default=10_000)
    options.add_argument("--windows", type=int, default=50)
    options.add_argument("--hours", type=float, default=1.0)
    options.add_argument("--points", type=int, default=40)
    given = options.parse_args()
    warnings: list[str] = []
    qInstallMessageHandler(lambda kind, where, said: warnings.append(said) if _HARMLESS not in said else None)
    application = QApplication([])
    collector = Collector(application)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, str(folder / "settings"))
        appearance = Appearance(application, "light")
        _endure(lambda: Window(appearance, Settings()), given)
        print("the machine alone:", processor_stalls(5.0), flush=True)
        window = Window(appearance, Settings())
        window.resize(1366, 768)
        window.show()
        with rig_in_real_time(folder, points=given.points) as experiment:
            print("a run at 50 kS/s:", stalls_of_a_run(window, experiment, folder), flush=True)
        window.close()
    collector.stop()
    print(f"{len(warnings)} warnings of Qt", *warnings[:5], sep="\n")
    print(f"{threading.active_count()} threads left")


def _endure(make: Callable[[], Window], given: argparse.Namespace) -> None:
    window = make()
    window.resize(1366, 768)
    window.show()
    window.open(given.session)
    assert turn(PATIENCE_S, lambda: window.controller.recorded is not None)
    print(f"{given.repaints} repaints: {repaint(window, given.repaints):+.1f} MB", flush=True)
    print(f"{given.hours:g} h of replay: {replay(window, 3600 * given.hours):+.1f} MB", flush=True)
    window.close()
    print(
        f"{given.windows} windows: {open_and_close(make, given.session, given.windows):+.1f} MB", flush=True
    )


if __name__ == "__main__":
    main()
