"""A person at the window, on a real screen: every click and key goes through the X server.

    python tests/helpers/window_driver.py EXPERIMENT.toml

From the form to the diagnosis, a hit rejected and taken back, the replay, and a second run stopped. Prints
what was seen as JSON. Needs DISPLAY and xdotool.
"""

import json
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from PySide6.QtCore import QPoint, QSettings, Qt, QTimer
from PySide6.QtWidgets import QApplication, QFileDialog, QWidget

from gui.background.garbage import Collector
from gui.frame.settings import Settings
from gui.frame.window import Window
from gui.style.theme import Appearance

PATIENCE_S = 120.0
LOOKS_MS = 10
Steps = Iterator[tuple[Callable[[], bool], str]]
"""What to wait for, one after the other, and what that is."""


class Person:
    """Has eyes, a mouse and a keyboard, and waits without holding up the window, a dialog of it too."""

    def __init__(self, steps: Steps) -> None:
        self._steps = steps
        self._awaited: tuple[Callable[[], bool], str] = (lambda: True, "")
        self._since = time.monotonic()
        self.failed = ""
        self._timer = QTimer()
        self._timer.timeout.connect(self._look)
        self._timer.start(LOOKS_MS)

    def _look(self) -> None:
        until, what = self._awaited
        try:
            if until():
                self._awaited = next(self._steps)
                self._since = time.monotonic()
            elif time.monotonic() - self._since > PATIENCE_S:
                self._end(f"waited in vain until {what}")
        except StopIteration:
            self._end("")
        except Exception as error:
            self._end(f"{type(error).__name__} when {what}: {error}")

    def _end(self, failed: str) -> None:
        self.failed = failed
        self._timer.stop()
        if failed:
            QApplication.exit(1)


def until(so: Callable[[], bool], what: str) -> Steps:
    """Look on until it is so."""
    yield so, what


def click(widget: QWidget, at: QPoint | None = None) -> Steps:
    """The left button, in the middle unless said otherwise."""
    yield lambda: widget.isVisible() and widget.isEnabled(), f"{widget} can be clicked"
    place = widget.mapToGlobal(at or widget.rect().center())
    yield from _do("mousemove", str(place.x()), str(place.y()), "click", "1")


def press(*keys: str) -> Steps:
    """Keys as xdotool names them."""
    yield from _do("key", "--delay", "20", *keys)


def write(text: str) -> Steps:
    """Letters."""
    yield from _do("type", "--delay", "5", text)


def _do(*arguments: str) -> Steps:
    process = subprocess.Popen(["xdotool", *arguments])
    yield lambda: process.poll() is not None, f"xdotool {arguments[0]} is done"
    if process.returncode:
        raise RuntimeError(f"xdotool {arguments[0]} failed")
    settled = time.monotonic() + 0.1
    yield lambda: time.monotonic() > settled, "the window has seen it"


def visit(window: Window, experiment: Path, seen: dict[str, object]) -> Steps:
    """All of it; what is seen is noted."""
    yield from until(window.isActiveWindow, "the window has the keyboard")
    controller, run, hammer = window.controller, window.pages[0], window.pages[2]
    yield from press("ctrl+1")

    yield from press("ctrl+o")
    yield from until(lambda: isinstance(QApplication.activeWindow(), QFileDialog), "a file is asked for")
    yield from write(str(experiment))
    yield from press("Return")
    yield from until(lambda: run.files.drafts is not None, "the experiment is read")

    yield from click(run.files.forms["experiment"].editor("title"))
    yield from press("ctrl+a")
    yield from write("at a real screen")
    yield from click(run.starting.start)
    yield from until(lambda: controller.running, "the run begins")

    yield from until(lambda: controller.live.question is not None, "the hits are there")
    seen["asked"] = run.banner.words.text()
    yield from press("ctrl+3")
    table = hammer.hits.table
    yield from until(lambda: table.row_count >= 2, "the hits are listed")
    yield from click(table.viewport(), table.visualRect(table.model().index(0, 0)).center())
    yield from until(lambda: hammer.hits.number == 1, "the first hit is selected")
    live, good = controller.live, {}

    def accepted() -> dict[int, bool]:
        good.update({hit.number: hit.accepted for hit in live.state.contents.hits})
        return good

    yield from press("r")
    yield from until(lambda: not accepted()[1], "the hit is rejected")
    yield from until(lambda: live.question is not None and len(accepted()) > 2, "another hit is there")
    yield from click(hammer.hits.undo)
    yield from until(lambda: accepted()[1], "the hit is taken back")
    seen["hits"] = len(good)
    yield from press("ctrl+1")
    yield from click(run.banner.button)

    yield from press("ctrl+2")
    yield from until(lambda: len(live.state.contents.points) >= 2, "points are measured")
    yield from until(lambda: controller.recorded is not None, "the run has ended")
    seen["ended"] = controller.ending.why
    seen["title"] = controller.state.configuration.experiment.title
    seen["points"] = len(controller.state.contents.points)
    diagnosis = controller.state.contents.diagnosis
    seen["verdict"] = diagnosis.result.verdict if diagnosis and diagnosis.result else None
    for number, page in enumerate(window.pages, start=1):
        yield from press(f"ctrl+{number}")
        yield from until(page.isVisible, f"page {number} is shown")

    feed = controller.recorded
    yield from press("ctrl+Left")
    yield from until(lambda: feed.position_s < feed.length_s, "the replay has jumped back")
    at = feed.position_s
    yield from press("ctrl+space")
    yield from until(lambda: feed.position_s > at + 0.2, "the replay plays")
    yield from click(window.replay.play)
    yield from until(lambda: not feed.playing, "the replay stands still")
    seen["replayed"] = True

    yield from press("ctrl+1")
    yield from click(run.starting.parts["hammer"])
    yield from click(run.starting.start)
    yield from until(lambda: controller.running, "the second run begins")
    second = controller.live
    yield from until(lambda: len(second.state.contents.points) >= 1, "it measures")
    yield from click(window.bar.stop)
    yield from until(lambda: not controller.running, "it has ended")
    seen["stopped"] = second.ending.why
    seen["said"] = window.notice.text
    yield from press("ctrl+q")
    yield from until(lambda: not window.isVisible(), "the window closes")


def main() -> None:
    """Open the window and let the person in."""
    experiment = Path(sys.argv[1])
    QSettings.setPath(
        QSettings.Format.IniFormat, QSettings.Scope.UserScope, str(experiment.parent / "settings")
    )
    QApplication.setAttribute(Qt.ApplicationAttribute.AA_DontUseNativeDialogs)
    application = QApplication([])
    collector = Collector(application)
    window = Window(Appearance(application, "light"), Settings())
    window.setGeometry(0, 0, 1366, 768)
    window.show()
    window.activateWindow()
    seen: dict[str, object] = {}
    person = Person(visit(window, experiment, seen))
    application.exec()
    collector.stop()
    if person.failed:
        sys.exit(person.failed)
    print(json.dumps(seen))


if __name__ == "__main__":
    main()
