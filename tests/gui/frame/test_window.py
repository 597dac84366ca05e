import pytest
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent, QPalette
from PySide6.QtWidgets import QFileDialog, QHeaderView, QMessageBox, QToolButton, QTreeView
from session_cases import SyntheticSession, configuration

from gui.actions.rediagnosis import DiagnosisAsked
from gui.frame.window import TURN_MS, Window
from gui.style.icons import Sign
from gui.widgets.asking import SIGNS, ask_open
from instrument.errors import NOT_SILENT, SWITCH_OFF, BadInput
from instrument.simulated_case import write_case


def drop(window, *paths):
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path)) for path in paths])
    buttons, keys = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    window.dropEvent(QDropEvent(QPointF(50, 50), Qt.DropAction.CopyAction, data, buttons, keys))


def test_opens_with_every_page_and_nothing_running(window):
    assert [window.tabs.tabText(k) for k in range(5)] == ["Run", "Sweep", "Hammer", "Material", "Diagnosis"]
    assert "idle" in window.bar.state.text()
    assert not window.bar.stop.isEnabled()
    assert not window.replay.isVisible()


def test_every_page_is_drawn_before_it_is_looked_at(qtbot, window):
    size = window.tabs.currentWidget().size()
    qtbot.waitUntil(lambda: all(page.size() == size for page in window.pages))


def test_a_page_is_made_in_one_turn_and_drawn_in_another(qtbot, appearance, settings):
    window = Window(appearance, settings)
    qtbot.addWidget(window)
    while window._undrawn:
        before = len(window._page_set.made), len(window._undrawn)
        window._draw_next()
        done = len(window._page_set.made) - before[0], before[1] - len(window._undrawn)
        assert sum(done) == 1
    assert len(window._page_set.made) == len(window.page_titles)


def test_a_window_that_is_late_looks_less_often_in_a_run_only(window, monkeypatch):
    timer = window._timer
    monkeypatch.setattr("gui.frame.window.monotonic", lambda: window._ticked_s + 1.0)
    window._tick()
    assert timer.interval() == TURN_MS
    with monkeypatch.context() as patched:
        patched.setattr(type(window.controller), "running", property(lambda controller: True))
        window._tick()
    assert timer.interval() > 5 * TURN_MS


@pytest.mark.parametrize("number", range(5))
def test_each_page_has_its_key(qtbot, kept_window, number):
    window = kept_window
    window.show_page(window.pages[(number + 1) % 5].objectName())
    qtbot.keyClick(window, Qt.Key.Key_1 + number, Qt.KeyboardModifier.ControlModifier)
    assert window.tabs.currentIndex() == number


def test_dark_and_light_reach_every_widget(qtbot, window):
    def lightness():
        return window.pages[0].palette().color(QPalette.ColorRole.Window).lightness()

    window.appearance.choose("dark")
    qtbot.waitUntil(lambda: lightness() < 100)
    window.appearance.choose("light")
    qtbot.waitUntil(lambda: lightness() > 200)


def test_type_size_can_be_changed_and_is_remembered(qtbot, window, settings):
    usual = window.fontMetrics().height()
    for _ in range(3):
        qtbot.keyClick(window, Qt.Key.Key_Plus, Qt.KeyboardModifier.ControlModifier)
    qtbot.waitUntil(lambda: window.fontMetrics().height() > usual)
    window.close()
    assert settings.scale == window.appearance.scale == 1.5
    window.appearance.resize(1.0)


def test_page_and_mode_are_remembered(qtbot, window, settings, appearance):
    window.show_page("material")
    appearance.choose("dark")
    window.close()
    again = Window(appearance, settings)
    qtbot.addWidget(again)
    assert again.tabs.currentIndex() == 3
    assert settings.mode == "dark"
    appearance.choose("light")


def test_nonsense_in_the_settings_counts_as_nothing(settings):
    settings._kept.setValue("mode", "pink")
    settings._kept.setValue("scale", "large")
    assert (settings.mode, settings.scale) == ("system", 1.0)


def test_a_dropped_session_opens_at_its_end(qtbot, window, session_path):
    drop(window, session_path)
    qtbot.waitUntil(lambda: window.controller.recorded is not None)
    assert window.controller.state.run.state == "done"
    assert window.replay.isVisible()
    assert window.settings.recent == [session_path]
    assert "bare plate" in window.log.text


@pytest.mark.parametrize(
    ("name", "content"),
    [("no.h5", b"no session"), ("no.csv", b"\x00\xff"), ("no.uff", b"nothing"), ("no.zip", b"PK")],
)
def test_a_bad_file_gives_one_message_and_leaves_the_session(qtbot, kept, tmp_path, name, content):
    opened, said = kept, []
    opened.controller.refused.connect(said.append)
    before = opened.controller.feed
    bad = tmp_path / name
    bad.write_bytes(content)
    drop(opened, bad)
    qtbot.waitUntil(lambda: bool(said))
    opened.turn()
    assert len(said) == 1
    assert name in opened.notice.text
    assert opened.controller.feed is before
    assert opened.controller.state is not None


