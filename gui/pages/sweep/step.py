"""The step in progress: what drives it, its time signal, how it comes to rest."""

from dataclasses import replace

import numpy as np
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QSplitter, QVBoxLayout, QWidget

from fitting.digits import two_digits
from gui.pages.sweep.following import Following, latest_cycles, words
from gui.pages.sweep.panes import Key, align, hide_foot, keyed, span
from gui.plots import Axis, Plot
from gui.state import SessionState
from gui.state.step import Step
from gui.style.theme import Role
from gui.widgets.basic import hint
from gui.widgets.elided import ElidedLabel
from instrument.files.acceleration import acceleration_unit
from instrument.stepped_sine.settings import SweepSettings

_NONE = (
    "The step in progress appears here: its time signal and how it comes to rest. "
    "Start a run, or play a recorded session."
)
_TIME = Axis("Time before the latest sample", "ms", symbol="t")
_BROKEN_OFF = Axis("Time before the hold", "ms", symbol="t")
_KEY: tuple[tuple[str, Role, str], ...] = (
    ("left of the transient", "data", "\u2500"),
    ("noise alone", "faint", "- -"),
    ("limit", "bad", "- -"),
)
_LEAST_PERCENT = 1e-3
_FACTS = {
    "Drive": "Commanded to the shaker, and its limit",
    "Level": "How far the base's acceleration of the latest block is off, that, and the one asked for",
    "Transient": "Bound on what is left of it, relative to the response; the limit; what noise alone allows",
    "Range": "Of the vibrometer",
    "Light": "That comes back to the vibrometer, 0 to 1, and the least that counts as good",
    "Corrections": "Of drive and range in this step",
}
_ROWS = (("Drive", "Corrections"), ("Level",), ("Transient",), ("Light", "Range"))
"""What is long has a row of its own: the pane is narrow in a small window."""


