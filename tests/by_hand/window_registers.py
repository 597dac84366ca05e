"""Whole runs in the window, looked at ten times a second: what it shows against the simulated instruments.

    python tests/by_hand/window_registers.py [--seconds 4] [--only NAME]

Each run is swept for a while, then something happens to it: hold, resume and stop; an instrument hangs or
is unplugged. Of drive, base and velocity in the bar: how old the oldest value was that was shown as one of
now. A value is as old as the last moment at which the instruments had it. Exit status 1 where one was over
half a second old. A longer form of tests/gui/test_registers.py.
"""

import argparse
import os
import sys
import tempfile
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from PySide6.QtCore import QSettings, qInstallMessageHandler
from PySide6.QtWidgets import QApplication
from register_runs import HAPPENINGS, one_run

from gui.background.garbage import Collector
from gui.frame.settings import Settings
from gui.frame.window import Window
from gui.style.theme import Appearance

WITHIN_S = 0.5


def main() -> int:
    """A line for each run and quantity."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seconds", type=float, default=4.0, help="of looking, before and after")
    parser.add_argument("--only", choices=HAPPENINGS)
    given = parser.parse_args()
    qInstallMessageHandler(lambda *_: None)
    application = QApplication([])
    collector = Collector(application)
    late = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, str(folder / "settings"))
        window = Window(Appearance(application, "light"), Settings())
        window.resize(1366, 768)
        window.show()
        for what in HAPPENINGS if given.only is None else (given.only,):
            looks = one_run(window, folder / what, what, given.seconds)
            for quantity, seen in looks.seen.items():
                over = sum(age > WITHIN_S for age in seen.ages_s)
                late += over
                now = f"{len(seen.ages_s):4d} as of now, oldest {seen.oldest_s:.2f} s, {over} late"
                counts = f"{seen.marked} marked, {seen.nothing} none"
                print(f"{what:22s} {quantity:9s} {seen.looks:4d} looks, {now}; {counts}", flush=True)
            print(*looks.old[:6], sep="\n")
        window.close()
    collector.stop()
    print(f"{late} values over {WITHIN_S} s old and not marked")
    return 1 if late else 0


if __name__ == "__main__":
    sys.exit(main())
