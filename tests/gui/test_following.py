"""What the window asks after a diagnosis: what to measure next, where, and what came of it."""

import pytest
from engine_cases import engine_rig
from following_cases import SPOT, SPOT_MM, STRUCK
from following_engine import FOLLOWING_ENGINE, STRIKING_ENGINE
from PySide6.QtCore import Qt

from gui.feeds.live import LiveFeed
from instrument.engine import Engine, Order
from instrument.session.configuration import read_whole_experiment
from instrument.stream.raw import FollowUpDecided

pytestmark = pytest.mark.usefixtures("warm")

LEFT = Qt.MouseButton.LeftButton
PATIENCE_MS = 120_000
SWEEP = "[[sweep.segments]]\nlow_hz = 95.0\nhigh_hz = 107.0\npoints = 4\n"


@pytest.fixture
def page(window):
    window.controller.engine = FOLLOWING_ENGINE
    window.show_page("run")
    return window.pages[0]


@pytest.fixture
def asked(qtbot, window, page):
    """Wait until the run asks this; the laser is aimed and the plate mounted meanwhile."""

    def wait(what):
        def is_asked():
            question = window.controller.live.question
            if question is not None and question.what in ("mount", "aim"):
                window.controller.commands.answer()
            return question is not None and question.what == what and page.banner.button.isVisible()

        qtbot.waitUntil(is_asked, timeout=PATIENCE_MS)
        return page.banner

    return wait


def test_an_offer_is_shown_with_its_place_agreed_to_and_done_by_hand(qtbot, window, page, asked, tmp_path):
    with engine_rig(tmp_path, person=True, sweep=SWEEP) as (_, experiment):
        experiment.write_text(experiment.read_text() + '[diagnosis]\nfollow_up = "offer"\n')
        with qtbot.waitSignal(page.files.opened, timeout=PATIENCE_MS):
            window.open(experiment)
        qtbot.mouseClick(page.starting.start, LEFT)
        qtbot.waitUntil(lambda: window.controller.running, timeout=PATIENCE_MS)
        banner = asked("follow-up")
        assert SPOT["todo"] in banner.words.text()
        assert "80 % that one explanation is left" in banner.words.text()
        assert [m.at_mm for m in banner.sketch.marks if m.name == "laser"] == [SPOT_MM]
        assert banner.sketch.isVisible()
        qtbot.mouseClick(banner.button, LEFT)
        banner = asked("change")
        assert not banner.other.isVisible()
        qtbot.mouseClick(banner.button, LEFT)
        banner = asked("follow-up")
        assert not banner.sketch.isVisible()
        qtbot.mouseClick(banner.other, LEFT)
        qtbot.waitUntil(lambda: not window.controller.running, timeout=PATIENCE_MS)
        qtbot.waitUntil(lambda: window.controller.recorded is not None, timeout=PATIENCE_MS)
    contents = window.controller.state.contents
    assert [(e.number, e.agreed) for e in contents.following if isinstance(e, FollowUpDecided)] == [
        (1, True),
        (2, False),
    ]
    assert {p.pickup for p in contents.measured} == {0, 1}
    window.show_page("diagnosis")
    finding = next(p for p in window.pages if p.title == "Diagnosis").finding
    qtbot.waitUntil(finding.story.isVisible, timeout=PATIENCE_MS)
    assert SPOT["todo"].rstrip(".") in finding.story.text()


def test_a_plate_to_be_struck_is_shown_as_it_hangs_and_its_blows_are_decided_upon(
    qtbot, window, page, asked, tmp_path
):
    """The rig strikes by itself; whether, and with which blows, the window says."""
    with engine_rig(tmp_path, sweep=SWEEP, hammer=True) as (_, experiment):
        whole = experiment.read_text().replace("record_s = 6.0", "record_s = 6.0\nwhole_length_mm = 310.0")
        experiment.write_text(whole + '[diagnosis]\nfollow_up = "offer"\n')
        order = Order(experiment, tmp_path / "out", ("sweep",), ask_content=True)
        setup = read_whole_experiment(experiment).configuration("run", "")
        engine = Engine.start(order, STRIKING_ENGINE)
        window.controller._show(LiveFeed(order, setup, window.controller, engine))
        banner = asked("follow-up")
        assert "hang it by two threads" in banner.words.text()
        assert banner.sketch.size_mm == pytest.approx((310.0, 199.9))
        assert {m.name: m.at_mm for m in banner.sketch.marks} == {
            "laser": STRUCK["spot_mm"],
            "hit": STRUCK["struck_mm"],
        }
        qtbot.mouseClick(banner.button, LEFT)
        window.show_page("hammer")
        hammer = next(p for p in window.pages if p.title == "Hammer")
        qtbot.waitUntil(hammer.hits.use.isVisible, timeout=PATIENCE_MS)
        assert window.controller.state.run.word == "damped plate struck"
        assert hammer.hits.table.row_count == 3
        assert hammer.hits.prompt.text() == "3 good hits: use them, or decide otherwise."
        hammer.hits.select(1)
        qtbot.mouseClick(hammer.hits.reject, LEFT)
        qtbot.waitUntil(lambda: hammer.hits.table.row_count == 4, timeout=PATIENCE_MS)
        qtbot.waitUntil(hammer.hits.use.isVisible, timeout=PATIENCE_MS)
        assert hammer.hits.table.texts(3) == ["left out", "used", "used", "used"]
        qtbot.waitUntil(lambda: hammer._averaged is not None, timeout=PATIENCE_MS)
        assert hammer.hit_plots.response.y.unit == "m/s"
        qtbot.mouseClick(hammer.hits.use, LEFT)
        qtbot.waitUntil(lambda: not window.controller.running, timeout=PATIENCE_MS)
    said = hammer.modes.source.text()
    assert said.startswith("The damped plate struck hung free: 3 hits")
    assert window.controller.state.contents.hits == []
    assert not hammer.hits.plates.isVisible()