class StepPane(QWidget):
    """Redrawn with every block."""

    def __init__(self) -> None:
        super().__init__()
        self.words = QLabel()
        self.words.setWordWrap(True)
        self.facts = {name: ElidedLabel("\u2013", tip) for name, tip in _FACTS.items()}
        self.base = Plot(_TIME, Axis("Base", acceleration_unit().symbol, symbol="a"), legend=False)
        self.velocity = Plot(_TIME, Axis("Velocity", "mm/s", symbol="v"), legend=False)
        self.settling = Plot(
            Axis("Time since the last change of drive", "s", symbol="t"),
            Axis("Transient", "%", log=True, symbol="left"),
            legend=False,
        )
        self.velocity.setXLink(self.base)
        self.base.setToolTip("Base acceleration, the latest cycles")
        self.velocity.setToolTip("Velocity as the laser reads it, the latest cycles")
        self.settling.setToolTip(
            "The largest transient the drift from block to block allows. Below the limit it has settled; "
            "below what noise alone allows it cannot be seen, and is waited for as long as it should take"
        )
        self.key = Key()
        hide_foot(self.base)
        self.none = hint(_NONE)
        self._following: Following | None = None
        self._state: SessionState | None = None
        self._later = QTimer(self)
        self._later.setSingleShot(True)
        self._later.timeout.connect(self._go_on)
        self._arrange()
        self.clear()

    def show_step(self, state: SessionState) -> None:
        """Draw the session's step."""
        if self._following is None or state is not self._state:
            self._following = Following(state.limits)
        self._state = state
        if state.step is None:
            self.clear()
            return
        self._whole.show()
        self.none.hide()
        self._draw_signal(state, state.step)
        self._go_on()

    def clear(self) -> None:
        """There is no step."""
        self._whole.hide()
        self.none.show()

    def _go_on(self) -> None:
        """Follow the step; where blocks are left over, once more when there is time."""
        state, following = self._state, self._following
        if state is None or following is None or state.step is None or not self.isVisible():
            return
        if following.take(state.step):
            self._later.start()
        self._draw_settling(state.step, following, state.limits)
        self._say(state, state.step, following)

    def _draw_signal(self, state: SessionState, step: Step) -> None:
        trace = latest_cycles(step)
        milliseconds = 1e3 * trace.time_s
        shown, past = acceleration_unit(), step.broken_off
        time = _BROKEN_OFF if past else _TIME
        self.base.show_axes(replace(time, titled=False), Axis("Base", shown.symbol, symbol="a"))
        self.velocity.show_axes(time, self.velocity.y)
        # What was so is not what is: the shaker is silent.
        base, velocity = shown.of(trace.base_m_s2), 1e3 * trace.velocity_m_s
        self.base.trace("base acceleration", milliseconds, base, "faint" if past else "second")
        self.velocity.trace("velocity", milliseconds, velocity, "faint" if past else "data")
        limits = state.limits.limits
        for plot, most in (
            (self.base, shown.of(limits.base_m_s2)),
            (self.velocity, 1e3 * limits.velocity_m_s),
        ):
            plot.mark((most, -most), "bad", name="abort", labels=("abort",), level=True)
            alarm = limits.warn * most
            plot.mark((alarm, -alarm), "fair", name="alarm", labels=("alarm",), level=True)
        span(self.base, milliseconds)
        align(self.base, self.velocity, self.settling)

    def _draw_settling(self, step: Step, following: Following, settings: SweepSettings) -> None:
        seconds, percent, noise = following.remaining()
        limit = 100 * settings.settle.tolerance
        # A steady response moves by nothing but noise; the axis has no zero.
        role: Role = "faint" if step.broken_off else "data"
        self.settling.line("left", seconds, np.maximum(percent, 1e-3 * limit), role)
        self.settling.line("noise", seconds, np.maximum(noise, 1e-3 * limit), "faint", dashed=True)
        end = float(seconds[-1]) if seconds.size else settings.block_s(step.began.frequency_hz)
        self.settling.line("limit", np.array([0, end]), np.full(2, limit), "bad", dashed=True)
        self.key.show_key(_KEY)
        at = [step.rest.seconds] if step.rest is not None else []
        self.settling.mark(at, "good", name="settled", labels=["dwell"] * len(at))

    def _say(self, state: SessionState, step: Step, following: Following) -> None:
        limits, began = state.limits, step.began
        self.words.setText(words(step, limits))
        said = {"Drive": f"{step.drive_v:.4g} V of {limits.limits.drive_v:g} V"}
        base = abs(step.point.base_m_s2) if step.point is not None else following.base_m_s2
        if base is not None and began.level_m_s2 is not None:
            off = 100 * (base / began.level_m_s2 - 1)
            shown = acceleration_unit()
            # Where there is no room for all of it the error stays.
            said["Level"] = f"{off:+z.2f} %, {shown.of(base):.4g} of {shown.said(began.level_m_s2)}"
        if step.broken_off and began.level_m_s2 is not None:
            said["Level"] = f"none while held, of {acceleration_unit().said(began.level_m_s2)}"
        _, percent, noise = following.remaining()
        if percent.size and not step.broken_off:
            limit = f"{100 * limits.settle.tolerance:g}, noise {_little(noise[-1])}"
            said["Transient"] = f"{_little(percent[-1])} % of {limit}"
        if state.range is not None:
            said["Range"] = state.range.name
        if state.signal_level is not None:
            said["Light"] = f"{state.signal_level:.2f} (least {limits.least_signal_level:g})"
        said["Corrections"] = str(len(step.asked))
        for name, label in self.facts.items():
            label.say(said.get(name, "\u2013"))

    def _arrange(self) -> None:
        grid = QGridLayout()
        for row, (first, *second) in enumerate(_ROWS):
            grid.addWidget(_heading(first), row, 0)
            grid.addWidget(self.facts[first], row, 1, 1, 1 if second else 2)
            if second:
                pair = QHBoxLayout()
                pair.addWidget(_heading(second[0]))
                pair.addWidget(self.facts[second[0]], 1)
                grid.addLayout(pair, row, 2)
        for column in (1, 2):
            grid.setColumnStretch(column, 1)
        stack = QSplitter(Qt.Orientation.Vertical)
        for plot in (self.base, self.velocity):
            stack.addWidget(plot)
        stack.addWidget(keyed(self.key, self.settling))
        for number, stretch in enumerate((4, 5, 6)):
            stack.setStretchFactor(number, stretch)
        self._whole = QWidget()
        inside = QVBoxLayout(self._whole)
        inside.setContentsMargins(0, 0, 0, 0)
        inside.addWidget(self.words)
        inside.addLayout(grid)
        inside.addWidget(stack, 1)
        column_of_all = QVBoxLayout(self)
        column_of_all.setContentsMargins(0, 4, 0, 0)
        column_of_all.addWidget(self.none)
        column_of_all.addWidget(self._whole, 1)


def _heading(name: str) -> QLabel:
    made = QLabel(name)
    made.setEnabled(False)
    made.setToolTip(_FACTS[name])
    return made


def _little(percent: float) -> str:
    """What is far below any limit needs no digits."""
    return two_digits(percent) if percent >= _LEAST_PERCENT else f"<{_LEAST_PERCENT:g}"
