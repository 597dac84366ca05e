"""How near a run is to its limits, and the colour of its state: the same in the bar above and on the page."""

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QWidget

from gui.actions.controller import AppController
from gui.bars.gauge import Gauge
from gui.state import SessionState
from gui.state.run import Run
from gui.style.theme import Role, current_theme
from instrument.files.acceleration import acceleration_unit
from instrument.stepped_sine.settings import Limits

_COLORS: dict[str, Role] = {"held": "fair", "stopped": "bad", "done": "good", "idle": "faint"}
_LOOKS_MS = 100
"""A value grows older also where nothing comes."""


_VERDICTS: dict[str, Role] = {"unknown": "bad", "ambiguous": "fair"}
"""Of a run that is done: what it found is not as good as done sounds."""


def state_color(state: str, verdict: str = "") -> str:
    """As style sheets write it; `verdict` of the diagnosis of a run that is done."""
    role = _VERDICTS.get(verdict) if state == "done" else None
    return current_theme().color(role or _COLORS.get(state, "data")).name()


def run_color(run: Run) -> str:
    """Of how a run stands, as style sheets write it."""
    return state_color(run.state, run.found.verdict if run.found is not None else "")


class RunGauges(QObject):
    """One for each limit. They show what is so now, or how old it is, whether anything comes or not."""

    def __init__(self, controller: AppController, parent: QWidget, *, large: bool = False) -> None:
        super().__init__(parent)
        self._controller = controller
        self.by_name = {name: Gauge(name, large=large) for name in ("drive", "base", "velocity", "travel")}
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.refresh)
        self._timer.start(_LOOKS_MS)

    @property
    def drive(self) -> Gauge:
        """The gauge of the shaker's drive."""
        return self.by_name["drive"]

    def refresh(self) -> None:
        """Look again."""
        state, feed = self._controller.state, self._controller.feed
        if state is None or feed is None or state.run.over:
            for gauge in self.by_name.values():
                gauge.show_value(None)
            return
        drive_age_s, samples_age_s = feed.ages_s
        readings, limits = state.readings, state.limits.limits
        self.drive.show_value(readings.drive_v, limits.drive_v, "V", drive_age_s)
        self._show_motion(state, limits, samples_age_s)

    def _show_motion(self, state: SessionState, limits: Limits, age_s: float) -> None:
        peaks = state.peaks()
        base, velocity = peaks if peaks is not None else (None, None)
        travel = state.readings.travel_m(base) if base is not None else None
        shown = acceleration_unit()
        for name, value, limit, factor, unit in (
            ("base", base, limits.base_m_s2, shown.of(1.0), shown.symbol),
            ("velocity", velocity, limits.velocity_m_s, 1e3, "mm/s"),
            ("travel", travel, limits.travel_m, 1e3, "mm"),
        ):
            gauge = self.by_name[name]
            gauge.show_value(None if value is None else factor * value, factor * limit, unit, age_s)
