"""The hammer test's page by itself: which hits go to the bench, and to whom a word about one goes."""

from collections import defaultdict
from types import SimpleNamespace

import numpy as np
import pytest
from impact_cases import hit_of
from PySide6.QtCore import QObject, Signal
from sessions import configuration
from struck_cases import struck

from gui.actions.controller import AppController
from gui.pages.hammer import HammerPage
from gui.pages.hammer import page as module
from instrument.files.experiment_file import Hammer
from instrument.session.contents import RecordedHit

BAND_HZ = (10.0, 550.0)
HAMMER = Hammer(
    hit_x_mm=285.0, hit_y_mm=25.0, response_x_mm=270.0, response_y_mm=170.0, band_hz=list(BAND_HZ)
)


class Bench(QObject):
    """Computes nothing: notes what it was given."""

    averaged, modes_found, expected, laid = (Signal(object) for _ in range(4))
    failed, not_laid = Signal(str), Signal(str)
    busy = False

    def __init__(self, parent):
        super().__init__(parent)
        self.given, self.expecting, self.forgot = [], [], 0

    def look_at(self, hits, band_hz):
        self.given.append(([(h.number, h.accepted) for h in hits], band_hz))

    def expect(self, configuration, below_hz):
        self.expecting.append(below_hz)

    def forget(self):
        self.forgot += 1


class Engine:
    """Of a run; notes every word about a hit."""

    running = True

    def __init__(self):
        self.words = []

    def accept(self, number):
        self.words.append(("accept", number))

    def reject(self, number):
        self.words.append(("reject", number))

    def undo(self, number):
        self.words.append(("undo", number))


def hit(number, *, accepted=True, why=""):
    quiet = np.zeros(4)
    return RecordedHit(number, accepted, why, 50.0 + number, hit_of(quiet, quiet))


HITS = [hit(1), hit(2, accepted=False, why="double hit"), hit(3)]


class Doing(SimpleNamespace):
    """What a run does."""

    next_words = "strike the plate"
    over = False
    strikes = property(lambda self: self.state in ("hammer", "struck"))


def state(hits=HITS, *, hammer=HAMMER, damping=None, doing="hammer", struck_hits=(), struck=()):
    made = configuration()
    experiment = made.experiment.model_copy(update={"hammer": hammer})
    return SimpleNamespace(
        configuration=made.model_copy(update={"experiment": experiment}),
        contents=SimpleNamespace(
            hits=list(hits), damping=damping, struck_hits=list(struck_hits), struck=list(struck)
        ),
        run=Doing(state=doing),
        changed=defaultdict(int),
        version=0,
    )


@pytest.fixture
def page(made, monkeypatch):
    monkeypatch.setattr(module, "Bench", Bench)
    page = made(HammerPage(AppController()))
    page.controller.setParent(page)
    return page


def test_what_is_expected_may_be_known_before_anything_is_shown(page):
    page.bench.expected.emit(np.array([20.0, 130.0]))
    assert page._expected_hz.tolist() == [20.0, 130.0]


def show(page, shown):
    """As the window does while the page is seen."""
    page.show_state(shown)
    page._draw()


def verdicts(page):
    return page.hits.table.texts(3)


def test_an_experiment_without_a_hammer_test_has_none_to_show(page):
    show(page, state(hammer=None))
    assert page._stack.currentIndex() == 0
    assert "no hammer test" in page.nothing.text()
    assert page.bench.given == []
    page.show_state(None)
    page._draw()
    assert "Open a session" in page.nothing.text()


def test_hits_go_to_the_bench_once_as_they_count_with_the_band(page):
    shown = state()
    show(page, shown)
    counted = [(1, True), (2, False), (3, True)]
    assert page.bench.given == [(counted, BAND_HZ)]
    assert page.bench.expecting == [pytest.approx(1.1 * 550.0)]
    assert verdicts(page) == ["used", "left out", "used"]
    shown.changed["hits"] += 1
    shown.version += 1
    show(page, shown)
    assert len(page.bench.given) == 1
    assert "2 of 3 hits used" in page.hits.prompt.text()


