"""A person at the window, on a real screen: every click and key goes through the X server.

    python tests/window_driver.py EXPERIMENT.toml

From the form to the diagnosis, a hit rejected and taken back, the replay, and a second run stopped. Prints
what was seen as JSON. Needs DISPLAY and xdotool.
"""

import json
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QPoint, QSettings, Qt
from PySide6.QtWidgets import QApplication, QFileDialog, QWidget

from gui.garbage import Collector
from gui.settings import Settings
from gui.theme import Appearance
from gui.window import Window

PATIENCE_S = 300.0


class Person:
    """Has eyes, a mouse and a keyboard."""

    def __init__(self, application: QApplication) -> None:
        self._application = application

    def wait(self, until: Callable[[], bool], what: str) -> None:
        """Look on until it is so."""
        end = time.monotonic() + PATIENCE_S
        while not until():
            if time.monotonic() > end:
                sys.exit(f"waited in vain until {what}")
            self._application.processEvents()
            time.sleep(0.005)

    def click(self, widget: QWidget, at: QPoint | None = None) -> None:
        """The left button, in the middle unless said otherwise."""
        self.wait(lambda: widget.isVisible() and widget.isEnabled(), f"{widget} can be clicked")
        place = widget.mapToGlobal(at or widget.rect().center())
        self._do("mousemove", str(place.x()), str(place.y()), "click", "1")

    def press(self, *keys: str) -> None:
        """Keys as xdotool names them."""
        self._do("key", "--delay", "20", *keys)

    def type(self, text: str) -> None:
        """Letters."""
        self._do("type", "--delay", "5", text)

    def _do(self, *arguments: str) -> None:
        """The window goes on while the keys are being sent."""
        process = subprocess.Popen(["xdotool", *arguments])
        self.wait(lambda: process.poll() is not None, "xdotool is done")
        if process.returncode:
            sys.exit(f"xdotool {arguments[0]} failed")
        for _ in range(10):
            self._application.processEvents()
            time.sleep(0.01)


def visit(person: Person, window: Window, experiment: Path) -> dict[str, object]:
    """All of it; what was seen."""
    seen: dict[str, object] = {}
    desk, run, hammer = window.desk, window.pages[0], window.pages[2]
    person.press("ctrl+1")

    person.press("ctrl+o")
    person.wait(lambda: isinstance(QApplication.activeModalWidget(), QFileDialog), "a file is asked for")
    person.type(str(experiment))
    person.press("Return")
    person.wait(lambda: run.files.drafts is not None, "the experiment is read")

    person.click(run.files.forms["experiment"].editor("title"))
    person.press("ctrl+a")
    person.type("at a real screen")
    person.click(run.starting.start)
    person.wait(lambda: desk.running, "the run begins")

    person.wait(lambda: desk.live.question is not None, "the hits are there")
    seen["asked"] = run.banner.words.text()
    person.press("ctrl+3")
    table = hammer.hits.table
    person.wait(lambda: table.row_count >= 2, "the hits are listed")
    person.click(table.viewport(), table.visualRect(table.model().index(0, 0)).center())
    person.wait(lambda: hammer.hits.number == 1, "the first hit is selected")
    live, good = desk.live, {}

    def accepted() -> dict[int, bool]:
        good.update({hit.number: hit.accepted for hit in live.picture.contents.hits})
        return good

    person.press("r")
    person.wait(lambda: not accepted()[1], "the hit is rejected")
    person.wait(lambda: live.question is not None and len(accepted()) > 2, "another hit is there")
    person.click(hammer.hits.undo)
    person.wait(lambda: accepted()[1], "the hit is taken back")
    seen["hits"] = len(good)
    person.press("ctrl+1")
    person.click(run.banner.button)

    person.press("ctrl+2")
    person.wait(lambda: len(live.picture.contents.points) >= 2, "points are measured")
    person.wait(lambda: desk.recorded is not None, "the run has ended")
    seen["ended"] = desk.ending.why
    seen["title"] = desk.picture.configuration.experiment.title
    seen["points"] = len(desk.picture.contents.points)
    seen["verdict"] = desk.picture.contents.diagnosis["verdict"] if desk.picture.contents.diagnosis else None
    for number, page in enumerate(window.pages, start=1):
        person.press(f"ctrl+{number}")
        person.wait(page.isVisible, f"page {number} is shown")

    feed = desk.recorded
    person.press("ctrl+Left")
    person.wait(lambda: feed.position_s < feed.length_s, "the replay has jumped back")
    at = feed.position_s
    person.press("ctrl+space")
    person.wait(lambda: feed.position_s > at + 0.2, "the replay plays")
    person.click(window.replay.play)
    person.wait(lambda: not feed.playing, "the replay stands still")
    seen["replayed"] = True

    person.press("ctrl+1")
    person.click(run.starting.parts["hammer"])
    person.click(run.starting.start)
    person.wait(lambda: desk.running, "the second run begins")
    second = desk.live
    person.wait(lambda: len(second.picture.contents.points) >= 1, "it measures")
    person.click(window.bar.stop)
    person.wait(lambda: not desk.running, "it has ended")
    seen["stopped"] = second.ending.why
    seen["said"] = window.notice.text
    person.press("ctrl+q")
    person.wait(lambda: not window.isVisible(), "the window closes")
    return seen


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
    person = Person(application)
    person.wait(window.isActiveWindow, "the window has the keyboard")
    seen = visit(person, window, experiment)
    collector.stop()
    print(json.dumps(seen))


if __name__ == "__main__":
    main()
