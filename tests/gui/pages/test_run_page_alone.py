"""The page of the experiment by itself: files, dry run, start; what a run asks, and what is left of one."""

import threading
from collections import defaultdict
from pathlib import Path
from types import SimpleNamespace

import pytest
from sessions import configuration

from gui.actions.controller import AppController
from gui.form import draft
from gui.form.fields import form_of
from gui.pages.run import RunPage
from gui.pages.run import page as module
from gui.pages.run.check import Check
from gui.state import SessionState
from instrument.check.forecast import distinct
from instrument.engine.messages import Ended, OperatorAsked, Order
from instrument.files.devices import ranges_of
from instrument.simulated_case import write_case
from instrument.stream.raw import SegmentBegan


@pytest.fixture
def page(made, monkeypatch):
    """Its dry runs are noted and not made."""
    checked = []
    monkeypatch.setattr(Check, "start", lambda check, path: checked.append(path))
    page = made(RunPage(AppController()))
    page.controller.setParent(page)
    page.dry_runs, page.orders = checked, []
    monkeypatch.setattr(page.controller, "start", page.orders.append)
    return page


@pytest.fixture
def opened(qtbot, page, tmp_path):
    """With the simulated case in it."""
    path = write_case(tmp_path)
    page.controller.open(path)
    qtbot.waitUntil(lambda: page.files.path == path)
    return page


def test_the_tabs_are_called_as_the_guide_calls_them(page):
    titles = [page.tabs.tabText(number) for number in range(page.tabs.count())]
    assert titles == ["State", "Dry run", "Specimen"]


def test_an_experiment_is_proposed_to_be_kept_beside_its_file(opened, tmp_path):
    assert opened.starting.folder == tmp_path
    assert opened.starting.start.isEnabled()
    assert {part: box.isChecked() for part, box in opened.starting.parts.items()} == {
        "hammer": True,
        "sweep": True,
    }


def test_what_the_forms_ask_for_is_looked_up_where_nobody_waits(qtbot, page, tmp_path, monkeypatch):
    in_window = []

    def looked_up(model):
        in_window.append(threading.current_thread() is threading.main_thread())
        return form_of(model)

    monkeypatch.setattr(draft, "form_of", looked_up)
    path = write_case(tmp_path)
    page.controller.open(path)
    qtbot.waitUntil(lambda: page.files.path == path)
    assert set(page.files.forms) == {"experiment", "rig", "specimen"}
    assert in_window == [False, False, False]


def test_a_check_is_a_dry_run_of_the_file_and_is_looked_at(opened):
    opened.starting.check_wanted.emit()
    assert opened.dry_runs == [opened.files.path]
    assert opened.tabs.currentWidget() is opened.checked
    assert opened.orders == []


def test_a_start_is_an_order_of_the_parts_chosen_with_a_dry_run_beside_it(opened, tmp_path):
    opened.starting.parts["hammer"].setChecked(False)
    opened.starting.start_wanted.emit()
    assert opened.orders == [Order(opened.files.path, tmp_path, ("sweep",), None, True)]
    assert opened.dry_runs == [opened.files.path]


def test_what_was_changed_is_saved_before_anything_begins(qtbot, opened):
    opened.files.forms["experiment"].type_into(("title",), "another title")
    assert opened.files.changed
    assert opened.starting.start.text() == "Save and start"
    opened.starting.start_wanted.emit()
    assert opened.orders == []
    qtbot.waitUntil(lambda: len(opened.orders) == 1)
    assert 'title = "another title"' in opened.files.path.read_text()
    assert not opened.files.changed


def test_files_that_cannot_be_saved_begin_nothing_and_say_why(qtbot, opened):
    refused = []
    opened.controller.refused.connect(refused.append)
    opened.files.forms["experiment"].type_into(("title",), "another title")
    opened.files.path.unlink()
    opened.files.path.mkdir()
    opened.starting.start_wanted.emit()
    qtbot.waitUntil(lambda: bool(refused))
    assert opened.orders == []
    # Nor does it begin when they are saved later.
    opened.files.path.rmdir()
    opened.files.save()
    qtbot.waitUntil(lambda: not opened.files.changed)
    assert opened.orders == []


def test_a_dry_run_that_is_known_is_not_made_again_until_something_changes(opened):
    found = SimpleNamespace()
    shown = []
    opened.checked.show_result = shown.append
    opened.starting.check_wanted.emit()
    opened.check.passed.emit(found)
    assert shown == [found]
    opened.starting.check_wanted.emit()
    assert len(opened.dry_runs) == 1
    opened.files.edited.emit()
    opened.starting.check_wanted.emit()
    assert len(opened.dry_runs) == 2


def test_objections_stand_on_the_dry_run(opened):
    said = []
    opened.checked.show_objections = said.append
    opened.check.objected.emit(["one thing", "another"])
    assert said == [["one thing", "another"]]


