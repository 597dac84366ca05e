"""The samples that the point looked at was read from."""

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QHideEvent
from PySide6.QtWidgets import QSplitter, QVBoxLayout, QWidget

from gui.pages.sweep.dwells import Dwells
from gui.pages.sweep.panes import align, span
from gui.pages.sweep.seen import PaneContents
from gui.plots import Axis, Plot
from gui.widgets.basic import hint
from instrument.files.acceleration import AccelerationUnit, acceleration_unit
from instrument.session.dwell import DwellSamples

_TIME = Axis("Time in the dwell", "s")
_NONE = "The samples of a point's dwell appear here: click a point in any plot."
_LATER = "The samples of this point can be seen when the run has ended and its session is on the disk."


class SamplesPane(QWidget):
    """Base and velocity during one dwell, from the session file."""

    def __init__(self) -> None:
        super().__init__()
        self.said = hint(_NONE)
        self.base = Plot(_TIME, Axis("Base", acceleration_unit().symbol, symbol="a"), legend=False)
        self.velocity = Plot(_TIME, Axis("Velocity", "mm/s", symbol="v"), legend=False)
        self.velocity.setXLink(self.base)
        self.dwells = Dwells(self)
        self.dwells.read.connect(self._read)
        self.dwells.failed.connect(self._failed)
        self._shown: tuple[int, Path | None, AccelerationUnit] | None = None
        self._stack = QSplitter(Qt.Orientation.Vertical)
        self._stack.addWidget(self.base)
        self._stack.addWidget(self.velocity)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 4, 0, 0)
        column.addWidget(self.said)
        column.addWidget(self._stack, 1)
        column.addStretch(0)
        self._stack.hide()

    def hideEvent(self, event: QHideEvent) -> None:
        """Nothing is read for a pane that nobody sees."""
        super().hideEvent(event)
        if self.dwells.busy:
            self.dwells.rest()
            self._shown = None

    def show_seen(self, seen: PaneContents, session: Path | None) -> None:
        """Draw. `session` is the file the samples are in, None where there is none yet."""
        if seen.chosen is None:
            self._shown = None
            self._refuse(_NONE)
            return
        point = seen.points.timed[seen.chosen].point
        wanted = point.step, session, acceleration_unit()
        if self._shown == wanted:
            return
        self._shown = wanted
        if session is None:
            self._refuse(_LATER)
            return
        self.said.setText("reading ...")
        self.dwells.want(session, point.step)

    def _read(self, step: int, samples: object) -> None:
        assert isinstance(samples, DwellSamples)
        if self._shown is None or step != self._shown[0]:
            return
        self._stack.show()
        self.said.setText(f"Step {step}: the dwell as the sensors gave it, calibration not taken off")
        shown = acceleration_unit()
        self.base.show_axes(self.base.x, Axis("Base", shown.symbol, symbol="a"))
        self.base.trace("base acceleration", samples.time_s, shown.of(samples.base_m_s2), "second")
        self.velocity.trace("velocity", samples.time_s, 1e3 * samples.velocity_m_s, "data")
        span(self.base, samples.time_s)
        align(self.base, self.velocity)

    def _failed(self, why: str) -> None:
        self._refuse(why)

    def _refuse(self, why: str) -> None:
        self.dwells.want(None, 0)
        self.said.setText(why)
        self._stack.hide()
