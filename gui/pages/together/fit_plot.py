"""Points of each file and the line that one law has there."""

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QSignalBlocker
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from gui.files.short_name import short_name
from gui.pages.together.fits import FAR_STD, FittedFile
from gui.plots import Axis, Plot
from gui.plots.curve import Symbol
from gui.style.theme import Role
from gui.widgets.basic import hint
from instrument.results.set_aside import NAME

_ROLES: tuple[Role, ...] = ("data", "model", "second", "third", "fourth")
_SYMBOLS: tuple[Symbol, ...] = ("o", "s", "t", "d", "t1", "star")
_EVERY = "all files"
_AMPLITUDE, _DIFFERENCE = "amplitude", "difference"
_FREQUENCY = Axis("Frequency", "Hz", log=True)
_SIZE = 5.0
_FAR_SIZE = 11.0
_FAR = "not explained"
_OF_SWEEPS = (
    "Points: measured, for the amplitude asked for. Lines: the one law. "
    f"Crosses: over {FAR_STD:g} standard deviations off."
)
_OF_MODES = "Points: measured modes. Rings: where the one law has them."


class FitPlot(QWidget):
    """Of the files that a person chooses."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.plot = Plot(_FREQUENCY, Axis("Velocity", "m/s", log=True))
        self.file, self.quantity = QComboBox(), QComboBox()
        for box in (self.file, self.quantity):
            box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.file.addItem(_EVERY)
        self.quantity.addItem("amplitude", _AMPLITUDE)
        self.quantity.addItem("fit over measured, less one", _DIFFERENCE)
        self.said = hint(_OF_SWEEPS)
        self._fitted: Sequence[FittedFile] = ()
        self._of_modes = False
        self.file.currentIndexChanged.connect(self._draw)
        self.quantity.currentIndexChanged.connect(self._draw)
        self.above = QHBoxLayout()
        for text, box in (("of", self.file), ("shown", self.quantity)):
            self.above.addWidget(QLabel(text))
            self.above.addWidget(box)
        self.above.addStretch(1)
        column = QVBoxLayout(self)
        column.setContentsMargins(4, 4, 4, 0)
        column.addLayout(self.above)
        column.addWidget(self.plot, 1)
        column.addWidget(self.said)

    def show_files(self, fitted: Sequence[FittedFile], *, of_modes: bool) -> None:
        """Instead of those there were; the file chosen stays chosen where it is still there."""
        self._fitted, self._of_modes = fitted, of_modes
        titles = [_EVERY, *(short_name(one.title) for one in fitted)]
        if [self.file.itemText(k) for k in range(self.file.count())] != titles:
            before = self.file.currentText()
            with QSignalBlocker(self.file):
                self.file.clear()
                self.file.addItems(titles)
                self.file.setCurrentIndex(max(0, self.file.findText(before)))
        self.said.setText(_OF_MODES if of_modes else _OF_SWEEPS)
        self.quantity.setItemText(0, "loss factor" if of_modes else "amplitude")
        self._draw()

    def _draw(self) -> None:
        whole = self.quantity.currentData() == _AMPLITUDE
        self.plot.show_axes(_FREQUENCY, self._axis(whole=whole))
        chosen = self.file.currentIndex() - 1
        names: list[str] = []
        for k, one in enumerate(self._fitted):
            if chosen in (-1, k):
                names += self._draw_file(one, _ROLES[k % len(_ROLES)], _SYMBOLS[k % len(_SYMBOLS)], whole)
        self.plot.keep(names)

    def _axis(self, *, whole: bool) -> Axis:
        if not whole:
            return Axis("Difference", "%")
        return Axis("Loss factor", log=True) if self._of_modes else Axis("Velocity", "m/s", log=True)

    def _draw_file(self, one: FittedFile, role: Role, symbol: Symbol, whole: bool) -> list[str]:
        f, fitted = one.frequency_hz, f"{one.title}, fitted"
        y = one.measured if whole else one.difference_percent
        known = np.isfinite(f)
        self.plot.points(one.title, f[known], y[known], role, symbol=symbol, size=_SIZE)
        names = [one.title]
        if whole and self._of_modes:
            self.plot.points(
                fitted,
                one.predicted_hz,
                one.predicted,
                role,
                symbol=symbol,
                size=2 * _SIZE,
                listed=False,
                hollow=True,
            )
            names.append(fitted)
        elif whole:
            self.plot.line(fitted, f, one.predicted, role, listed=False)
            names.append(fitted)
        if one.far.any():
            far = f"{one.title}, {_FAR}"
            self.plot.points(far, f[one.far], y[one.far], "bad", symbol="x", size=_FAR_SIZE, listed=False)
            names.append(far)
        if whole and one.aside.size:
            aside = f"{one.title}, {NAME}"
            self.plot.points(aside, one.aside_hz, one.aside, "bad", symbol="t", hollow=True)
            names.append(aside)
        return names
