"""Amplitude above phase over frequency, the fitted model and its band through the points."""

from dataclasses import replace

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QSplitter,
    QVBoxLayout,
    QWidget,
)

from gui.pages.sweep.curve import STANDARD_ERRORS, CurveStretch, joined
from gui.pages.sweep.panes import BESIDE, CHOSEN, Pointed, align
from gui.pages.sweep.points import Group
from gui.pages.sweep.seen import PaneContents, Quantity, Way
from gui.plots import Axis

_FREQUENCY = Axis("Frequency", "Hz")
_SHOWN: dict[str, Quantity] = {
    "velocity over base": "ratio",
    "velocity at its level": "velocity",
}


class ResponsePane(QWidget):
    """The response of one segment, or of all."""

    chosen = Signal(int)
    way_changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.quantity = QComboBox()
        self.quantity.addItems(list(_SHOWN))
        self.quantity.setToolTip(
            "Velocity over the measured base acceleration; or that times the level commanded, which is what "
            "the fit takes and what its predictions are compared with"
        )
        self.log_amplitude = QCheckBox("log amplitude")
        self.log_frequency = QCheckBox("log frequency")
        self.model = QLabel()
        self.model.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.model.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.amplitude = Pointed(_FREQUENCY, Axis("|v/a|"))
        self.phase = Pointed(_FREQUENCY, Axis("Phase of v/a", "\u00b0"), legend=False)
        self.phase.setXLink(self.amplitude)
        self.quantity.currentTextChanged.connect(self._changed)
        for box in (self.log_amplitude, self.log_frequency):
            box.toggled.connect(self._changed)
        for plot in (self.amplitude, self.phase):
            plot.chosen.connect(self.chosen)
        self._arrange()

    @property
    def way(self) -> Way:
        """As chosen."""
        return Way(
            _SHOWN[self.quantity.currentText()],
            self.log_amplitude.isChecked(),
            self.log_frequency.isChecked(),
        )

    def show_seen(self, seen: PaneContents) -> None:
        """Draw."""
        way, reading = seen.way, seen.reads.capitalize()
        frequency = replace(_FREQUENCY, log=way.log_frequency)
        self.amplitude.show_axes(frequency, Axis(way.label, way.unit, way.log_amplitude))
        self.amplitude.setToolTip(
            f"{reading} velocity v at the pickup, a the base's acceleration, zero to peak"
        )
        self.phase.show_axes(frequency, self.phase.y)
        names = self._draw_model(seen)
        for group in seen.points.groups(seen.wanted):
            self._draw_points(seen, group)
            names.append(group.name)
        names += self._draw_beside(seen)
        for plot in (self.amplitude, self.phase):
            plot.keep((*names, CHOSEN))
        self._point_out(seen)
        for plot in (self.amplitude, self.phase):
            plot.frame(seen.band_hz)
        align(self.amplitude, self.phase)

    def _draw_points(self, seen: PaneContents, group: Group) -> None:
        p, k = seen.points, group.index
        self.amplitude.show_points(group, p.frequency_hz[k], np.abs(seen.shown[k]))
        self.phase.show_points(group, p.frequency_hz[k], p.phase_deg[k])

    def _draw_beside(self, seen: PaneContents) -> list[str]:
        """Names of what is drawn."""
        for one in seen.beside:
            mine = one.inside(seen.band_hz)
            f, z = one.frequency_hz[mine], one.over_base_s[mine]
            size = np.abs(z) * seen.way.factor(one.level_m_s2[mine])
            self.amplitude.points(one.name, f, size, **BESIDE)
            if one.has_phase:
                phase = np.unwrap(np.degrees(np.angle(z)), period=360.0)
                self.phase.points(one.name, f, phase, **BESIDE)
        return [one.name for one in seen.beside]

    def _draw_model(self, seen: PaneContents) -> list[str]:
        """Names of what is drawn."""
        if seen.curve is None:
            return self._draw_predictions(seen)
        stretches = list(seen.curve.of_segments(seen.segment))
        if not stretches:
            return []
        name = f"model, fit {seen.fit}, \u00b1{STANDARD_ERRORS:g} s.e."
        drawn = [(s, f) for s in stretches for f in seen.way.factor(seen.levels(s.segment))]
        names = [name, *self._draw_bands(seen, drawn)]
        self.amplitude.line(
            name,
            joined([s.frequency_hz for s, _ in drawn]),
            joined([f * np.abs(s.over_base_s) for s, f in drawn]),
        )
        self.phase.line(
            name,
            joined([s.frequency_hz for s in stretches]),
            joined([s.phase_deg(seen.points) for s in stretches]),
        )
        return names

    def _draw_bands(self, seen: PaneContents, drawn: list[tuple[CurveStretch, float]]) -> list[str]:
        names = []
        for number, (s, factor) in enumerate(drawn):
            if not np.isfinite(s.amplitude_std_s).all():
                continue
            names.append(f"band {number + 1}")
            size, half = np.abs(s.over_base_s), STANDARD_ERRORS * s.amplitude_std_s
            low = np.maximum(size - half, 1e-3 * size)
            self.amplitude.band(names[-1], s.frequency_hz, factor * low, factor * (size + half))
            phase, half = s.phase_deg(seen.points), STANDARD_ERRORS * s.phase_std_deg
            self.phase.band(names[-1], s.frequency_hz, phase - half, phase + half)
        return names

    def _draw_predictions(self, seen: PaneContents) -> list[str]:
        """Until there is a curve: what the fit itself says, at the points it took."""
        p, predicted = seen.points, seen.predicted
        mine = seen.wanted[predicted.index] & ~p.sentinel[predicted.index]
        if not mine.any():
            return []
        k, size = predicted.index[mine], predicted.amplitude_m_s[mine] / p.level_m_s2[predicted.index[mine]]
        f, y, breaks = p.frequency_hz[k], size * seen.way.factor(p.level_m_s2[k]), p.segment[k]
        order = np.lexsort((f, breaks))
        f, y, breaks = f[order], y[order], breaks[order]
        gaps = np.flatnonzero(np.diff(breaks)) + 1
        name = f"model at the points, fit {seen.fit}"
        self.amplitude.line(name, joined(np.split(f, gaps)), joined(np.split(y, gaps)))
        return [name]

    def _point_out(self, seen: PaneContents) -> None:
        if seen.chosen is None:
            for plot in (self.amplitude, self.phase):
                plot.point_out(None, None)
            return
        f = float(seen.points.frequency_hz[seen.chosen])
        self.amplitude.point_out(f, float(np.abs(seen.shown[seen.chosen])))
        self.phase.point_out(f, float(seen.points.phase_deg[seen.chosen]))

    def _changed(self) -> None:
        self.way_changed.emit()

    def _arrange(self) -> None:
        row = QHBoxLayout()
        row.addWidget(self.quantity)
        row.addWidget(self.log_amplitude)
        row.addWidget(self.log_frequency)
        row.addWidget(self.model, 1)
        both = QSplitter(Qt.Orientation.Vertical)
        both.addWidget(self.amplitude)
        both.addWidget(self.phase)
        both.setStretchFactor(0, 3)
        both.setStretchFactor(1, 2)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(row)
        column.addWidget(both, 1)
