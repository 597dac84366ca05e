"""One pane for each resonance: what is foreseen, measured, and fitted of it."""

from functools import partial

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGridLayout, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from gui.pages.sweep.drawing import EXPLAINED_ROLE, FORESEEN, FREQUENCY, draw_amplitude
from gui.pages.sweep.panes import SIGNS, Key, Pointed, beside_key
from gui.pages.sweep.seen import PaneContents
from gui.plots import Axis
from gui.style.theme import Role
from instrument.check.piece import Region

_A_ROW = 3
"""More panes beside each other have no room for their numbers."""


class ResonancePanes(QWidget):
    """Amplitudes, side by side, each with axes of its own.

    Signals
    -------
    chosen : int
        A point was clicked.
    segment_wanted : int
        The heading of a pane was.
    """

    chosen = Signal(int)
    segment_wanted = Signal(int)

    def __init__(self) -> None:
        super().__init__()
        self.key = Key()
        self.plots: dict[int, Pointed] = {}
        self._headings: dict[int, QPushButton] = {}
        self._grid = QGridLayout()
        self._grid.setSpacing(2)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.key)
        column.addLayout(self._grid, 1)

    def show_seen(self, seen: PaneContents) -> None:
        """Draw all of them."""
        self._lay_out(seen.regions)
        for number, low, high in seen.regions:
            self._headings[number].setText(f"{number}  {low:.4g} to {high:.4g}")
            draw_amplitude(self.plots[number], seen.but(segment=number))
        entries: list[tuple[str, Role, str]] = [
            (g.name, g.role, SIGNS[g.symbol]) for g in seen.points.groups(seen.wanted)
        ]
        if seen.curve is not None or seen.predicted.index.size:
            entries.append((seen.fit_name, "model", "\u2500"))
        if seen.explained.index.size:
            entries.append((seen.explained.name, EXPLAINED_ROLE, "\u2500"))
        if seen.foreseen is not None:
            entries.append((FORESEEN, "faint", "- -"))
        bands = [(low, high) for _, low, high in seen.regions]
        entries += beside_key(
            one.name if any(one.inside(band).any() for band in bands) else f"{one.name} (outside)"
            for one in seen.beside
        )
        self.key.show_key(entries)

    def _lay_out(self, regions: tuple[Region, ...]) -> None:
        numbers = [number for number, _, _ in regions]
        if numbers == list(self.plots):
            return
        before: list[QWidget] = [*self.plots.values(), *self._headings.values()]
        for gone in before:
            gone.hide()
            gone.deleteLater()
        self.plots, self._headings = {}, {}
        for k, number in enumerate(numbers):
            row, column = 2 * (k // _A_ROW), k % _A_ROW
            self._grid.addWidget(self._heading(number), row, column)
            self._grid.addWidget(self._plot(number), row + 1, column)
        for k in range(_A_ROW):
            # As wide as each other, whatever their headings say.
            self._grid.setColumnStretch(k, 1 if k < len(numbers) else 0)
        for k in range(max(self._grid.rowCount(), 1)):
            self._grid.setRowStretch(k, 1 if k % 2 and k < 2 * (-(-len(numbers) // _A_ROW)) else 0)

    def _heading(self, number: int) -> QPushButton:
        made = QPushButton()
        made.setFlat(True)
        made.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        made.setToolTip("Numbered segment, from and to in Hz: it alone, with its phase")
        made.clicked.connect(partial(self.segment_wanted.emit, number))
        self._headings[number] = made
        return made

    def _plot(self, number: int) -> Pointed:
        made = Pointed(FREQUENCY, Axis("|v/a|"), legend=False)
        # A number near the end of a narrow axis may stand beyond it by half of itself.
        made.getAxis("bottom").beyond_px = made.fontMetrics().horizontalAdvance("000") / 2
        made.chosen.connect(self.chosen)
        self.plots[number] = made
        return made
