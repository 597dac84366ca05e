"""The place under the mouse, and a plot's numbers as a file."""

import csv

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF
from PySide6.QtWidgets import QApplication

from gui.plots import Axis, Plot
from gui.plots.export import save_csv, save_png
from gui.plots.readout import Readout


@pytest.fixture
def plot(qtbot, appearance):
    plot = Plot(Axis("Frequency", "Hz", log=True), Axis("Velocity", "m/s"), legend=False)
    qtbot.addWidget(plot)
    plot.resize(400, 300)
    plot.line("long", np.array([1.0, 10.0, 100.0]), np.array([1.0, 2.0, 3.0]))
    plot.line("short", np.array([1.0, 10.0]), np.array([0.1, 0.2]))
    plot.show()
    qtbot.waitExposed(plot)
    return plot


def test_a_place_is_said_in_the_plots_own_units(plot):
    readout, box = Readout(plot), plot.getViewBox()
    readout.at(box.mapViewToScene(QPointF(1.0, 2.0)))
    assert readout.text == "10 Hz,  2 m/s"
    QApplication.sendEvent(plot, QEvent(QEvent.Type.Leave))
    assert readout.text == ""
    readout.at(box.sceneBoundingRect().topLeft() - QPointF(20.0, 20.0))
    assert readout.text == ""


def test_columns_of_different_length_end_in_empty_cells(plot, tmp_path):
    save_csv(plot, tmp_path / "plot.csv")
    rows = list(csv.reader((tmp_path / "plot.csv").read_text(encoding="utf-8").splitlines()))
    assert len(rows) == 4
    assert [row[:2] for row in rows[1:]] == [["1.0", "1.0"], ["10.0", "2.0"], ["100.0", "3.0"]]
    assert rows[3][2:] == ["", ""]


@pytest.mark.parametrize("save", [save_csv, save_png])
def test_a_file_that_cannot_be_written_is_an_error(plot, tmp_path, save):
    with pytest.raises(OSError, match=r"No such file|cannot be written"):
        save(plot, tmp_path / "nowhere" / "plot.png")
