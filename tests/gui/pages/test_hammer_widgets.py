"""The widgets of the hammer test's page, each alone."""

import numpy as np
import pytest
from plot_numbers import plot_numbers

from gui.pages.hammer.bench import Latest
from gui.pages.hammer.frf_plots import FrfPlots
from gui.pages.hammer.hit_list import HitList
from gui.pages.hammer.hit_plots import HitPlots
from gui.pages.hammer.mode_table import ModeTable
from gui.pages.hammer.mode_words import MODE_COLUMNS, ModeRow
from gui.pages.hammer.table import ChoiceTable
from gui.pages.hammer.words import HIT_COLUMNS, HitRow
from gui.style.theme import LIGHT
from gui.widgets.tables import Cell


def hit(number, *, used):
    return HitRow(number, tuple(Cell(str(number)) for _ in HIT_COLUMNS), used)


def mode(frequency_hz):
    return ModeRow(frequency_hz, tuple(Cell(f"{frequency_hz:g}") for _ in MODE_COLUMNS))


def test_the_row_chosen_stays_so_and_is_told_when_it_is_gone(made):
    table, heard = made(ChoiceTable({"a": "", "b": ""}, usual_rows=3)), []
    table.show_rows([(Cell("1"), Cell("2"))] * 3)
    table.selectRow(2)
    table.chosen.connect(lambda: heard.append(table.selected))
    table.show_rows([(Cell("3"), Cell("4"))] * 3)
    assert (table.selected, heard) == (2, [])
    table.show_rows([(Cell("3"), Cell("4"))])
    assert heard == [None]


def test_the_usual_rows_are_whole_above_a_scroll_bar(made):
    table = made(ChoiceTable({"a": "", "b": ""}, usual_rows=3))
    table.show_rows([(Cell("1" * 80), Cell("2" * 80))] * 3)
    table.resize(200, table.sizeHint().height())
    table.show()
    assert table.horizontalScrollBar().isVisible()
    assert not table.verticalScrollBar().isVisible()


def test_a_hit_can_only_be_told_what_it_is_not(made):
    hits, heard = made(HitList()), []
    hits.rejected.connect(heard.append)
    hits.show_rows([hit(1, used=True), hit(2, used=False)], frozenset({2}))
    hits.select(1)
    assert (hits.accept.isEnabled(), hits.reject.isEnabled(), hits.undo.isEnabled()) == (False, True, False)
    hits.reject.click()
    assert heard == [1]
    hits.select(2)
    assert (hits.accept.isEnabled(), hits.reject.isEnabled(), hits.undo.isEnabled()) == (True, False, True)


def test_on_the_last_hit_the_selection_goes_on_to_a_new_one(made):
    hits = made(HitList())
    hits.show_rows([hit(1, used=True)], frozenset())
    hits.select(1)
    hits.show_rows([hit(1, used=True), hit(2, used=True)], frozenset())
    assert hits.number == 2
    hits.select(1)
    hits.show_rows([hit(k, used=True) for k in (1, 2, 3)], frozenset())
    assert hits.number == 1


def test_a_mode_selected_is_told_once_and_the_whole_band_again(made):
    modes, heard = made(ModeTable()), []
    modes.selected.connect(lambda: heard.append(modes.frequency_hz))
    modes.show_rows([mode(12.0), mode(40.0)], "")
    modes.select(1)
    modes.show_rows([mode(12.0), mode(40.0)], "one more hit")
    assert modes.note.text() == "one more hit"
    modes.whole.click()
    assert heard == [40.0, None]


def test_what_is_tried_is_coloured_and_can_be_taken_back(made):
    modes = made(ModeTable())
    modes.say("what if", what_if=True)
    assert modes.source.palette().windowText().color() == LIGHT.color("fair")
    assert not modes.back.isHidden()
    modes.say("as recorded", what_if=False)
    assert modes.back.isHidden()


def test_without_a_hit_nothing_is_drawn(made):
    plots = made(HitPlots())
    plots.force.line("force", np.array([0.0, 1.0]), np.array([0.0, 1.0]))
    plots.show_hit(None, 3)
    assert list(plots.force.names) == []


def test_a_legend_that_would_fill_its_plot_is_not_shown(made, qtbot):
    plots = made(HitPlots())
    plots.show()
    x = np.linspace(1.0, 2.0, 9)
    for name in ("selected hit", "hits used"):
        plots.spectrum.trace(name, x, x)
    legend = plots.spectrum.getPlotItem().legend
    for wide, seen in ((400, False), (1400, True)):
        plots.resize(wide, 500)
        qtbot.waitUntil(lambda seen=seen: legend.isVisible() == seen)


def test_only_what_was_asked_for_last_is_told(qtbot, qapp):
    latest, heard = Latest(qapp), []
    latest.done.connect(heard.append)
    for number in range(3):
        latest.want(lambda progress, number=number: number)
    qtbot.waitUntil(lambda: bool(heard))
    assert heard == [2]
    assert not latest.busy
    latest.deleteLater()


def test_only_the_lowest_plot_of_the_column_names_its_axis_in_every_mode(qtbot, appearance):
    plots = FrfPlots()
    qtbot.addWidget(plots)
    plots.resize(700, 400)
    plots.show()
    for mode in ("dark", "light"):
        appearance.choose(mode)
        qtbot.wait(1)
        named = [p.getAxis("bottom").labelText for p in (plots.magnitude, plots.phase, plots.coherence)]
        assert named == ["", "", "Frequency / Hz"]


@pytest.mark.parametrize("high", [210, 400])
def test_the_coherence_has_its_numbers_however_low_it_is(qtbot, appearance, high):
    plots = FrfPlots()
    qtbot.addWidget(plots)
    plots.resize(700, high)
    plots.show()
    qtbot.waitExposed(plots)
    assert {"0", "1"} <= {f"{float(said):g}" for said in plot_numbers(plots.coherence)}