def test_runs_that_were_broken_off_are_offered_the_newest_first(qtbot, opened, tmp_path):
    for name in ("experiment-1.running", "experiment-2.running", "other-3.running"):
        (tmp_path / name).mkdir()
    opened.starting.out_changed.emit()
    resume = opened.starting.resume
    qtbot.waitUntil(lambda: resume.count() == 3)
    offered = [resume.itemData(k) for k in range(3)]
    assert offered == [None, tmp_path / "experiment-2.running", tmp_path / "experiment-1.running"]
    assert module._broken_off(tmp_path / "none", "experiment", lambda fraction: None) == []


# While a run goes on


@pytest.fixture
def live(page, monkeypatch):
    """A run that may ask something."""
    made = SimpleNamespace(question=None)
    monkeypatch.setattr(AppController, "live", property(lambda controller: made))
    monkeypatch.setattr(AppController, "running", property(lambda controller: True))
    return made


def state(doing="hammer", question=""):
    strikes = doing in ("hammer", "struck")
    run = SimpleNamespace(state=doing, question=question, next_words="strike the plate", strikes=strikes)
    return SimpleNamespace(run=run, configuration=configuration(), changed=defaultdict(int), version=0)


def test_while_a_run_goes_on_its_files_stay_as_they_are(page, live):
    page.controller.changed.emit()
    assert page.starting.isHidden()
    assert not page.files.tabs.isEnabled()


def test_a_question_is_asked_once_with_its_place_and_answered_to_the_run(page, live, monkeypatch):
    places, answered = [], []
    monkeypatch.setattr(
        page.banner, "show_place", lambda plate, at_mm, mark, read_mm: places.append((at_mm, mark))
    )
    monkeypatch.setattr(page.banner, "isVisible", lambda: not page.banner.isHidden())
    live.question = OperatorAsked("change", "move the spot", (60.0, 60.0), "laser")
    for _ in range(2):
        page._show_question(state(question="Move the laser's spot"))
    assert places == [((60.0, 60.0), "laser")]
    live.question = OperatorAsked("change", "clamp anew", None, "clamp")
    shown = state(question="Clamp the plate anew")
    page._show_question(shown)
    middle = 500 * shown.configuration.the_specimen().width_m
    assert places[-1] == ((0.0, middle), "clamp")
    live.question = OperatorAsked("mount", "bare")
    page._show_question(state(question="Mount the bare plate"))
    assert len(places) == 2
    live.answer = lambda word=True: answered.append(word)
    page.banner.answered.emit()
    page.banner.declined.emit()
    assert answered == [True, False]


def test_a_plate_that_hangs_is_drawn_as_it_hangs_with_both_places(page, live):
    live.question = OperatorAsked("change", "hang it", (285.0, 180.0), "hit", (15.0, 20.0), free=True)
    shown = state(question="Hang it")
    page._show_question(shown)
    sketch, plate = page.banner.sketch, shown.configuration.the_specimen()
    assert [(m.name, m.at_mm) for m in sketch.marks] == [("laser", (15.0, 20.0)), ("hit", (285.0, 180.0))]
    # Nobody said how much of it is in the clamp.
    assert sketch.size_mm == pytest.approx((1e3 * plate.length_m, 1e3 * plate.width_m))
    assert "hung free" in sketch.toolTip()


def test_without_a_question_the_hammer_test_says_what_comes_next(page, live):
    page._show_question(state())
    assert not page.banner.isHidden()
    page._show_question(state("sweep"))
    assert page.banner.isHidden()


# After it


def test_the_end_is_said_of_the_run_whose_recording_is_shown(page, monkeypatch):
    recorded = SimpleNamespace(path=Path("a.h5"))
    monkeypatch.setattr(AppController, "recorded", property(lambda controller: recorded))
    page.controller.ending = Ended("done", "", Path("a.h5"))
    assert page._ending is page.controller.ending
    page.controller.ending = Ended("done", "", Path("b.h5"))
    assert page._ending is None
    page.controller.changed.emit()
    assert page.report_button.isEnabled()
    assert page.export_button.isEnabled()


def test_without_a_session_there_is_nothing_to_report(page):
    page.controller.changed.emit()
    assert not page.report_button.isEnabled()
    assert not page.export_button.isEnabled()
    assert [a.data() for a in page.export_button.menu().actions()] == ["csv", "uff", "mat"]


def test_a_calibration_is_named_by_the_vibrometers_range_it_is_of(page):
    shown = SessionState(configuration())
    shown.take(SegmentBegan(2, 0, 40.0, 280.0, 7))
    shown.take(SegmentBegan(1, 1, 40.0, 280.0, 7))
    page.now.show_segments(shown)
    model = page.now.segments.model()
    rows = [[model.index(row, k).data() for k in (0, 1)] for row in range(2)]
    name = distinct(ranges_of(configuration().rig.vibrometer))[1].name
    assert rows == [["calibration", name], ["1", "1"]]
