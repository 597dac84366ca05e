"""What the window asks after a diagnosis: what to measure next, where, and what came of it."""

import pytest
from engine_cases import engine_rig
from following_cases import SPOT, SPOT_MM
from following_engine import FOLLOWING_ENGINE
from PySide6.QtCore import Qt

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
                window.controller.answer()
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
