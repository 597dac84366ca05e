"""Whether the plate stays the same: the sentinel against its first time, the temperature."""

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QSplitter, QVBoxLayout, QWidget

from gui.pages.sweep.drifted import drifted
from gui.pages.sweep.panes import CHOSEN, Pointed, align, hide_foot
from gui.pages.sweep.points import Group
from gui.pages.sweep.seen import PaneContents
from gui.plots import Axis
from gui.widgets.basic import hint
from instrument.stream.derived import SentinelCompared

_TIME = Axis("Time since the session began", "min")
_NONE = (
    "The sentinel's drift appears here: one frequency, measured before the first segment and after each. "
    "It shows whether the plate changes while it is measured."
)


class DriftPane(QWidget):
    """Over the time of the session."""

    chosen = Signal(int)

    def __init__(self) -> None:
        super().__init__()
        self.amplitude = Pointed(_TIME, Axis("Change of |v/a|", "%"), legend=False)
        self.phase = Pointed(_TIME, Axis("Change of phase", "\u00b0"), legend=False)
        self.temperature = Pointed(_TIME, Axis("Temperature", "\u00b0C"), legend=False)
        self.none, self.said = hint(_NONE), QLabel()
        self._plots = (self.amplitude, self.phase, self.temperature)
        stack = QSplitter(Qt.Orientation.Vertical)
        for plot in self._plots:
            plot.chosen.connect(self.chosen)
            plot.hide()
            stack.addWidget(plot)
        self.phase.setXLink(self.amplitude)
        self.temperature.setXLink(self.amplitude)
        self.amplitude.setToolTip("The sentinel's velocity over base acceleration, against its first time")
        self.phase.setToolTip("The sentinel's phase, against its first time")
        self.said.setWordWrap(True)
        hide_foot(self.amplitude)
        self.temperature.setToolTip("Of the plate, at every point of the sweep")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.none)
        column.addWidget(self.said)
        column.addWidget(stack, 1)

    def show_seen(self, seen: PaneContents, sentinels: Sequence[SentinelCompared]) -> None:
        """Draw."""
        p = seen.points
        drift = drifted(seen.points, sentinels)
        for widget in (self.said, self.amplitude, self.phase):
            widget.setVisible(drift is not None)
        self.none.setVisible(drift is None)
        if drift is not None:
            group = Group("sentinel", "data", "o", drift.index)
            self.said.setText(drift.words)
            self.amplitude.show_points(group, drift.time_s / 60, drift.percent)
            self.phase.show_points(group, drift.time_s / 60, drift.degree)
        self._draw_temperature(seen)
        at = [p.time_s[seen.chosen] / 60] if seen.chosen is not None else []
        for plot in self._plots:
            plot.mark(at, "text", name=CHOSEN)
        align(*self._plots)

    def _draw_temperature(self, seen: PaneContents) -> None:
        p = seen.points
        index = np.flatnonzero(np.isfinite(p.column("temperature_c")))
        self.temperature.setVisible(bool(index.size))
        if index.size:
            group = Group("plate", "data", "o", index)
            self.temperature.show_points(group, p.time_s[index] / 60, p.column("temperature_c")[index])
