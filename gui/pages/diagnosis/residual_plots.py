"""The residual before and after, side by side, each on a scale of its own, a row a segment."""

from collections.abc import Collection
from typing import Any

import numpy as np
from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtWidgets import (
    QComboBox,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QScrollArea,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from fitting.digits import two_digits
from gui.pages.diagnosis.residual import NAMES, Panel, limit, panel, quantities, segments
from gui.plots import Axis, Plot
from gui.plots.curve import Symbol
from gui.style.theme import Role, current_theme
from gui.widgets.basic import hint
from gui.widgets.elided import ElidedLabel
from instrument.facts.diagnosis import STAGES, DiagnosisResult, StageName
from instrument.results.diagnosis_words import percent_of, segment_place
from instrument.results.numbers import format_number
from instrument.results.set_aside import NAME
from instrument.results.standing import fit_words, one_fit_words, stages_apart
from instrument.results.typeset import capitalised

_ROOM = 1.12
_LEAST_LINES = 7
_LOOKS: dict[str, tuple[Role, Symbol]] = {
    "real part": ("data", "o"),
    "imaginary part": ("third", "s"),
    "amplitude": ("data", "o"),
    NAME: ("bad", "t"),
}
_SIGNS: dict[Symbol, str] = {"o": "●", "s": "■", "t": "▽"}
_FOOT = -0.93
"""Of a panel's height: where readings without a residual are marked."""
_SHARE_OF_TYPE = 0.38
"""Size of a point to that of type."""
_ALL = "all"
_LOW = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
"""Digits as they stand below the line."""
_NO_POINTS = "No points: of tables of modes, what the fit leaves of each mode is on Several files, Fit."


class ResidualPlots(QWidget):
    """What a person chooses of it: quantity and segment."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.quantity, self.segment = QComboBox(), QComboBox()
        for box in (self.quantity, self.segment):
            box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.quantity.setToolTip(
            "Predicted over measured, less one: real part is amplitude, imaginary part phase to first order. "
            "Whitened: in units of noise and model error, as the fit weighs it."
        )
        self.plots: dict[tuple[int, StageName], Plot] = {}
        self._found: DiagnosisResult | None = None
        self._wanted = NAMES["both"]
        """As a person chose it: data without phase have amplitudes alone, and others come after them."""
        self._numbers: list[int] = []
        self._waiting: list[tuple[int, StageName]] = []
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._draw_next)
        self._before, self._after, self.nothing = QLabel(), QLabel(), hint(_NO_POINTS)
        self._inside = QWidget()
        self._grid = QGridLayout(self._inside)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(2)
        self._arrange()
        self.quantity.textActivated.connect(self._want)
        self.quantity.currentIndexChanged.connect(self._draw)
        self.segment.currentIndexChanged.connect(self._draw)

    def show_diagnosis(self, found: DiagnosisResult) -> None:
        """Draw what it leaves."""
        self._found = found
        _offer(self.quantity, {NAMES[q]: q for q in quantities(found)}, self._wanted)
        numbers = segments(found)
        every = {"all segments": _ALL} if len(numbers) > 1 else {}
        _offer(self.segment, {**every, **{f"segment {n}{self._place(n)}": n for n in numbers}})
        self._draw()

    def _want(self, name: str) -> None:
        self._wanted = name

    def _place(self, number: int) -> str:
        """File and pickup of a segment, after a comma, where there are several."""
        place = segment_place(self._found, number) if self._found is not None else ""
        return f", {place}" if place else ""

    def _titled(self, number: int) -> str:
        """Its file where there are several, and itself where it is not all of that file."""
        place = self._place(number).removeprefix(", ")
        if not place or self._found is None:
            return f"Segment {number}"
        alone = sum(segment_place(self._found, n) == place for n in segments(self._found)) == 1
        return capitalised(place) if alone else f"Segment {number}, {place}"

    @property
    def drawn(self) -> bool:
        """Whether everything is."""
        return not self._waiting

    def changeEvent(self, event: QEvent) -> None:
        """Colours and type follow the window's."""
        super().changeEvent(event)
        if event.type() in (QEvent.Type.PaletteChange, QEvent.Type.FontChange) and hasattr(self, "_timer"):
            self._draw()

    def _draw(self) -> None:
        found, chosen = self._found, self.segment.currentData()
        if found is None:
            return
        self._numbers = [n for n in segments(found) if chosen in (_ALL, n)]
        self.nothing.setVisible(not self._numbers)
        stages = stages_apart(found)
        for (n, stage), plot in self.plots.items():
            plot.setVisible(n in self._numbers and stage in stages)
        for label, stage in zip((self._before, self._after), STAGES, strict=True):
            label.setText(_title(found, stage))
            label.setVisible(stage in stages)
        # One plot a turn: the window stays quick.
        self._waiting = [(n, stage) for n in self._numbers for stage in stages]
        self._timer.start()

    def _draw_next(self) -> None:
        quantity = self.quantity.currentData()
        if not self._waiting or self._found is None:
            self._timer.stop()
            return
        number, stage = self._waiting.pop(0)
        plot = self._plot(number, stage)
        plot.setToolTip(f"{_symbol(number)}: residual of segment {number}{self._place(number)}, {stage}")
        titled, unit = number == self._numbers[-1], "" if quantity == "whitened" else "%"
        plot.show_axes(
            Axis("Frequency", "Hz", titled=titled), Axis(self._titled(number), unit, symbol=_symbol(number))
        )
        shown = panel(self._found, number, stage, quantity)
        height = _ROOM * limit(self._found, number, stage, quantity)
        _draw_panel(plot, shown, _FOOT * height)
        plot.setRange(xRange=shown.range_hz, yRange=(-height, height), padding=0)
        if number == self._numbers[0]:
            # Above the points: a legend among them would hide some.
            _name_series(plot, {*plot.names, *([NAME] if self._found.points_set_aside else [])})
        else:
            plot.getPlotItem().setTitle(None)

    def _plot(self, number: int, stage: StageName) -> Plot:
        """Before and after are linked in frequency."""
        if (number, stage) not in self.plots:
            plot = Plot(Axis("Frequency", "Hz"), Axis(f"Segment {number}"), legend=False)
            plot.need_lines(_LEAST_LINES)
            if stage == "after":
                _Twins(self.plots[number, "before"], plot)
            self._grid.addWidget(plot, number, STAGES.index(stage))
            self.plots[number, stage] = plot
        return self.plots[number, stage]

    def _arrange(self) -> None:
        for label in (self._before, self._after):
            label.setWordWrap(True)
        above = QHBoxLayout()
        for text, box in (("residual", self.quantity), ("of", self.segment)):
            above.addWidget(QLabel(text))
            above.addWidget(box)
        above.addStretch(1)
        band = ElidedLabel(
            "own scales; grey: noise, ± 2 std",
            "What is left may be larger: chi² counts the model error too.",
        )
        # The boxes beside it keep their words.
        for box in (self.quantity, self.segment):
            box.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        above.addWidget(band)
        titles = QHBoxLayout()
        for label in (self._before, self._after):
            titles.addWidget(label, 1)
        area = QScrollArea()
        area.setWidget(self._inside)
        area.setWidgetResizable(True)
        area.setFrameShape(QScrollArea.Shape.NoFrame)
        column = QVBoxLayout(self)
        column.setContentsMargins(4, 4, 4, 0)
        column.addLayout(above)
        column.addLayout(titles)
        column.addWidget(self.nothing)
        column.addWidget(area, 1)


def _symbol(number: int) -> str:
    """Of a segment's residual, for axes that have no room for a word."""
    return f"R{str(number).translate(_LOW)}"


class _Twins(QObject):
    """Two plots that show the same frequencies, whichever is moved.

    The library's own link aligns by place on the screen: plots that are laid out anew drift apart.
    """

    def __init__(self, one: Plot, other: Plot) -> None:
        super().__init__(other)
        self._boxes = one.getViewBox(), other.getViewBox()
        for box in self._boxes:
            box.sigXRangeChanged.connect(self._follow)

    def _follow(self, moved: Any) -> None:
        for box in self._boxes:
            if box is not moved and box.viewRange()[0] != moved.viewRange()[0]:
                box.setXRange(*moved.viewRange()[0], padding=0)


def _draw_panel(plot: Plot, shown: Panel, foot: float) -> None:
    names, size = [], _SHARE_OF_TYPE * plot.fontMetrics().height()
    for k, noise in enumerate(shown.noise):
        names.append(f"noise {k + 1}")
        plot.band(names[-1], noise.frequency_hz, -noise.height, noise.height, "faint")
    for series in shown.series:
        role, symbol = _LOOKS[series.name]
        plot.points(series.name, series.frequency_hz, series.values, role, symbol=symbol, size=size)
        names.append(series.name)
    if shown.aside_hz:
        (role, symbol), at = _LOOKS[NAME], np.full(len(shown.aside_hz), foot)
        plot.points(NAME, np.array(shown.aside_hz), at, role, symbol=symbol, size=size, hollow=True)
        names.append(NAME)
    plot.keep(names)


def _name_series(plot: Plot, names: Collection[str]) -> None:
    theme = current_theme()
    said = [
        f'<span style="color: {theme.color(role).name()}">{_SIGNS[symbol]}</span> {name}'
        for name, (role, symbol) in _LOOKS.items()
        if name in names
    ]
    size = f"{plot.font().pointSizeF():g}pt"
    plot.getPlotItem().setTitle("&nbsp;&nbsp; ".join(said), color=theme.text, size=size)


def _title(found: DiagnosisResult, stage: StageName) -> str:
    accepted = fit_words(found) or "any effect"
    said = (
        f"before: without {' and '.join(found.equivalent) or 'any effect'}"
        if stage == "before"
        else f"after: with {accepted}"
    )
    if len(stages_apart(found)) == 1:
        said = f"without any effect: {one_fit_words(found)}"
    chi2, rms = found.stage(stage).chi2_per_dof, found.stage(stage).rms_percent
    # The grey is of noise alone: what is left may be larger.
    noise = "" if chi2 is None else f", chi² per degree {format_number(chi2, 3)} of noise and model error"
    return f"<b>{said}</b><br>{two_digits(rms)} % rms in {percent_of(found)}{noise}"


def _offer(box: QComboBox, choices: dict[str, object], wanted: str = "") -> None:
    """These to choose from; what is wanted, or was chosen, stays where it can."""
    if [box.itemText(k) for k in range(box.count())] == list(choices):
        return
    before = wanted or box.currentText()
    box.blockSignals(True)
    box.clear()
    for text, data in choices.items():
        box.addItem(text, data)
    box.setCurrentIndex(max(0, box.findText(before)))
    box.blockSignals(False)
