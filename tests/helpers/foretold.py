"""Whole runs in virtual time, and the time to go that was foretold at every event of them."""

from quick_run import no_fit

from gui.state.time_to_go import TimeToGo
from instrument.run.companion import Companion
from instrument.run.experiment import run_experiment
from instrument.session.configuration import read_whole_experiment
from instrument.simulated_case import write_case
from instrument.stream.clock import SessionClock
from instrument.stream.raw import BlockAcquired

SHARES = (0.1, 0.3, 0.6)


class Watched(Companion):
    """Keeps what was foretold at every event, and when."""

    def __init__(self):
        self.to_go, self.clock, self.now_s = TimeToGo(), SessionClock(), 0.0
        self.told: list[tuple[float, float, float]] = []

    def planned(self, work, regions):
        self.to_go.plan(work, 0.0)
        self.note()

    def happened(self, event):
        self.clock.take(event)
        if isinstance(event, BlockAcquired):
            self.now_s = self.clock.at(event.first_sample + event.samples)
        self.to_go.take(event, self.now_s, 0.0)
        self.note()

    def note(self):
        done = self.to_go.fraction(self.now_s, 0.0)
        self.told.append((self.now_s, self.to_go.measuring_s(self.now_s), done))

    def errors(self) -> dict[float, float]:
        """How far off, relative, at shares of the whole run."""
        found = {}
        for share in SHARES:
            now, told, _ = next(t for t in self.told if t[0] >= share * self.now_s)
            found[share] = told / (self.now_s - now) - 1
        return found


def told_of(folder, parts, seed, change=lambda text: text) -> Watched:
    path, watched = write_case(folder, seed=seed), Watched()
    path.write_text(change(path.read_text()))
    run_experiment(read_whole_experiment(path), folder, parts, fit=no_fit, companion=watched)
    return watched
