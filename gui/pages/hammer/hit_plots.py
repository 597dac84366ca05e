"""The selected hit: its blow, its whole record, its force spectrum beside the average's."""

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSplitter, QVBoxLayout, QWidget

from gui.pages.hammer.findings import Averaged, HitSeen
from gui.pages.hammer.traces import Traces
from gui.plots import Axis, Plot
from gui.style.theme import Role
from instrument.files.acceleration import AccelerationUnit, acceleration_unit
from instrument.impact.spectra import Spectra

_SHOWN_BEYOND = 2.0
"""The spectrum is shown up to so many times the usable band."""
_LABEL_AT = 0.58
"""Of the mark's label: above a legend, below the spectrum."""
_LEGEND_SHARE = 0.5
"""Of a plot's width, at most: a wider one lies over the curves wherever it stands."""


class HitPlots(QWidget):
    """Two above two."""

    def __init__(self) -> None:
        super().__init__()
        self.blow = Plot(Axis("Time after the peak", "ms", symbol="t"), Axis("Force", "N"), legend=False)
        self.force = Plot(Axis("Time after the blow", "s", symbol="t"), Axis("Force", "N"), legend=False)
        self.spectrum = Plot(Axis("Frequency", "Hz"), Axis("Spectrum", "N s", log=True, symbol="|F|"))
        self.response = Plot(
            Axis("Time after the blow", "s", symbol="t"),
            Axis("Response", acceleration_unit().symbol, symbol="a"),
            legend=False,
        )
        self.blow.setToolTip("The blow of the selected hit, sample by sample")
        self.force.setToolTip("The force over the whole record: a second blow is seen here")
        self.spectrum.setToolTip(
            "Spectrum of the force, of the selected hit and over the hits used: "
            "the blow excites little beyond the mark, where it has fallen by 20 dB"
        )
        self.response.setToolTip("The response over the whole record: has it rung down at the end?")
        self.response.setXLink(self.force)
        self.spectrum.getViewBox().sigResized.connect(self._place_legend)
        self._shown: tuple[int, Averaged | None, AccelerationUnit | None] = (0, None, None)
        rows = QSplitter(Qt.Orientation.Vertical)
        for pair in ((self.blow, self.spectrum), (self.force, self.response)):
            row = QSplitter(Qt.Orientation.Horizontal)
            for plot in pair:
                row.addWidget(plot)
            rows.addWidget(row)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(rows)

    def show_hit(self, averaged: Averaged | None, number: int) -> None:
        """One hit by its number; nothing where it has no samples."""
        unit = acceleration_unit()
        if self._shown[0] == number and self._shown[1] is averaged and self._shown[2] is unit:
            return
        self._shown = number, averaged, unit
        seen = averaged.seen.get(number) if averaged is not None else None
        by_laser = seen is not None and seen.judged.hit.responses[0].motion == "velocity"
        seen_as = ("m/s", "v") if by_laser else (unit.symbol, "a")
        self.response.show_axes(self.response.x, Axis("Response", seen_as[0], symbol=seen_as[1]))
        if averaged is None or seen is None:
            for plot in (self.blow, self.force, self.response, self.spectrum):
                plot.empty()
            return
        traces = Traces.of(seen.judged)
        self.blow.line("force", *traces.blow, "third")
        self.blow.points("samples", *traces.blow, "third", size=4.0)
        self.force.trace("force", *traces.force, "third")
        time_s, response = traces.response
        self.response.trace("response", time_s, response if by_laser else unit.of(response), "third")
        for plot in (self.blow, self.force, self.response):
            plot.enableAutoRange()
        self._show_spectrum(averaged, seen)

    def _show_spectrum(self, averaged: Averaged, seen: HitSeen) -> None:
        usable_hz = averaged.usable_hz or seen.usable_hz
        highest_hz = min(_SHOWN_BEYOND * usable_hz, seen.judged.hit.sample_rate_hz / 2)
        self._draw_spectrum("selected hit", seen.alone, highest_hz, "third")
        self._draw_spectrum("hits used", averaged.average, highest_hz, "data")
        self.spectrum.mark([usable_hz], "good", labels=[f"{usable_hz:.0f} Hz"], label_at=_LABEL_AT)
        self.spectrum.setXRange(0.0, highest_hz, padding=0.0)
        self._place_legend()

    def _place_legend(self) -> None:
        """Where it hides least; nowhere in a plot that it would fill, whose tip says what is drawn."""
        self.spectrum.place_legend()
        legend, room = self.spectrum.getPlotItem().legend, self.spectrum.getViewBox()
        legend.setVisible(legend.width() <= _LEGEND_SHARE * room.width())

    def _draw_spectrum(self, name: str, spectrum: Spectra | None, highest_hz: float, role: Role) -> None:
        if spectrum is None:
            self.spectrum.keep(n for n in self.spectrum.names if n != name)
            return
        part = slice(1, int(np.searchsorted(spectrum.frequency_hz, highest_hz)))
        self.spectrum.trace(name, spectrum.frequency_hz[part], spectrum.force[part], role)
