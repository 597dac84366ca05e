"""From the form to the end of a run: the engine's process, simulated instruments, real wires, real clicks."""

import time
from functools import partial
from pathlib import Path

import httpx
import pytest
from engine_cases import LONG, drive_v, engine_rig, is_silent
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QMessageBox
from quick_engine import QUICK_ENGINE
from window_runs import PATIENCE_MS, opened, started, wait_for_end, wait_for_points

from gui.pages.run.check import Check
from gui.pages.run.new_case import REAL, NewCase
from gui.state.time_to_go import TimeToGo
from gui.style.theme import DARK, LIGHT, current_theme
from instrument.files.rig_file import RigDocument
from instrument.files.toml import read_document
from instrument.session.storage import SessionFile
from instrument.simulated_case import write_case
from instrument.stream.raw import OperatorDid

pytestmark = [pytest.mark.usefixtures("warm"), pytest.mark.pages("run", "hammer")]

LEFT = Qt.MouseButton.LeftButton
SWEEP = "[[sweep.segments]]\nlow_hz = 95.0\nhigh_hz = 107.0\npoints = 5\n"


@pytest.fixture
def page(window):
    window.controller.engine = QUICK_ENGINE
    window.show_page("run")
    return window.pages[0]


@pytest.fixture
def unchecked(page, monkeypatch):
    """The page without the dry run, a command that takes as long to begin as an engine does."""
    monkeypatch.setattr(Check, "start", lambda check, experiment: None)
    return page


@pytest.fixture
def rig(tmp_path):
    with engine_rig(tmp_path, sweep=LONG) as (rig, _):
        yield rig


def typed(qtbot, editor, text):
    """As a person does it: all of it marked, then overwritten."""
    editor.selectAll()
    qtbot.keyClicks(editor, text)


def test_from_the_form_to_the_recording(qtbot, window, page, tmp_path):
    with engine_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        opened(qtbot, window, page, experiment)
        typed(qtbot, page.files.forms["experiment"].editor("sweep", "segments", 0, "points"), "4")
        assert page.starting.start.text() == "Save and start"
        started(qtbot, window, page)
        assert not page.files.tabs.isEnabled()
        ending = wait_for_end(qtbot, window)
    assert (ending.why, ending.session) == ("done", window.controller.recorded.path)
    assert len(window.controller.state.contents.points) == 4
    assert "points = 4" in experiment.read_text()
    assert page.report_button.isEnabled()
    assert page.files.tabs.isEnabled()
    assert window.replay.isVisible()


def test_hold_resume_and_abort(qtbot, window, unchecked, rig, tmp_path):
    """By keys and by clicks; an abort by a click is in the next test."""
    by_key = partial(qtbot.keyClick, window, Qt.Key.Key_F9)
    by_click = partial(qtbot.mouseClick, window.bar.hold, LEFT)
    opened(qtbot, window, unchecked, tmp_path / "experiment.toml")
    started(qtbot, window, unchecked)
    wait_for_points(qtbot, window)
    for hold, resume in ((by_key, by_click), (by_click, by_key)):
        hold()
        qtbot.waitUntil(lambda: window.controller.state.run.state == "held", timeout=PATIENCE_MS)
        qtbot.waitUntil(lambda: window.bar.hold.text() == "Resume")
        qtbot.waitUntil(lambda: is_silent(rig), timeout=PATIENCE_MS)
        done = len(window.controller.state.contents.points)
        resume()
        wait_for_points(qtbot, window, done + 1)
    by_key(Qt.KeyboardModifier.ControlModifier)
    ending = wait_for_end(qtbot, window)
    assert ending.why == "stopped by the user"
    assert is_silent(rig)


def test_a_run_keeps_its_files_its_message_and_its_looks(qtbot, window, unchecked, rig, tmp_path):
    """STOP would wait while a window of other colours is drawn; what was said before is not of this run."""
    other = tmp_path / "other.toml"
    other.write_text((tmp_path / "experiment.toml").read_text())
    opened(qtbot, window, unchecked, tmp_path / "experiment.toml")
    window.notice.refuse("the shaker did not answer")
    started(qtbot, window, unchecked)
    assert window.notice.text == ""
    window.open(other)
    assert window.notice.text == "other.toml: not opened: a run goes on"
    assert unchecked.files.path == tmp_path / "experiment.toml"
    window.turn()
    window.appearance.choose("dark")
    assert current_theme() is LIGHT
    assert window.appearance.waiting
    qtbot.mouseClick(window.bar.stop, LEFT)
    qtbot.waitUntil(lambda: not window.controller.running)
    qtbot.waitUntil(lambda: current_theme() is DARK)
    window.appearance.choose("light")


