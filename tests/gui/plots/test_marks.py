import numpy as np
import pytest

from gui.plots import Axis, Plot
from gui.plots.log_axis import LogAxis
from gui.plots.marks import Marks


@pytest.fixture
def plot(qtbot):
    plot = Plot(Axis("Frequency", "Hz"), Axis("Force", "N", log=True))
    qtbot.addWidget(plot)
    return plot


def lines_of(plot):
    return sorted(line.value() for marks in plot.marks.groups.values() for line in marks.lines)


def test_marks_of_another_name_stay(plot):
    plot.mark([1.0, 2.0])
    plot.mark([5.0], "good", name="usable", labels=["to 5 Hz"])
    plot.mark([3.0])
    assert lines_of(plot) == [3.0, 5.0]
    assert plot.marks.groups["usable"].lines[0].label.toPlainText() == "to 5 Hz"
    plot.empty()
    assert lines_of(plot) == []


def test_a_mark_is_a_point_wide_on_any_screen(plot, monkeypatch):
    marks = Marks(plot)
    monkeypatch.setattr(plot, "devicePixelRatioF", lambda: 2.0)
    marks.show("limit", [2.0], "bad", (), 0.1, level=True)
    (line,) = marks.groups["limit"].lines
    assert line.pen.widthF() == 2.0


def test_what_is_faint_lies_below_what_came_before(plot):
    x = np.arange(1.0, 4.0)
    plot.line("average", x, x, "data")
    plot.trace("single", x, x, "faint", listed=False)
    below, above = (plot._curves[name].items[0].zValue() for name in ("single", "average"))
    assert below < above
    assert [label.text for _, label in plot.getPlotItem().legend.items] == ["average"]


def test_a_decade_names_three_of_its_lines(qapp):
    axis = LogAxis("left")
    axis.setLogMode(True)
    said = axis.logTickStrings(list(np.log10(np.arange(1, 10))), 1.0, 1.0)
    assert [text for text in said if text] == ["1", "2", "5"]


@pytest.mark.parametrize(
    ("low", "high", "said"),
    [
        (0.075, 0.152, ["0.08", "0.1", "0.12", "0.14"]),
        (990.0, 1010.0, ["990", "995", "1000", "1005", "1010"]),
        (2.0, 7.0, ["2", "3", "4", "5", "6", "7"]),
    ],
)
def test_of_less_than_a_decade_there_are_numbers_enough_to_read_it(qapp, low, high, said):
    axis = LogAxis("left")
    axis.setLogMode(True)
    ((spacing, values),) = axis.logTickValues(np.log10(low), np.log10(high), 300.0, [])
    assert axis.logTickStrings(values, 1.0, spacing) == said
    np.testing.assert_allclose(10.0 ** np.array(values), np.array(said, float))
    axis.logTickValues(-2.0, 1.0, 300.0, [(1.0, [-2.0, -1.0, 0.0, 1.0])])
    assert axis.logTickStrings([0.0, np.log10(3.0)], 1.0, 1.0) == ["1", ""]


def test_a_number_that_people_write_without_a_power_has_none(qapp):
    axis = LogAxis("left")
    axis.setLogMode(True)
    said = axis.logTickStrings([-5.0, -4.0, -2.0, 0.0, 1.0, 3.0, 4.0], 1.0, 1.0)
    assert said == ["10⁻⁵", "0.0001", "0.01", "1", "10", "1000", "10⁴"]