@pytest.mark.parametrize(
    ("name", "said"),
    [("some.h5", "a folder, expected a file"), ("one-7.running", "choose it beside Begin")],
)
def test_a_folder_is_no_file_and_a_broken_off_run_is_named(kept, tmp_path, name, said):
    (tmp_path / name).mkdir()
    before = kept.controller.recorded
    drop(kept, tmp_path / name)
    assert said in kept.notice.text
    assert kept.controller.recorded is before


def test_a_specimen_is_no_experiment_and_leaves_everything_as_it_was(qtbot, kept, tmp_path):
    specimen = tmp_path / "specimen.toml"
    specimen.write_text("[beam]\nlength_mm = -200.0\n")
    before = kept.controller.feed
    kept.open(specimen)
    assert kept.notice.text.startswith("specimen.toml: a specimen, expected an experiment")
    assert kept.controller.feed is before


def test_data_laid_beside_go_as_they_came(qtbot, opened, tmp_path):
    for name in ("one.csv", "two.csv"):
        path = tmp_path / name
        rows = "".join(f"{f},{0.01 * f},0.002\n" for f in range(15, 25))
        path.write_text("frequency_hz,velocity_re_m_s,velocity_im_m_s\n" + rows)
        opened.open(path)
    qtbot.waitUntil(lambda: len(opened.controller.beside) == 2)
    opened.show_page("sweep")
    sweep = opened.tabs.currentWidget()
    assert sweep.response.take_away.isVisible()
    sweep.response.take_away.click()
    assert not opened.controller.beside
    assert not sweep.response.take_away.isVisible()


def test_changes_that_are_not_saved_are_asked_about_before_they_are_lost(qtbot, window, tmp_path):
    path = write_case(tmp_path)
    window.open(path)
    run = window.pages[0]
    qtbot.waitUntil(lambda: run.files.path == path)
    run.files.forms["experiment"].type_into(("title",), "another")
    assert run.unsaved
    window.close()
    assert window.isVisible()
    box = run.files.findChild(QMessageBox, "Not saved")
    box.button(QMessageBox.StandardButton.Cancel).click()
    assert window.isVisible()
    window.close()
    box = run.files.findChildren(QMessageBox, "Not saved")[-1]
    save = next(b for b in box.buttons() if b.text() == "Save")
    save.click()
    qtbot.waitUntil(lambda: not window.isVisible())
    assert 'title = "another"' in path.read_text()


def test_a_save_by_hand_after_one_that_failed_closes_nothing(qtbot, window, tmp_path, monkeypatch):
    path = write_case(tmp_path)
    window.open(path)
    files = window.pages[0].files
    qtbot.waitUntil(lambda: files.path == path)
    files.forms["experiment"].type_into(("title",), "another")
    window.close()
    with monkeypatch.context() as patch:
        patch.setattr(type(files.drafts), "save", refuse)
        with qtbot.waitSignal(files.failed):
            next(b for b in files.findChild(QMessageBox, "Not saved").buttons() if b.text() == "Save").click()
    with qtbot.waitSignal(files.saved):
        files.save()
    assert window.isVisible()


def refuse(*_):
    raise BadInput("read-only")


def test_a_session_cut_short_is_refused(qtbot, window, session_path, tmp_path):
    bad = tmp_path / "cut.h5"
    bad.write_bytes(session_path.read_bytes()[:200_000])
    window.open(bad)
    qtbot.waitUntil(lambda: "cut.h5" in window.notice.text)
    assert window.controller.feed is None


def test_other_programs_data_is_laid_beside_the_session(qtbot, opened, tmp_path):
    sweep = tmp_path / "sweep.csv"
    rows = "".join(f"{f},{0.01 * f},0.002\n" for f in range(15, 25))
    sweep.write_text("frequency_hz,velocity_re_m_s,velocity_im_m_s\n" + rows)
    drop(opened, sweep)
    qtbot.waitUntil(lambda: "1 sweep" in opened.notice.text)
    assert list(opened.controller.beside) == [sweep]
    assert opened.controller.recorded is not None


def test_closes_while_a_session_is_read(qtbot, appearance, settings, session_path):
    for _ in range(5):
        window = Window(appearance, settings)
        qtbot.addWidget(window)
        window.open(session_path)
        window.close()
        assert window.controller.feed is None


def test_escape_takes_the_message_away(qtbot, window, tmp_path):
    window.open(tmp_path / "no.zip")
    assert window.notice.isVisible()
    qtbot.keyClick(window, Qt.Key.Key_Escape)
    assert not window.notice.isVisible()


def test_what_is_refused_is_not_said_of_what_is_asked_for_next(qtbot, window, session_path, tmp_path):
    window.open(tmp_path / "no.zip")
    assert "no.zip" in window.notice.text
    window.open(session_path)
    qtbot.waitUntil(lambda: window.controller.recorded is not None)
    assert window.notice.text == ""
    window.open(tmp_path / "no.zip")
    window.controller.rediagnosis.began.emit()
    assert window.notice.text == ""
    window.open(tmp_path / "no.zip")
    window.controller.together.began.emit()
    assert window.notice.text == ""


