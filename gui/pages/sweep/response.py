"""Amplitude above phase over frequency, the fitted model and its band through the points."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QSplitter,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from gui.pages.sweep.drawing import FREQUENCY, draw_amplitude, draw_phase
from gui.pages.sweep.panes import Pointed, align
from gui.pages.sweep.resonances import ResonancePanes
from gui.pages.sweep.seen import PaneContents, Quantity, Way
from gui.plots import Axis
from gui.widgets.basic import tool

_LEAST_PX = 80
_SHOWN: dict[str, Quantity] = {
    "velocity over base": "ratio",
    "velocity at its level": "velocity",
}


class ResponsePane(QWidget):
    """The response of one segment, or of all."""

    chosen = Signal(int)
    segment_wanted = Signal(int)
    way_changed = Signal()
    others_unwanted = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.quantity = QComboBox()
        self.quantity.addItems(list(_SHOWN))
        # In a narrow window its words are cut before anything is pushed out of sight.
        self.quantity.setMinimumWidth(_LEAST_PX)
        self.quantity.setToolTip(
            "Velocity over the measured base acceleration; or that times the level commanded, which is what "
            "the fit takes and what its predictions are compared with"
        )
        self.log_amplitude = QCheckBox("log |v|")
        self.log_frequency = QCheckBox("log f")
        self.apart = QCheckBox("one pane each")
        self.apart.setChecked(True)
        self.apart.setToolTip("All segments: a pane for each resonance, or one over the whole band")
        self.others = QCheckBox("others")
        self.others.setChecked(True)
        self.others.setToolTip("Sweeps of other files and earlier sessions, laid beside this one")
        self.others.hide()
        self.resonances = ResonancePanes()
        self.resonances.chosen.connect(self.chosen)
        self.resonances.segment_wanted.connect(self.segment_wanted)
        self.model = QLabel()
        self.model.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.model.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.model.setWordWrap(True)
        self.amplitude = Pointed(FREQUENCY, Axis("|v/a|"))
        self.phase = Pointed(FREQUENCY, Axis("Phase of v/a", "\u00b0", symbol="\u03c6"), legend=False)
        self.phase.setXLink(self.amplitude)
        self.quantity.currentTextChanged.connect(self._changed)
        self.take_away = tool("close", "Take the data of other files away")
        self.take_away.clicked.connect(self.others_unwanted)
        for box in (self.log_amplitude, self.log_frequency, self.apart, self.others):
            box.toggled.connect(self._changed)
        for plot in (self.amplitude, self.phase):
            plot.chosen.connect(self.chosen)
        self._arrange()

    @property
    def way(self) -> Way:
        """How a person has chosen to see the response."""
        return Way(
            _SHOWN[self.quantity.currentText()],
            self.log_amplitude.isChecked(),
            self.log_frequency.isChecked(),
        )

    def show_seen(self, seen: PaneContents) -> None:
        """Draw."""
        for one in (self.others, self.take_away):
            one.setVisible(bool(seen.beside))
        if not self.others.isChecked():
            seen = seen.but(beside=())
        if seen.segment is None and len(seen.regions) > 1 and self.apart.isChecked():
            self._layers.setCurrentWidget(self.resonances)
            self.resonances.show_seen(seen)
            return
        self._layers.setCurrentWidget(self._both)
        self.amplitude.setToolTip(
            f"{seen.reads.capitalize()} velocity v at the pickup, a the base's acceleration, zero to peak"
        )
        draw_amplitude(self.amplitude, seen)
        draw_phase(self.phase, seen)
        align(self.amplitude, self.phase)

    def _changed(self) -> None:
        self.way_changed.emit()

    def _arrange(self) -> None:
        row = QHBoxLayout()
        row.addWidget(self.quantity)
        row.addWidget(self.log_amplitude)
        row.addWidget(self.log_frequency)
        row.addWidget(self.apart)
        row.addStretch(1)
        # Not in the row above, which has no room for them in a narrow window.
        below = QHBoxLayout()
        below.addWidget(self.others)
        below.addWidget(self.take_away)
        below.addWidget(self.model, 1)
        self._both = QSplitter(Qt.Orientation.Vertical)
        self._both.addWidget(self.amplitude)
        self._both.addWidget(self.phase)
        self._both.setStretchFactor(0, 3)
        self._both.setStretchFactor(1, 2)
        self._layers = QStackedWidget()
        self._layers.addWidget(self._both)
        self._layers.addWidget(self.resonances)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(row)
        column.addLayout(below)
        column.addWidget(self._layers, 1)
