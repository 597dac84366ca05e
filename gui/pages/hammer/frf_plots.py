"""The accelerance: magnitude, phase and coherence over one axis; the whole band or one mode."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtWidgets import QSplitter, QVBoxLayout, QWidget

from fitting.arrays import Array
from fitting.modal.frf import Frf
from gui.pages.hammer.findings import Averaged, ModesFound
from gui.pages.hammer.traces import Lines, Surroundings, accelerance
from gui.plots import Axis, Plot
from gui.style.theme import Role
from instrument.impact.curves import HalfPowerMarks
from instrument.impact.spectra import Spectra

_MOST_SINGLE = 20
"""Hits drawn one by one; the latest."""
_BEYOND = 1.1
"""The FRF is drawn so much further than the band."""
_EXPECTED_AT, *_LABELS_AT = 0.36, 0.08, 0.22
"""Heights of the labels "expected", f₁ and f₂, so that none lies upon another."""
_HEIGHTS = (46, 24, 30)
_LEAST_LINES = 3.2
"""Of a plot without its axis below; the last one has it."""
_AXIS_LETTERS = 3.6
"""Width of the axis beside the plots, in heights of a letter."""
_LEAST_SHARE_BEYOND = 0.08
"""Of the coherence's range, on either side of it."""
_BESIDE: tuple[Role, ...] = ("second", "fourth")
_AVERAGE, _HIT, _MODES = "average", "selected hit", "modes"


