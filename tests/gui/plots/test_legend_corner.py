"""A legend lies where it hides least of the curves."""

import numpy as np
import pytest

from gui.pages.law.curve import LawCurve
from gui.pages.law.plots import LawLine, LawPlots
from gui.plots import Axis, Plot
from gui.plots.corner import emptiest_corner

F = np.linspace(20.0, 300.0, 60)
RISING, FALLING = 0.3 + F / 300, 1.3 - F / 300


@pytest.mark.parametrize(
    ("curves", "corner"),
    [
        ([RISING], (-8, -8)),
        ([FALLING], (-8, 8)),
        ([RISING, FALLING, np.full(60, 1.3)], (8, -8)),
        ([np.full(60, np.nan)], (-8, -8)),
        ([], (-8, -8)),
    ],
    ids=["rising", "falling", "all but one", "no number", "none"],
)
def test_it_goes_where_no_curve_is(curves, corner):
    if len(curves) == 3:
        curves = [np.where(F > 130, RISING, np.nan), np.where(F > 130, FALLING, np.nan), np.full(60, 1.3)]
    assert emptiest_corner([(F, y) for y in curves]) == corner


def test_a_falling_loss_factor_is_not_hidden_by_the_names_of_the_lines(qtbot):
    plots = LawPlots()
    qtbot.addWidget(plots)
    nothing = np.full(60, 0.01)
    for loss, corner in ((RISING, (-8, -8)), (FALLING, (-8, 8))):
        plots.show_lines([LawLine("result", LawCurve(F, F, nothing, loss, nothing), "data")])
        assert tuple(plots.loss.getPlotItem().legend.opts["offset"]) == corner


def test_a_long_name_is_seen_whole_in_a_narrow_plot_and_in_one_line_in_a_wide_one(qtbot, appearance):
    plots = LawPlots()
    qtbot.addWidget(plots)
    plots.resize(640, 400)
    plots.show()
    qtbot.waitExposed(plots)
    name, nothing = "result: with clamp_compliance (ambiguous)", np.full(60, 0.01)
    plots.show_lines([LawLine(name, LawCurve(F, F, nothing, RISING, nothing), "data")])
    legend, box = plots.loss.getPlotItem().legend, plots.loss.getViewBox()
    ((_, label),) = legend.items
    for wide, broken in ((640, True), (1400, False), (640, True)):
        plots.resize(wide, 400)
        qtbot.wait(10)
        assert ("<br>" in label.text) == broken
        assert label.text.replace("<br>", " ") == name
        assert box.rect().contains(legend.mapRectToItem(box, legend.boundingRect()))


def test_beside_a_peak_the_names_hide_nothing_of_it(made, appearance):
    plot = made(Plot(Axis("frequency", "Hz"), Axis("amplitude")))
    for peak_hz, corner in ((250.0, (8, 8)), (60.0, (-8, 8))):
        plot.line("measured", F, 1 / np.hypot(1.0, (F - peak_hz) / 40))
        plot.place_legend()
        assert tuple(plot.getPlotItem().legend.opts["offset"]) == corner
    plot.show_axes(plot.x, Axis("amplitude", log=True))
    plot.line("measured", F, np.where(F > 100, F, 0.0))
    plot.place_legend()
    assert tuple(plot.getPlotItem().legend.opts["offset"]) == (-8, -8)


def test_names_and_marks_are_as_small_again_as_the_type(made, appearance, qtbot):
    plot = made(Plot(Axis("frequency", "Hz"), Axis("amplitude")))
    plot.line("measured", F, RISING)
    plot.line("model", F, FALLING)
    plot.mark([100.0], labels=["dwell"])
    plot.show()
    qtbot.waitExposed(plot)
    legend, ((line,),) = plot.getPlotItem().legend, [g.lines for g in plot.marks.groups.values()]

    def sizes(scale):
        appearance.resize(scale)
        qtbot.wait(10)
        assert line.label.textItem.font().pointSizeF() == plot.font().pointSizeF()
        return legend.height(), legend.width()

    usual, large = sizes(1.0), sizes(1.5)
    assert large > usual
    assert sizes(1.0) == usual
