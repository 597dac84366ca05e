"""How well each point was measured, over frequency."""

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QSplitter, QVBoxLayout, QWidget

from fitting.arrays import Array
from gui.pages.sweep.panes import CHOSEN, Key, Pointed, align, channel, hide_foot, keyed
from gui.pages.sweep.points import Channel
from gui.pages.sweep.seen import PaneContents
from gui.plots import Axis
from gui.style.theme import Role
from instrument.stepped_sine.settings import SweepSettings

_FREQUENCY = Axis("Frequency", "Hz")
_TOLERANCE = "tolerance"
_CHANNELS: tuple[tuple[Channel, str, Role, bool], ...] = (
    ("velocity", "velocity", "data", False),
    ("base", "base acceleration", "second", True),
)
_NOISE = (
    "Standard deviation of each part of the phasor over its amplitude, from the lines beside the frequency"
)
_DISTORTION = "Root sum of squares of the harmonics over the fundamental"
_LEVEL = (
    "Base acceleration measured over the one asked for, less one; between the lines it is within tolerance"
)
_SETTLING = "From the last change of drive until the response had come to rest"


_LEAST_LINES = 4.5
"""Of each plot: four stand one above the other."""


class QualityPane(QWidget):
    """Noise, distortion, level, settling."""

    chosen = Signal(int)

    def __init__(self) -> None:
        super().__init__()
        self.noise = Pointed(_FREQUENCY, Axis("Noise", "%", log=True), legend=False)
        self.distortion = Pointed(_FREQUENCY, Axis("Distortion", "%"), legend=False)
        self.level = Pointed(_FREQUENCY, Axis("Level error", "%"), legend=False)
        self.settling = Pointed(_FREQUENCY, Axis("Settling", "s"), legend=False)
        for plot in (self.noise, self.distortion, self.level, self.settling):
            plot.need_lines(_LEAST_LINES)
        self.channels, self.qualities = Key(), Key()
        tips = (_NOISE, _DISTORTION, _LEVEL, _SETTLING)
        self._plots = (self.noise, self.distortion, self.level, self.settling)
        column, stack = QVBoxLayout(self), QSplitter(Qt.Orientation.Vertical)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(stack)
        stack.addWidget(keyed(self.channels, self.noise))
        stack.addWidget(self.distortion)
        stack.addWidget(keyed(self.qualities, self.level))
        stack.addWidget(self.settling)
        for plot, tip in zip(self._plots, tips, strict=True):
            plot.setToolTip(tip)
            plot.chosen.connect(self.chosen)
            if plot is not self.noise:
                plot.setXLink(self.noise)
            if plot is not self.settling:
                hide_foot(plot)

    def show_seen(self, seen: PaneContents, settings: SweepSettings) -> None:
        """Draw."""
        p = seen.points
        self._show_key(seen)
        self._channels(self.noise, seen, p.noise_percent)
        self._channels(self.distortion, seen, lambda name: p.column(f"{name}_distortion_percent"))
        self._tolerance(seen, 100 * settings.control.tolerance)
        self._groups(self.level, seen, p.column("control_error_percent"))
        self._groups(self.settling, seen, p.column("settle_s"))
        at = [p.frequency_hz[seen.chosen]] if seen.chosen is not None else []
        for plot in self._plots:
            plot.mark(at, "text", name=CHOSEN)
            plot.frame(seen.band_hz)
        align(*self._plots)

    def _show_key(self, seen: PaneContents) -> None:
        none = np.zeros(0, dtype=np.intp)
        channels = [channel(said, role, second, none) for _, said, role, second in _CHANNELS]
        self.channels.show_groups(channels)
        self.qualities.show_groups(seen.points.groups(seen.wanted))

    def _channels(self, plot: Pointed, seen: PaneContents, values: Callable[[Channel], Array]) -> None:
        index = np.flatnonzero(seen.wanted)
        for name, said, role, second in _CHANNELS:
            group = channel(said, role, second, index)
            plot.show_points(group, seen.points.frequency_hz[index], values(name)[index])

    def _groups(self, plot: Pointed, seen: PaneContents, values: Array) -> None:
        groups = seen.points.groups(seen.wanted)
        plot.keep((*(g.name for g in groups), *(n for n in plot.names if n.startswith(_TOLERANCE))))
        for group in groups:
            plot.show_points(group, seen.points.frequency_hz[group.index], values[group.index])

    def _tolerance(self, seen: PaneContents, percent: float) -> None:
        f = _ends(seen)
        both = np.concatenate([f, [np.nan], f])
        limits = np.concatenate([np.full(len(f), percent), [np.nan], np.full(len(f), -percent)])
        name = f"{_TOLERANCE} \u00b1{percent:g} %"
        self.level.line(name, both, limits, "bad", dashed=True)


def _ends(seen: PaneContents) -> Array:
    """Of the line that a tolerance is drawn as."""
    if seen.band_hz is not None:
        return np.array(seen.band_hz)
    f = seen.points.frequency_hz[seen.wanted]
    return np.array([f.min(), f.max()]) if f.size else np.zeros(0)
