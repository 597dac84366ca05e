import pytest
from hypothesis import given
from hypothesis import strategies as st
from pictures import shown
from PySide6.QtCore import Qt
from session_cases import SyntheticSession, configuration

from gui.feeds.reader import Failed, Jumped, Loaded, Read, Reader
from gui.feeds.recorded import RecordedFeed
from gui.feeds.session_index import SessionIndex
from gui.state import SessionState
from instrument.session.storage import SessionFile


@pytest.fixture(scope="module")
def recording(session_path):
    with SessionFile(session_path) as file:
        yield file, SessionIndex.of(file, lambda: None)


def played(recording, count):
    file, index = recording
    state = SessionState(index.configuration, index.path)
    for number, event in index.events(file, 0):
        if number >= count:
            break
        state.take(event)
    return state


@given(st.floats(0, 1))
def test_a_jump_gives_what_playing_to_that_place_gives(recording, share):
    file, index = recording
    count = index.count_at(share * index.length_s)
    assert shown(index.state(file, count, lambda: None)) == shown(played(recording, count))


def test_playing_shows_everything_to_the_end(qtbot, opened):
    feed = opened.controller.recorded
    at_end = shown(feed.state)
    feed.play(None)
    with qtbot.waitSignal(feed.ended):
        pass
    assert shown(feed.state) == at_end
    assert not feed.playing
    assert feed.position_s == feed.length_s


def test_speed_is_kept(qtbot, opened):
    feed = opened.controller.recorded
    feed.jump(0.0)
    qtbot.waitUntil(lambda: feed.state is not None and feed.state.run.state != "done")
    feed.play(20.0)
    with qtbot.waitSignal(feed.ended), qtbot.assertNotEmitted(feed.renewed):
        qtbot.waitUntil(lambda: feed.position_s > 10.0)
        begun = feed.position_s
        qtbot.wait(200)
        assert feed.position_s - begun == pytest.approx(4.0, rel=0.5)
        feed.speed = None
    assert feed.state.run.state == "done"


def test_the_slider_and_the_keys_jump(qtbot, opened):
    feed, bar = opened.controller.recorded, opened.replay
    whole = len(feed.state.contents.points)
    bar.slider.setValue(bar.slider.maximum() // 2)
    qtbot.waitUntil(lambda: 0 < len(feed.state.contents.points) < whole)
    marks = [m.time_s for m in feed.index.marks]
    qtbot.keyClick(opened, Qt.Key.Key_Left, Qt.KeyboardModifier.ControlModifier)
    qtbot.waitUntil(lambda: feed.state.time_s <= feed.position_s and feed.position_s in marks)


def test_a_pause_between_two_runs_is_not_waited_for(tmp_path):
    index = SyntheticSession(configuration())
    index.begin("2026-04-01T08:00:00+00:00")
    index.sweep((1,), steps=2)
    index.begin("2026-04-03T08:00:00+00:00")
    index.sweep((1,), steps=2)
    index.end()
    with SessionFile(index.save(tmp_path)) as file:
        recording = SessionIndex.of(file, lambda: None)
    assert recording.length_s < 60


def test_the_last_of_many_jumps_counts(session_path):
    reader = Reader(session_path)
    try:
        index = next_item(reader, Loaded).index
        for k in range(50):
            reader.jump(index.length_s * (k % 7) / 7)
        reader.jump(index.length_s / 2)
        jumped = [next_item(reader, Jumped)]
        assert jumped[-1].time_s == index.length_s / 2
        first = next_item(reader, Read, until_s=index.length_s)
        assert first.time_s > index.length_s / 2
    finally:
        reader.close()


def test_a_file_that_is_none_is_said_once(tmp_path):
    bad = tmp_path / "bad.h5"
    bad.write_bytes(b"nothing")
    reader = Reader(bad)
    assert "not a session file" in next_item(reader, Failed).message
    reader.close()
    assert reader.poll(0.0) is None


def test_comparison_says_equal(qtbot, opened):
    feed = opened.controller.recorded
    with qtbot.waitSignal(feed.compared):
        opened.replay.verify.click()
        assert feed.comparing
    assert feed.comparison.equal_to_recorded
    assert "equal" in opened.replay.verdict.text()


def test_comparison_can_be_cancelled(qtbot, opened):
    opened.replay.verify.click()
    opened.replay.verify.click()
    qtbot.waitUntil(lambda: not opened.controller.recorded.comparing)
    assert opened.controller.recorded.comparison is None


def test_a_feed_can_be_closed_at_once(qtbot, session_path):
    feed = RecordedFeed(session_path)
    feed.close()
    assert not feed._reader._thread.is_alive()


def next_item(reader, kind, until_s=float("inf")):
    """The next item, which is to be of a kind; waits for it."""
    import time

    deadline = time.monotonic() + 10
    while (item := reader.poll(until_s)) is None:
        assert time.monotonic() < deadline
        time.sleep(0.001)
    assert isinstance(item, kind), item
    return item


def test_a_session_opened_alone_shows_its_specimen_until_it_is_closed(qtbot, opened):
    drawing = opened.pages[0].drawing
    qtbot.waitUntil(lambda: drawing.currentWidget() is drawing.structure)
    assert any(mark.kind == "spot" for view in drawing.structure.views for mark in view.marks)
    opened.controller.leave()
    qtbot.waitUntil(lambda: drawing.currentWidget() is drawing.plate)
    assert drawing.plate.size_mm is None


def test_a_recorded_run_that_was_stopped_says_what_can_be_done(qtbot, window, tmp_path):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.sweep((1,))
    synthetic.end("stopped safely", "the front-end fell silent")
    window.open(synthetic.save(tmp_path))
    qtbot.waitUntil(lambda: window.controller.recorded is not None)
    pages = {page.objectName(): page for page in window.pages}
    run, diagnosis = pages["run"], pages["diagnosis"]
    said = "stopped safely: the front-end fell silent; Run says how to go on"
    qtbot.waitUntil(lambda: window.bar.next.toolTip() == said)
    window.show_page("run")
    qtbot.waitUntil(run.now.path.isVisible)
    assert "cannot be carried on" in run.now.path.text()
    window.show_page("diagnosis")
    assert diagnosis.finding.verdict.said == "The run was stopped before a diagnosis was made"
    assert diagnosis.diagnose.isVisible()