class FrfPlots(QWidget):
    """Three plots, one frequency axis.

    Signals
    -------
    mode_picked
        The mark of a mode was clicked: its number, from 0.
    """

    mode_picked = Signal(int)

    def __init__(self) -> None:
        super().__init__()
        hz = Axis("Frequency", "Hz")
        above = replace(hz, titled=False)
        self.magnitude = Plot(above, Axis("|H|", "(m/s²/N)", log=True))
        self.phase = Plot(above, Axis("Phase", "°", symbol="φ"), legend=False)
        self.coherence = Plot(hz, Axis("γ²"), legend=False)
        self.magnitude.setToolTip("Accelerance: acceleration over force, averaged over the hits used (H1)")
        self.phase.setToolTip("By how much the acceleration is ahead of the force")
        self.coherence.setToolTip("Coherence: 1 where the response follows the force alike in every hit")
        self.magnitude.picked.connect(self._picked)
        self._band_hz, self._reach_hz = (0.0, 1000.0), 1000.0
        self._zoomed: set[str] = set()
        self._beside: set[str] = set()
        self._singles: dict[str, Spectra] = {}
        self._expected_hz: tuple[float, ...] = ()
        self._arrange()

    def show_band(self, band_hz: tuple[float, float]) -> None:
        """Where modes are looked for."""
        self._band_hz = band_hz
        self.zoom(None)

    def show_average(self, averaged: Averaged) -> None:
        """The average over its single hits."""
        high = self._band_hz[1]
        self._reach_hz = max(_BEYOND * high, min(averaged.usable_hz or 0.0, 2 * high))
        used = [n for n, seen in averaged.seen.items() if seen.judged.accepted][-_MOST_SINGLE:]
        singles = [f"hit {n} alone" for n in used]
        self.magnitude.keep(n for n in self.magnitude.names if not n.endswith("alone") or n in singles)
        for n, name in zip(used, singles, strict=True):
            self._show_single(name, averaged.seen[n].alone)
        # For the legend: one word for all of them.
        self.magnitude.trace("single hits", np.zeros(0), np.zeros(0), "faint")
        if _HIT not in self.magnitude.names:
            # Before the average, so that it lies below.
            self._show_lines(_HIT, None, "third")
        average = averaged.average
        self._show_lines(_AVERAGE, _first(average.frfs) if average is not None else None, "data")
        self._show_coherence(averaged)
        at = [averaged.usable_hz] if averaged.usable_hz is not None else []
        self.magnitude.mark(at, "good", name="usable", labels=[f"usable to {f:.0f} Hz" for f in at])

    def show_hit(self, averaged: Averaged, number: int) -> None:
        """The selected hit by itself."""
        seen = averaged.seen.get(number)
        self._show_lines(_HIT, _first(seen.alone.frfs) if seen is not None else None, "third")

    def show_beside(self, frfs: Mapping[str, Frf]) -> None:
        """Those of other files, by the names they are listed under; instead of those there were."""
        gone, self._beside = self._beside - frfs.keys(), set(frfs)
        for plot in (self.magnitude, self.phase):
            plot.keep(n for n in plot.names if n not in gone)
        for k, (name, frf) in enumerate(frfs.items()):
            if len(frf.frequency_hz) < 2:
                continue
            self._show_lines(name, accelerance(frf), _BESIDE[k % len(_BESIDE)])

    def show_modes(self, modes: ModesFound | None) -> None:
        """A mark on each peak, to be clicked."""
        found = modes.found if modes is not None else None
        f = np.array([m.frequency_hz for m in found.modes]) if found is not None else np.zeros(0)
        heights = [
            np.interp(m.frequency_hz, frf.frequency_hz, np.abs(frf.H))
            for m in (found.modes if found is not None else ())
            if found is not None and (frf := found.plain[m.channel])
        ]
        self.magnitude.points(_MODES, f, np.array(heights), "model", symbol="t", size=10.0, listed=False)

    def show_expected(self, frequency_hz: Array | None) -> None:
        """Where the specimen file has the bare plate's modes. Shape (modes,)."""
        self._expected_hz = () if frequency_hz is None else tuple(float(f) for f in frequency_hz)
        self.phase.mark(self._expected_hz, "faint", name="expected")
        self._mark_expected()

    def zoom(self, around: Surroundings | None) -> None:
        """One mode with what was read off it; the whole band where there is none."""
        before, self._zoomed = self._zoomed, set()
        if around is not None:
            self._show_surroundings(around)
        for plot in (self.magnitude, self.phase):
            plot.keep(n for n in plot.names if n in self._zoomed or n not in before)
        self._mark_half_power(around.marks if around is not None else None)
        self._mark_expected()
        # Beside the curves: below them in the whole band, above them about a peak.
        legend = self.magnitude.getPlotItem().legend
        legend.setColumnCount(4 if around is None else 2)
        legend.setOffset((-8, -4) if around is None else (-8, 4))
        low, high = self._band_hz if around is None else (around.low_hz, around.high_hz)
        self.magnitude.setXRange(low, high, padding=0.0)
        self.magnitude.enableAutoRange(axis="y")

    def empty(self) -> None:
        """Nothing to show."""
        for plot in (self.magnitude, self.phase, self.coherence):
            plot.empty()

    def changeEvent(self, event: QEvent) -> None:
        """Larger letters want more room."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "magnitude"):
            self._align()
            self._leave_room_for_ends()

    def _mark_expected(self) -> None:
        """Named once: on the first of all, or where it is looked at closely."""
        at = self._expected_hz
        labels = ["expected"] * len(at) if self._zoomed else ["expected"][: len(at)]
        self.magnitude.mark(at, "faint", name="expected", labels=labels, label_at=_EXPECTED_AT)

    def _show_single(self, name: str, alone: Spectra) -> None:
        """Drawn once: there may be many, and a hit does not change."""
        if name in self.magnitude.names and self._singles.get(name) is alone:
            return
        self._singles[name] = alone
        lines = Lines.of(_first(alone.frfs), self._reach_hz)
        self.magnitude.trace(name, lines.frequency_hz, lines.magnitude, "faint", listed=False)

    def _show_lines(self, name: str, frf: Frf | None, role: Role) -> None:
        none = np.zeros(0)
        lines = Lines.of(frf, self._reach_hz) if frf is not None else Lines(none, none, none)
        self.magnitude.trace(name, lines.frequency_hz, lines.magnitude, role)
        self.phase.trace(name, lines.frequency_hz, lines.phase_deg, role)

    def _show_coherence(self, averaged: Averaged) -> None:
        average = averaged.average
        if average is None or average.coherence is None:
            self.coherence.empty()
            return
        part = slice(1, int(np.searchsorted(average.frequency_hz, self._reach_hz)))
        self.coherence.trace("coherence", average.frequency_hz[part], _first(average.coherence)[part], "data")

    def _show_surroundings(self, around: Surroundings) -> None:
        lines, fine, fit, m = around.lines, around.fine, around.fit, around.marks
        self._add(self.magnitude, "windowed", fine.frequency_hz, fine.magnitude, "good", dashed=True)
        if fit is not None:
            self._add(self.magnitude, "rational fit", fit.frequency_hz, fit.magnitude, "model")
            self._add(self.phase, "rational fit", fit.frequency_hz, fit.phase_deg, "model")
        self._zoomed.add("lines")
        self.magnitude.points("lines", lines.frequency_hz, lines.magnitude, "data", size=6.0, listed=False)
        self.phase.points("lines", lines.frequency_hz, lines.phase_deg, "data", size=6.0)
        if m is not None:
            ends = np.array([m.low_hz, m.high_hz])
            self._add(self.magnitude, "half power, −3 dB", ends, np.full(2, m.level), "good")

    def _mark_half_power(self, marks: HalfPowerMarks | None) -> None:
        at = {"f₁": marks.low_hz, "f₂": marks.high_hz} if marks is not None else {"f₁": None, "f₂": None}
        for (name, f), height in zip(at.items(), _LABELS_AT, strict=False):
            found = [f] if f is not None else []
            labels = [f"{name} {x:.3f}" for x in found]
            self.magnitude.mark(found, "good", name=name, labels=labels, label_at=height)

    def _add(self, plot: Plot, name: str, x: Array, y: Array, role: Role, *, dashed: bool = False) -> None:
        self._zoomed.add(name)
        plot.line(name, x, y, role, width=1.5 if dashed else 2.0, dashed=dashed)

    def _arrange(self) -> None:
        self.magnitude.getViewBox().setAutoVisible(y=True)
        self.phase.setYRange(-90, 270, padding=0.05)
        self.phase.getAxis("left").setTickSpacing(180, 90)
        self.coherence.getViewBox().sigResized.connect(self._leave_room_for_ends)
        self.coherence.getAxis("left").setTickSpacing(1, 0.5)
        rows = QSplitter(Qt.Orientation.Vertical)
        for plot in (self.magnitude, self.phase, self.coherence):
            rows.addWidget(plot)
            plot.need_lines(_LEAST_LINES + 2.4 * (plot is self.coherence) + 3.4 * (plot is self.magnitude))
        for plot in (self.phase, self.coherence):
            plot.setXLink(self.magnitude)
        for plot in (self.magnitude, self.phase):
            plot.getAxis("bottom").setStyle(showValues=False)
        self._align()
        rows.setSizes([10 * part for part in _HEIGHTS])
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(rows)

    def _align(self) -> None:
        """One axis above the other, whatever their numbers are."""
        for plot in (self.magnitude, self.phase, self.coherence):
            plot.getAxis("left").setWidth(_AXIS_LETTERS * self.fontMetrics().height())

    def _leave_room_for_ends(self) -> None:
        """However low the coherence is drawn, half a number has room beyond 0 and 1: or none is said."""
        number, high = self.fontMetrics().height(), self.coherence.getViewBox().height()
        share = number / 2 / max(high - number, number)
        self.coherence.setYRange(0, 1, padding=max(_LEAST_SHARE_BEYOND, share))

    def _picked(self, name: str, number: int) -> None:
        if name == _MODES:
            self.mode_picked.emit(number)


def _first(by_channel: dict[str, Any]) -> Any:
    return next(iter(by_channel.values()))
