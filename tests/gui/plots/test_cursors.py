"""Two cursors and their difference, a cursor and its harmonics."""

import numpy as np
import pytest

from gui.plots import Axis, Plot
from gui.plots.cursors import Cursors
from gui.style.theme import DARK


@pytest.fixture
def made(qtbot, appearance):
    def make(log=False):
        plot = Plot(Axis("frequency", "Hz", log=log), Axis("velocity", "m/s"))
        qtbot.addWidget(plot)
        plot.resize(400, 300)
        f = np.linspace(10.0, 400.0, 391)
        plot.line("model", f, 2.0 * f)
        plot.points("few", f[:3], f[:3])
        plot.show()
        qtbot.waitExposed(plot)
        return plot

    return make


def choose(plot, said):
    (action,) = [a for a in plot.getViewBox().getMenu().actions() if a.text() == said]
    action.trigger()


@pytest.mark.parametrize("log", [False, True])
def test_two_cursors_say_the_difference_in_x_and_of_the_curve_beneath(made, log):
    plot = made(log)
    choose(plot, "Two cursors")
    plot.cursors.move(0, 100.0)
    plot.cursors.move(1, 150.0)
    assert plot.cursors.x == pytest.approx([100.0, 150.0])
    first, second = plot.cursors.text.splitlines()
    assert first == "100 and 150 Hz, \u0394 50 Hz"
    assert second == "model: 200 and 300, \u0394 100 m/s, ratio 1.5"


def test_beyond_every_curve_only_the_places_are_said(made):
    plot = made()
    choose(plot, "Two cursors")
    plot.cursors.move(0, 5.0)
    assert len(plot.cursors.text.splitlines()) == 1


@pytest.mark.parametrize("log", [False, True])
def test_harmonics_follow_their_fundamental(made, log):
    plot = made(log)
    choose(plot, "Cursor with harmonics")
    plot.cursors.move(0, 37.5)
    assert plot.cursors.x == pytest.approx([37.5 * n for n in range(1, 11)])
    assert plot.cursors.text.startswith("1: 37.5 Hz")


def test_cursors_leave_the_axes_and_go_with_them(made):
    plot = made()
    before = plot.viewRange()
    choose(plot, "Cursor with harmonics")
    plot.cursors.move(0, 200.0)
    assert plot.viewRange() == before
    plot.cursors.paint(DARK)
    plot.show_axes(Axis("time", "s"), Axis("velocity", "m/s"))
    assert (plot.cursors.text, plot.cursors.x) == ("", [])


def test_between_points_only_a_curve_that_reaches_over_both_places_is_read(made):
    plot = made()
    cursors = Cursors(plot)
    cursors.choose("delta")
    cursors.move(0, 10.5)
    cursors.move(1, 11.5)
    assert "model: 21 and 23" in cursors.text
    plot.keep(["few"])
    cursors.move(1, 11.75)
    assert "few: 10.5 and 11.75" in cursors.text