def test_a_run_that_was_broken_off_is_carried_on(qtbot, window, unchecked, tmp_path):
    page = unchecked
    with engine_rig(tmp_path, sweep=SWEEP.replace("points = 5", "points = 60")) as (_, experiment):
        opened(qtbot, window, page, experiment)
        started(qtbot, window, page)
        wait_for_points(qtbot, window)
        qtbot.mouseClick(window.bar.abort, LEFT)
        folder = wait_for_end(qtbot, window).folder
        qtbot.waitUntil(lambda: page.starting.resume.count() == 2, timeout=PATIENCE_MS)
        page.starting.resume.setCurrentIndex(1)
        assert folder.name in page.now.path.text()
        kept = len(window.controller.state.contents.points)
        started(qtbot, window, page)
        ending = wait_for_end(qtbot, window)
    assert ending.why == "done"
    assert len(window.controller.state.contents.points) == 60 > kept
    qtbot.waitUntil(lambda: page.starting.resume.count() == 1, timeout=PATIENCE_MS)


def test_a_hit_is_rejected_and_taken_back_while_the_run_waits(qtbot, window, unchecked, tmp_path):
    page = unchecked
    with engine_rig(tmp_path, sweep=SWEEP, hammer=True) as (_, experiment):
        opened(qtbot, window, page, experiment)
        page.starting.parts["sweep"].setChecked(False)
        live = started(qtbot, window, page)

        def accepted(hit):
            return {h.number: h.accepted for h in live.state.contents.hits}[hit]

        qtbot.waitUntil(lambda: live.question is not None, timeout=PATIENCE_MS)
        qtbot.waitUntil(lambda: page.banner.isVisible())
        assert "2 good hits" in page.banner.words.text()
        window.show_page("hammer")
        hits = window.pages[-1].hits
        first = hits.table.visualRect(hits.table.model().index(0, 0))
        qtbot.mouseClick(hits.table.viewport(), LEFT, pos=first.center())
        qtbot.mouseClick(hits.reject, LEFT)
        qtbot.waitUntil(lambda: not accepted(1), timeout=PATIENCE_MS)
        qtbot.waitUntil(lambda: live.question is not None, timeout=PATIENCE_MS)
        qtbot.mouseClick(hits.undo, LEFT)
        qtbot.waitUntil(lambda: accepted(1), timeout=PATIENCE_MS)
        window.show_page("run")
        qtbot.mouseClick(page.banner.button, LEFT)
        ending = wait_for_end(qtbot, window)
    assert ending.why == "done"
    with SessionFile(ending.session) as file:
        said = [e for e in file.events(with_samples=False) if isinstance(e, OperatorDid) and e.hit]
    assert [(e.what, e.hit) for e in said] == [("rejected", 1), ("undone", 1)]


@pytest.mark.timing
def test_stop_silences_a_shaker_whose_acquisition_hangs(qtbot, window, page, tmp_path):
    with engine_rig(tmp_path, sweep=LONG, virtual=False) as (rig, experiment):
        slow = (tmp_path / "rig.toml").read_text().replace("[shaker]", "[shaker]\nheartbeat_timeout_s = 10.0")
        (tmp_path / "rig.toml").write_text(slow)
        opened(qtbot, window, page, experiment)
        live = started(qtbot, window, page)
        wait_for_points(qtbot, window)
        qtbot.waitUntil(lambda: live.stop_path is not None and live.stop_path.ready, timeout=PATIENCE_MS)
        qtbot.waitUntil(lambda: drive_v(rig) > 0.05, timeout=PATIENCE_MS)
        httpx.put(f"{rig.front_end.url}/simulated/hang", trust_env=False).raise_for_status()
        at = [window.controller.state.time_s, time.monotonic()]

        def quiet():
            if window.controller.state.time_s != at[0]:
                at[:] = [window.controller.state.time_s, time.monotonic()]
            return time.monotonic() - at[1] > 0.3

        qtbot.waitUntil(quiet, timeout=PATIENCE_MS)
        assert drive_v(rig) > 0.05
        began = time.monotonic()
        qtbot.mouseClick(window.bar.stop, LEFT)
        while drive_v(rig) > 0:
            qtbot.wait(2)
        took = time.monotonic() - began
        ending = wait_for_end(qtbot, window)
        assert is_silent(rig)
    assert took < 0.5
    assert "the shaker is silent" in window.notice.text
    assert ending.why == "stopped by the user"


def test_closing_the_window_ends_the_run_first(qtbot, window, unchecked, rig, tmp_path):
    opened(qtbot, window, unchecked, tmp_path / "experiment.toml")
    live = started(qtbot, window, unchecked)
    wait_for_points(qtbot, window)
    window.close()
    (question,) = window.findChildren(QMessageBox)
    assert window.controller.running
    next(b for b in question.buttons() if "close" in b.text()).click()
    qtbot.waitUntil(lambda: not window.isVisible(), timeout=PATIENCE_MS)
    assert live.ending.why == "stopped by the user"
    assert is_silent(rig)


