"""The plot every page uses: what it exports, draws and reads out."""

import csv
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QAction, QImage
from PySide6.QtWidgets import QApplication

from gui.plots import Axis, Plot
from gui.style.theme import LIGHT

X = np.linspace(1.0, 100.0, 50)


@pytest.fixture
def plot(qtbot, appearance):
    plot = Plot(Axis("frequency", "Hz"), Axis("velocity", "m/s"))
    qtbot.addWidget(plot)
    plot.resize(400, 300)
    plot.line("model", X, np.sqrt(X))
    plot.points("measured", X[::5], X[::5] / 10)
    plot.band("model's band", X, np.sqrt(X) - 1, np.sqrt(X) + 1)
    plot.show()
    qtbot.waitExposed(plot)
    return plot


def test_an_axis_without_numbers_below_it_leaves_its_room_to_the_title(qtbot, appearance):
    plot = Plot(Axis("frequency", "Hz", titled=False), Axis("distortion", "%"))
    qtbot.addWidget(plot)
    plot.show()
    high = plot.fontMetrics().horizontalAdvance("distortion / %") + 20
    plot.resize(300, high)
    assert plot.getAxis("left").labelText == "%"
    plot.getAxis("bottom").setStyle(showValues=False)
    plot.resize(300, high + 1)
    assert plot.getAxis("left").labelText == "distortion / %"


def test_a_title_without_room_becomes_its_symbol_and_then_its_unit(qtbot, appearance):
    plot = Plot(Axis("time", "s"), Axis("velocity of the laser", "mm/s", symbol="v"), legend=False)
    qtbot.addWidget(plot)
    plot.need_lines(1)
    plot.show()
    titles = []
    for height in range(400, 20, -10):
        plot.resize(300, height)
        titles.append(plot.getAxis("left").labelText)
    assert list(dict.fromkeys(titles)) == ["velocity of the laser / mm/s", "v / mm/s", "mm/s", ""]


def export(plot, kind, path, monkeypatch):
    """By the plot's own menu."""
    monkeypatch.setattr("gui.plots.export.ask_save", lambda *asked: asked[-1](path))
    (action,) = [a for a in plot.getViewBox().getMenu().actions() if a.text() == f"Export {kind}..."]
    assert isinstance(action, QAction)
    action.trigger()


def test_png_shows_what_is_seen_in_twice_the_pixels(plot, tmp_path, monkeypatch):
    export(plot, "PNG", tmp_path / "plot.png", monkeypatch)
    image = QImage(str(tmp_path / "plot.png"))
    assert (image.width(), image.height()) == (800, 600)
    colors = {image.pixelColor(x, y).name() for x in range(0, 800, 2) for y in range(0, 600, 2)}
    assert LIGHT.base in colors
    assert len(colors) > 10


def test_svg_is_lines_and_letters(plot, tmp_path, monkeypatch):
    export(plot, "SVG", tmp_path / "plot.svg", monkeypatch)
    text = (tmp_path / "plot.svg").read_text()
    assert ElementTree.fromstring(text).tag.endswith("svg")
    assert "velocity / m/s" in text
    assert "<image" not in text


def test_csv_has_every_number(plot, tmp_path, monkeypatch):
    export(plot, "data CSV", tmp_path / "plot", monkeypatch)
    with (tmp_path / "plot.csv").open(newline="") as file:
        head, *rows = csv.reader(file)
    columns = {name: [row[k] for row in rows] for k, name in enumerate(head)}
    assert columns["model: frequency (Hz)"] == [repr(float(x)) for x in X]
    assert [float(v) for v in columns["model: velocity (m/s)"]] == list(np.sqrt(X))
    assert [v for v in columns["measured: velocity (m/s)"] if v] == [repr(float(x)) for x in X[::5] / 10]
    assert "model's band low: velocity (m/s)" in columns


def test_a_picture_is_offered_the_name_of_what_it_shows(plot, monkeypatch):
    offered = []
    monkeypatch.setattr("gui.plots.export.ask_save", lambda *asked: offered.append(asked[2]))
    action = next(a for a in plot.getViewBox().getMenu().actions() if a.text() == "Export SVG...")
    action.trigger()
    assert offered == ["velocity.svg"]


def test_where_nothing_can_be_written_one_message_says_so(plot, tmp_path, monkeypatch):
    said = []
    monkeypatch.setattr("gui.plots.export.tell", lambda *a: said.append(a[-1]))
    for kind, ending in (("PNG", "png"), ("SVG", "svg"), ("data CSV", "csv")):
        export(plot, kind, tmp_path / "absent" / f"plot.{ending}", monkeypatch)
    assert len(said) == 3
    assert all("absent" in one for one in said)


def test_many_points_are_drawn_by_their_extremes(plot):
    samples = np.zeros(200_000)
    samples[123_456] = 7.0
    plot.trace("samples", np.arange(200_000) / 1e3, samples)
    QApplication.processEvents()
    x, y = plot._curves["samples"].items[0].getData()
    assert len(x) < 4 * plot.width()
    assert y.max() == 7.0
    assert len(plot.columns()["samples: velocity (m/s)"]) == 200_000


def test_the_place_under_the_mouse_is_read_out_in_units(qtbot, plot):
    box = plot.getViewBox()
    plot._readout.at(box.mapViewToScene(QPointF(50.0, 5.0)))
    assert plot._readout.text.replace("\u2212", "-") == "50 Hz,  5 m/s"
    plot._readout.eventFilter(plot, QEvent(QEvent.Type.Leave))
    assert plot._readout.text == ""


def test_on_logarithmic_axes_too(plot):
    plot.show_axes(Axis("frequency", "Hz", log=True), Axis("velocity", "m/s", log=True))
    plot.line("model", X, X)
    plot._readout.at(plot.getViewBox().mapViewToScene(QPointF(1.0, 1.0)))
    assert plot._readout.text == "10 Hz,  10 m/s"


@pytest.mark.qt_log_ignore("not accepted by receiving widget", extend=True)
def test_a_point_that_is_clicked_is_told_by_its_number(qtbot, plot):
    plot.keep(["measured"])
    plot.points("measured", np.array([1.0, 2.0, 3.0]), np.array([1.0, 3.0, 2.0]))
    plot.autoRange()
    QApplication.processEvents()
    at = plot.mapFromScene(plot.getViewBox().mapViewToScene(QPointF(2.0, 3.0)))
    with qtbot.waitSignal(plot.picked) as picked:
        qtbot.mouseMove(plot.viewport(), at)
        qtbot.mouseClick(plot.viewport(), Qt.MouseButton.LeftButton, pos=at)
    assert picked.args == ["measured", 1]


def test_the_same_name_replaces_a_curve(plot):
    plot.line("model", X, 2 * X)
    assert plot.names.count("model") == 1
    assert list(plot.columns()["model: velocity (m/s)"]) == list(2 * X)
    plot.keep(["model"])
    assert plot.names == ("model",)
    plot.empty()
    assert plot.columns() == {}


def test_colours_follow_the_theme(qtbot, plot, appearance):
    appearance.choose("dark")
    qtbot.waitUntil(lambda: plot.backgroundBrush().color().lightness() < 100)
    appearance.choose("light")
    qtbot.waitUntil(lambda: plot.backgroundBrush().color().lightness() > 200)
