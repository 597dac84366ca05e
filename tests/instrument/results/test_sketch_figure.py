"""A sketch in a report."""

from instrument.results.sketch import Box, Mark, View
from instrument.results.sketch_figure import sketch_figure


def test_no_name_of_a_mark_runs_over_the_specimens_edge():
    marks = tuple(Mark(x, 90.0, "accelerometer", "sensor") for x in (5.0, 149.0, 151.0, 295.0))
    view = View("", (Box(0.0, 0.0, 300.0, 200.0, "bare"),), marks)
    figure = sketch_figure([view])
    figure.canvas.draw()
    (ax,) = figure.axes
    left, right = (ax.transData.transform((x, 0.0))[0] for x in (0.0, 300.0))
    for name in ax.texts:
        extent = name.get_window_extent()
        assert left < extent.x0
        assert extent.x1 < right