def test_what_is_wrong_is_said_beside_the_field_and_nothing_can_be_started(qtbot, window, page, tmp_path):
    with engine_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        opened(qtbot, window, page, experiment)
    form = page.files.forms["experiment"]
    typed(qtbot, form.editor("sweep", "level_g"), "-1")
    assert ["-1" in said and "greater" in said for said in form.said] == [True]
    assert not page.starting.start.isEnabled()
    assert "1" in page.files.tabs.tabText(0)
    assert page.files.fault.text().startswith("experiment: sweep.level_g: -1")
    typed(qtbot, form.editor("sweep", "level_g"), "0.5")
    assert page.files.fault.text() == ""
    assert form.said == []
    assert form.item("sweep", "level_g").text(2) == "g = 4.905 m/s\u00b2"
    assert page.starting.start.isEnabled()


def test_check_says_what_to_expect_or_what_is_wrong(qtbot, window, page, tmp_path):
    with engine_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        opened(qtbot, window, page, experiment)
    with qtbot.waitSignal(page.check.passed, timeout=PATIENCE_MS):
        qtbot.mouseClick(page.starting.check, LEFT)
    assert page.checked.table.texts(3) == ["5"]
    typed(qtbot, page.files.forms["experiment"].editor("sweep", "level_g"), "100")
    assert page.starting.check.text() == "Save and check"
    with qtbot.waitSignal(page.check.objected, timeout=PATIENCE_MS):
        qtbot.mouseClick(page.starting.check, LEFT)
    assert "limit" in page.checked.warnings.text()


def test_a_bad_experiment_file_gives_one_message_and_leaves_what_was_there(qtbot, window, page, tmp_path):
    with engine_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        opened(qtbot, window, page, experiment)
    said = []
    window.controller.refused.connect(said.append)
    bad = tmp_path / "bad.toml"
    bad.write_bytes(b"\xff\xfe[[")
    window.open(bad)
    qtbot.waitUntil(lambda: bool(said))
    assert len(said) == 1
    assert "bad.toml" in window.notice.text
    assert page.files.path == experiment


def test_a_simulated_experiment_is_made_and_its_secret_not_shown(qtbot, window, page, tmp_path):
    dialog = NewCase(tmp_path / "case", page)
    qtbot.addWidget(dialog)
    dialog.effect.setCurrentText("random")
    with qtbot.waitSignal(page.files.opened, timeout=PATIENCE_MS):
        page.files.make(*dialog.order())
    rig = read_document(tmp_path / "case" / "rig.toml", RigDocument)
    assert len(rig.simulation.effects) == 1
    with pytest.raises(KeyError):
        page.files.forms["rig"].editor("simulation", "effects")
    said = []
    window.controller.refused.connect(said.append)
    page.files.make(*dialog.order())
    qtbot.waitUntil(lambda: bool(said))
    assert "is there already" in said[0]


def test_the_time_left_is_known_before_the_first_point(qtbot, window, unchecked, rig, tmp_path, monkeypatch):
    """In the order in which the window is told: by the clock a point may come before the bar is drawn."""
    told, plan, take = [], TimeToGo.plan, TimeToGo.take
    monkeypatch.setattr(TimeToGo, "plan", lambda *given: (told.append("plan"), plan(*given)))
    monkeypatch.setattr(TimeToGo, "take", lambda *given: (told.append(type(given[1]).__name__), take(*given)))
    opened(qtbot, window, unchecked, tmp_path / "experiment.toml")
    live = started(qtbot, window, unchecked)
    qtbot.waitUntil(lambda: "left" in window.bar.left.text(), timeout=PATIENCE_MS)
    wait_for_points(qtbot, window, 5)
    assert "plan" in told[: told.index("PointMeasured")]
    assert "left" in window.bar.left.text()
    assert 0 < live.fraction < 0.5
    window.controller.commands.abort()
    wait_for_end(qtbot, window)


def test_segments_and_tables_can_be_added_and_taken_away(qtbot, window, page, tmp_path):
    with engine_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        opened(qtbot, window, page, experiment)
    form = page.files.forms["experiment"]
    plus = form.itemWidget(form.item("sweep", "segments"), 1).children()[1]
    qtbot.mouseClick(plus, LEFT)
    qtbot.waitUntil(lambda: ("sweep", "segments", 1) in form._items)
    form.item("hammer").setCheckState(0, Qt.CheckState.Checked)
    qtbot.waitUntil(lambda: any("missing" in said for said in form.said))
    form.item("hammer").setCheckState(0, Qt.CheckState.Unchecked)
    qtbot.waitUntil(lambda: form.said == [])


