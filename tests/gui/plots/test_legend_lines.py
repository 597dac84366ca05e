from PySide6.QtGui import QFont, QFontMetrics

from gui.plots import Axis, Plot
from gui.plots.legend_lines import break_names, in_lines


class Letters:
    """All of one width."""

    def horizontalAdvance(self, said):
        return 10 * len(said)


def test_a_name_has_as_few_lines_as_have_room_and_no_word_is_broken():
    name = "result: with clamp_compliance (ambiguous)"
    assert in_lines(name, 410, Letters()) == name
    assert in_lines(name, 400, Letters()) == "result: with clamp_compliance<br>(ambiguous)"
    assert in_lines(name, 150, Letters()) == "result: with<br>clamp_compliance<br>(ambiguous)"


def test_a_legend_without_names_stays_as_it_is(made):
    plot = made(Plot(Axis("f"), Axis("y")))
    legend = plot.getPlotItem().legend
    break_names(legend, 100.0, QFontMetrics(QFont()))
    assert legend.items == []