def test_of_files_dropped_together_a_bad_one_is_named_whichever_comes_after_it(
    qtbot, window, session_path, tmp_path
):
    drop(window, tmp_path / "no.zip", session_path)
    qtbot.waitUntil(lambda: window.controller.recorded is not None)
    assert "no.zip" in window.notice.text


def test_files_dropped_together_have_one_message(qtbot, opened, tmp_path):
    rows = "".join(f"{0.001 * f},{0.01 * f},0.002\n" for f in range(15, 25))
    for name in ("one.csv", "two.csv"):
        (tmp_path / name).write_text("frequency_hz,velocity_re_m_s,velocity_im_m_s\n" + rows)
    drop(opened, tmp_path / "one.csv", tmp_path / "two.csv", tmp_path / "no.zip")
    qtbot.waitUntil(lambda: not opened.controller.data_beside.reading)
    said = opened.notice.text
    assert all(f"{name}: 1 sweep laid beside the session" in said for name in ("one.csv", "two.csv"))
    assert said.startswith("no.zip: ")
    assert said.count("is it in kHz?") == 2
    drop(opened, tmp_path / "no.zip")
    assert "one.csv" not in opened.notice.text


def test_another_session_ends_a_diagnosis_and_it_is_said(qtbot, opened, tmp_path):
    rediagnosis, before = opened.controller.rediagnosis, opened.controller.recorded.path
    other = tmp_path / "other.h5"
    other.write_bytes(before.read_bytes())
    rediagnosis.start(DiagnosisAsked(before))
    opened.open(other)
    qtbot.waitUntil(lambda: opened.controller.recorded.path == other)
    assert not rediagnosis.running
    assert opened.notice.text == f"The diagnosis of {before.name} was ended: another session is shown."


def test_a_long_name_widens_nothing(qtbot, opened, session_path, tmp_path):
    opened.resize(1280, 720)
    name = "_".join(["everything", "that", "is", "known"] * 10)
    sweep, session = tmp_path / f"{name}.csv", tmp_path / f"{name}.h5"
    rows = "".join(f"{f},{0.01 * f},0.002\n" for f in range(15, 25))
    sweep.write_text("frequency_hz,velocity_re_m_s,velocity_im_m_s\n" + rows)
    session.write_bytes(session_path.read_bytes())
    controller = opened.controller
    opened.open(sweep)
    controller.compare(session)
    qtbot.waitUntil(lambda: set(controller.beside) == {sweep, session})
    controller.rediagnosis.start(DiagnosisAsked(sweep, further=()))
    controller.together.add([sweep, session])
    for page in opened.pages:
        opened.show_page(page.objectName())
        opened.turn()
        assert page.minimumSizeHint().width() < 1000, page.title
    controller.together.pair(None, tmp_path / f"{name}.toml")
    qtbot.waitUntil(lambda: opened.pages[5].chosen.fault.said.count(name) == 1)
    assert opened.pages[5].minimumSizeHint().width() < 1000
    controller.leave()
    opened.open(sweep)
    qtbot.waitUntil(lambda: list(controller.beside) == [sweep])
    assert opened.pages[4].minimumSizeHint().width() < 1000
    assert opened.width() == 1280


def test_a_session_that_was_broken_off_says_why(qtbot, window, tmp_path):
    index = SyntheticSession(configuration())
    index.begin()
    index.sweep((1,), steps=4)
    index.end("stopped safely", "interlock open")
    window.open(index.save(tmp_path))
    qtbot.waitUntil(lambda: window.controller.recorded is not None)
    assert "stopped" in window.bar.state.text()
    assert "interlock open" in window.bar.next.text()


def test_what_to_do_about_a_shaker_that_may_not_be_silent_is_not_cut_away(qtbot, window, tmp_path):
    index = SyntheticSession(configuration())
    index.begin()
    index.sweep((1,), steps=4)
    index.end(NOT_SILENT, f"{SWITCH_OFF}: the shaker does not say that it is silent ({'no answer ' * 30})")
    window.open(index.save(tmp_path))
    qtbot.waitUntil(lambda: window.controller.recorded is not None)
    assert window.bar.next.text().startswith(SWITCH_OFF)
    assert NOT_SILENT in window.bar.next.toolTip()
    assert "safely" not in window.bar.next.toolTip()


def test_a_file_dialogs_signs_are_the_windows_and_its_columns_are_not_cut(window, tmp_path):
    ask_open(window, "Open", str(tmp_path), "", print)
    dialog = window.findChild(QFileDialog, "Open")
    for name in SIGNS:
        assert dialog.findChild(QToolButton, name).findChild(Sign) is not None, name
    header = dialog.findChild(QTreeView).header()
    assert header.sectionResizeMode(1) == QHeaderView.ResizeMode.ResizeToContents
    dialog.close()