def test_one_press_goes_to_the_tab_and_the_field_that_is_wrong(qtbot, window, page, tmp_path):
    with engine_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        opened(qtbot, window, page, experiment)
    assert not page.files.faults_button.isVisible()
    editor = page.files.forms["rig"].editor("front_end", "sample_rate_hz")
    typed(qtbot, editor, "-1")
    page.files.tabs.setCurrentIndex(0)
    qtbot.mouseClick(page.files.faults_button, LEFT)
    assert page.files.tabs.currentWidget() is page.files.forms["rig"]
    assert editor.hasFocus()


def test_the_plate_is_drawn_to_scale_and_what_is_dragged_goes_into_its_fields(qtbot, window, page, tmp_path):
    with engine_rig(tmp_path, sweep=LONG) as (_, experiment):
        opened(qtbot, window, page, experiment)
    view, specimen = page.plate, page.files.forms["specimen"]
    page.tabs.setCurrentWidget(view)
    length, width = view.size_mm
    corner, far = view.to_screen((0.0, 0.0)), view.to_screen((length, width))
    assert (far.x() - corner.x()) / length == pytest.approx((corner.y() - far.y()) / width)
    (spot,) = [mark for mark in view.marks if mark.name == "spot"]
    start, wanted = view.to_screen(spot.at_mm).toPoint(), view.to_screen((100.0, 40.0)).toPoint()
    qtbot.mousePress(view, Qt.MouseButton.LeftButton, pos=start)
    qtbot.mouseMove(view, wanted)
    qtbot.mouseRelease(view, Qt.MouseButton.LeftButton, pos=wanted)
    typed = [float(specimen.editor("pickup", key).text()) for key in ("x_mm", "y_mm")]
    assert typed == pytest.approx([100.0, 40.0], abs=2.0)
    assert specimen.draft.value(("pickup", "x_mm")) == typed[0]
    assert page.files.changed
    qtbot.mousePress(view, Qt.MouseButton.LeftButton, pos=wanted)
    qtbot.mouseMove(view, QPoint(1, 1))
    assert specimen.draft.value(("pickup", "x_mm")) == 0.0


def test_an_experiment_on_a_real_rig_begins_as_valid_commented_files(qtbot, window, page, tmp_path):
    dialog = NewCase(tmp_path / "case", page)
    qtbot.addWidget(dialog)
    dialog.rig.setCurrentText(REAL)
    assert not dialog.effect.isEnabled()
    with qtbot.waitSignal(page.files.opened, timeout=PATIENCE_MS):
        page.files.make(*dialog.order())
    rig = read_document(tmp_path / "case" / "rig.toml", RigDocument)
    assert not rig.is_simulated
    assert rig.operator.kind == "person"
    assert set(page.files.forms) == {"experiment", "rig", "specimen"}
    assert page.files.drafts.fault_count == 0


@pytest.mark.parametrize("kind", ["beam", "shear-pair"])
def test_other_specimens_than_plates_begin_as_valid_files_too(qtbot, window, page, tmp_path, kind):
    dialog = NewCase(tmp_path / "case", page)
    qtbot.addWidget(dialog)
    assert not dialog.specimen.isEnabled()
    dialog.rig.setCurrentText(REAL)
    dialog.specimen.setCurrentIndex(dialog.specimen.findData(kind))
    with qtbot.waitSignal(page.files.opened, timeout=PATIENCE_MS):
        page.files.make(*dialog.order())
    assert page.files.drafts.fault_count == 0
    assert page.files.drafts.parts() == ("sweep",)
    assert page.files.forms["specimen"].item(kind).isExpanded()
    assert page.drawing.currentWidget() is page.drawing.structure
    assert page.drawing.structure.views
    dialog.rig.setCurrentIndex(0)
    assert dialog.specimen.currentData() == "plate"


def test_a_file_is_picked_and_named_as_seen_from_the_file_that_names_it(
    qtbot, window, page, tmp_path, monkeypatch
):
    (tmp_path / "here").mkdir()
    write_case(tmp_path / "here")
    with qtbot.waitSignal(page.files.opened, timeout=PATIENCE_MS):
        window.open(tmp_path / "here" / "experiment.toml")
    form, picked = page.files.forms["experiment"], tmp_path / "here" / "other" / "plate.toml"
    picked.parent.mkdir()
    picked.write_text((tmp_path / "here" / "specimen.toml").read_text())
    asked = []
    monkeypatch.setattr("gui.form.form.ask_open", lambda *said: (asked.append(said), said[-1](picked)))
    form.pick("specimen")
    assert asked[0][2] == str(tmp_path / "here" / "specimen.toml")
    assert form.draft.value(("specimen",)) == str(Path("other") / "plate.toml")
    picked_elsewhere = tmp_path / "rig.toml"
    monkeypatch.setattr("gui.form.form.ask_open", lambda *said: said[-1](picked_elsewhere))
    form.pick("rig")
    assert form.draft.value(("rig",)) == str(picked_elsewhere)