def test_another_choice_is_a_what_if_that_is_computed_and_taken_back(page):
    show(page, state(damping=None))
    page.hits.rejected.emit(1)
    assert page.bench.given[-1][0] == [(1, False), (2, False), (3, True)]
    assert verdicts(page)[0] == "left out (what if)"
    page.hits.accepted.emit(2)
    assert page.bench.given[-1][0] == [(1, False), (2, True), (3, True)]
    page.hits.undone.emit(1)
    assert page.bench.given[-1][0] == [(1, True), (2, True), (3, True)]
    page.modes.as_recorded.emit()
    assert page.bench.given[-1][0] == [(1, True), (2, False), (3, True)]
    assert verdicts(page) == ["used", "left out", "used"]


@pytest.fixture
def engine(monkeypatch):
    """Of a run whose state is told by `doing`."""
    made = Engine()
    live = SimpleNamespace(engine=made, state=state(), question=None, answered=0)
    live.answer = lambda: setattr(live, "answered", live.answered + 1)
    monkeypatch.setattr(AppController, "live", property(lambda controller: live))
    made.live = live
    return made


def test_while_the_test_goes_on_words_go_to_the_run_and_nothing_is_tried(page, engine):
    show(page, state())
    page.hits.accepted.emit(2)
    page.hits.rejected.emit(1)
    page.hits.undone.emit(3)
    assert engine.words == [("accept", 2), ("reject", 1), ("undo", 3)]
    assert len(page.bench.given) == 1
    assert page.hits.prompt.text() == "Strike the plate."


@pytest.mark.parametrize("over", ["another part", "ended"])
def test_once_the_test_is_over_words_are_what_if_again(page, engine, over):
    if over == "ended":
        engine.running = False
    else:
        engine.live.state.run.state = "sweep"
    show(page, state())
    page.hits.rejected.emit(1)
    assert engine.words == []
    assert page.bench.given[-1][0][0] == (1, False)


def test_a_run_that_waits_for_content_is_answered_from_here(page, engine):
    engine.live.question = SimpleNamespace(what="content")
    show(page, state())
    assert not page.hits.use.isHidden()
    page.hits.content.emit()
    assert engine.live.answered == 1
    engine.live.question = None
    shown = state()
    show(page, shown)
    assert page.hits.use.isHidden()


def test_another_session_begins_without_what_was_tried_and_without_hits(page):
    show(page, state())
    page.hits.rejected.emit(1)
    show(page, state([hit(1), hit(2)]))
    assert verdicts(page) == ["used", "used"]
    show(page, state([]))
    assert page.bench.forgot >= 2
    assert "No blow was caught so far." in page.hits.prompt.text()


def test_the_plate_that_is_being_struck_is_the_one_that_is_shown(page, engine):
    engine.live.state.run.state = "struck"
    show(page, state(doing="struck", struck_hits=[hit(1), hit(2)]))
    # Neither modes nor their damping are read off the treated plate here.
    assert page.bench.given == [([(1, True), (2, True)], None)]
    assert "mobility goes into the diagnosis" in page.modes.source.text()
    page.hits.rejected.emit(2)
    assert engine.words == [("reject", 2)]
    assert page.hits.plates.isHidden() is False


def test_of_two_plates_that_were_struck_one_is_chosen(page):
    show(page, state(doing="done", struck_hits=[hit(1)], struck=[struck()]))
    assert not page.hits.plates.isHidden()
    assert page.bench.given[-1] == ([(1, True), (2, False), (3, True)], BAND_HZ)
    page.hits.plates.setCurrentIndex(1)
    assert page.bench.given[-1] == ([(1, True)], None)
    assert page.modes.source.text().startswith("The damped plate struck hung free: 3 hits, 2 lines")
    page.hits.plates.setCurrentIndex(0)
    assert page.bench.given[-1][1] == BAND_HZ


def test_where_one_plate_alone_was_struck_there_is_nothing_to_choose(page):
    show(page, state(doing="done"))
    assert page.hits.plates.isHidden()
    show(page, state([], doing="done", struck_hits=[hit(1)], struck=[struck(remarks=("turned",))]))
    assert page.hits.plates.isHidden()
    assert verdicts(page) == ["used"]
    assert page.modes.source.text().endswith("Turned.")


def test_what_the_bench_could_not_compute_is_said_beside_where_the_damping_is_from(page):
    show(page, state())
    page.bench.failed.emit("no mode found")
    assert "Computed here: hits 1, 3 of 3." in page.modes.source.text()
    assert "no mode found." in page.modes.source.text()
    result = SimpleNamespace(modes=(), hits=(), warnings=(), accepted=())
    show(page, state(damping=SimpleNamespace(result=result)))
    assert page.modes.source.text().startswith("As recorded: hits 1, 3 of 3.")
