"""What a person sees at a glance, and that it does not move about."""

import re

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QRect
from PySide6.QtWidgets import QAbstractButton

from gui.bars.channels import ClipLights, role_of, words_of
from gui.state.readings import Readings
from instrument.stream.raw import AcquisitionBegan, BlockAcquired


def block(overload=(False, False), peak=(0.5, 0.5), first=0):
    counts = np.array([[0, round(1e6 * p)] for p in peak], dtype=np.int32)
    return BlockAcquired(first, 2, (1e-6, 1e-6), (1.0, 1.0), overload, (False, False), counts)


@pytest.fixture
def readings():
    found = Readings()
    found.take(AcquisitionBegan(1, "sweep", 8192.0, ("base", "velocity")), 0.0)
    return found


def test_each_channel_says_how_near_its_range_it_is(readings):
    readings.take(block(peak=(0.5, 0.9)), 1.0)
    base, velocity = readings.channels
    assert (words_of(base, False), role_of(base, False)) == ("well", "good")
    assert (words_of(velocity, False), role_of(velocity, False)) == ("near its range", "fair")
    readings.take(block(overload=(False, True)), 2.0)
    assert words_of(readings.channels[1], False) == "clipped"
    assert readings.clipped == {"velocity": 2.0}


def test_a_light_stays_on_for_a_while_after_a_channel_was_clipped(qtbot, opened):
    lights, state = ClipLights(), opened.controller.state
    qtbot.addWidget(lights)
    state.run.state = "sweep"
    state.readings.take(AcquisitionBegan(1, "sweep", 8192.0, ("base", "velocity")), 0.0)
    for at, overload in ((1.0, (True, False)), (2.0, (False, False))):
        state.readings.take(block(overload=overload), at)
    lights.show_feed(opened.controller.feed)
    assert lights.said == {"base": "clipped", "velocity": "well"}
    state.readings.take(block(), 9.0)
    lights.show_feed(opened.controller.feed)
    assert lights.said["base"] == "well"


def test_a_light_without_room_for_its_name_shortens_it_visibly(qtbot, opened):
    lights, state = ClipLights(), opened.controller.state
    qtbot.addWidget(lights)
    state.run.state = "hammer"
    state.readings.take(AcquisitionBegan(1, "hammer", 8192.0, ("force", "response")), 0.0)
    state.readings.take(block(overload=(False, False)), 1.0)
    lights.resize(400, 20)
    lights.show_feed(opened.controller.feed)
    assert "</span> response" in lights.text()
    whole = lights.sizeHint()
    lights.resize(whole.width() - 10, 20)
    lights.show()
    assert "</span> response" not in lights.text()
    assert "</span> resp" in lights.text()
    assert "\u2026" in lights.text()
    assert "</span> force" in lights.text()
    assert "response: well" in lights.toolTip()
    assert lights.sizeHint() == whole


def test_nothing_moves_when_a_message_comes(window):
    before = window.tabs.geometry(), window.bar.geometry()
    window.notice.refuse("something could not be done")
    assert window.notice.isVisible()
    assert window.notice.height() < 2.5 * window.fontMetrics().height()
    assert (window.tabs.geometry(), window.bar.geometry()) == before


def test_a_message_covers_no_button_on_any_page(opened):
    opened.resize(1366, 768)
    opened.notice.say("saved experiment.toml")
    covered = []
    for page in opened.pages:
        opened.show_page(page.objectName())
        over = QRect(opened.notice.mapToGlobal(QPoint()), opened.notice.size())
        for one in opened.findChildren(QAbstractButton):
            at = QRect(one.mapToGlobal(QPoint()), one.size())
            if one.isVisible() and not opened.notice.isAncestorOf(one) and over.contains(at.center()):
                covered.append(f"{page.objectName()}: {one.text() or one.toolTip()}")
    assert covered == []
    bar = opened.tabs.tabBar()
    tabs = [
        QRect(bar.mapToGlobal(bar.tabRect(k).topLeft()), bar.tabRect(k).size()) for k in range(bar.count())
    ]
    assert not any(tab.intersects(over) for tab in tabs)


def test_the_log_has_the_time_of_day(opened):
    lines = [line for line in opened.log.text.splitlines() if line.strip()]
    assert lines
    assert all(re.match(r"\d\d:\d\d:\d\d +\d+:\d\d\.\d ", line) for line in lines)


def test_limits_lie_on_the_level_plot_and_leave_its_axes(qtbot, opened):
    opened.show_page("sweep")
    plot = opened.pages[1].step.base
    low, high = plot.viewRange()[1]
    limit = opened.controller.state.limits.limits.base_m_s2
    assert high < limit
    assert {round(line.value()) for line in plot.marks.groups["abort"].lines} == {round(limit), -round(limit)}
    assert low < 0 < high
