"""The choices of an adaptive sweep: made on a thread of their own while the rig measures."""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from concurrent.futures import TimeoutError as NotYet

from fitting.gravity import PUBLISHED_G_M_S2
from fitting.specimen import PlateSpecimen
from instrument.files.experiment_file import SweepTable
from instrument.files.hammer_file import accepted_modes
from instrument.planning.choosing import Goal, choose_steps, lay_out
from instrument.planning.grid import Ground
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import DampingFound, PointMeasured, StepsChosen
from instrument.stream.raw import ChoiceStarted


class Chooser:
    """Makes the choices of one sweep, in order. Pure but for the models it keeps: the same in a replay."""

    def __init__(
        self, specimen: PlateSpecimen, table: SweepTable, settings: SweepSettings, chosen: list[StepsChosen]
    ) -> None:
        """`chosen` are those of a run that was broken off."""
        assert table.adaptive is not None
        self._specimen, self._table, self._settings = specimen, table, settings
        wish = table.adaptive
        self._goal = Goal(wish.target_percent / 100, wish.causes_percent / 100, wish.most_s)
        self._ground: tuple[DampingFound | None, Ground] | None = None
        self.chosen = {one.number: one for one in chosen}

    def ground(self, damping: DampingFound | None) -> Ground:
        """Models of the specimen with a hammer test. Raises `OutsideModel`, `TooFewPoints`."""
        if self._ground is None or self._ground[0] is not damping:
            wish = self._table.adaptive
            assert wish is not None
            hammer = accepted_modes(damping.result) if damping is not None else None
            band, level = (wish.band_hz[0], wish.band_hz[1]), self._table.level_g * PUBLISHED_G_M_S2
            self._ground = damping, Ground.of(self._specimen, self._settings, band, level, hammer)
        return self._ground[1]

    def choose(
        self, started: ChoiceStarted, points: list[PointMeasured], damping: DampingFound | None
    ) -> StepsChosen:
        """What comes next, by the points up to the one it names."""
        before = self.chosen.get(started.number - 1)
        found = choose_steps(started, points, before, self.ground(damping), self._goal)
        self.chosen[found.number] = found
        return found

    def look_ahead(self, going: Future[StepsChosen], damping: DampingFound | None) -> None:
        """Lay out candidates for the choice after that one, while the rig measures."""
        if going.exception() is None:
            lay_out(going.result(), self.ground(damping))


class LiveChoice:
    """Chooses the next steps of one run while the rig measures. Use as a context around the sweep."""

    def __init__(self, chooser: Chooser, record: Callable[[StepsChosen], object]) -> None:
        self._chooser, self._record = chooser, record
        self._worker = ThreadPoolExecutor(1, "choice")
        self._going: Future[StepsChosen] | None = None

    def __enter__(self) -> "LiveChoice":
        return self

    def __exit__(self, *_: object) -> None:
        self._worker.shutdown(wait=False, cancel_futures=True)

    def start(
        self, started: ChoiceStarted, points: list[PointMeasured], damping: DampingFound | None
    ) -> None:
        """Begin to choose. Returns at once."""
        self._going = self._worker.submit(self._chooser.choose, started, list(points), damping)
        self._worker.submit(self._chooser.look_ahead, self._going, damping)

    def take(self, number: int, patience_s: float) -> StepsChosen | None:
        """The choice of a number, recorded; None where it is not made within a time."""
        assert self._going is not None
        try:
            found = self._going.result(patience_s)
        except NotYet:
            return None
        assert found.number == number
        self._record(found)
        return found
