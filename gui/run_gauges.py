"""How near a run is to its limits, and the colour of its state: the same in the bar above and on the page."""

from math import pi

from gui.gauge import Gauge
from gui.state import SessionState
from gui.theme import Role, current_theme

_COLORS: dict[str, Role] = {"held": "fair", "stopped": "bad", "done": "good", "idle": "faint"}


def state_color(state: str) -> str:
    """As style sheets write it."""
    return current_theme().color(_COLORS.get(state, "data")).name()


def run_gauges(*, large: bool = False) -> dict[str, Gauge]:
    """One for each limit."""
    return {name: Gauge(name, large=large) for name in ("drive", "base", "velocity", "travel")}


def show_on_gauges(gauges: dict[str, Gauge], state: SessionState | None) -> bool:
    """The step in progress; whether there is one."""
    step = state.step if state is not None else None
    if state is None or step is None or state.run.over:
        for gauge in gauges.values():
            gauge.show_value(None)
        return False
    limits = state.limits.limits
    base, velocity = step.peaks()
    travel = base / (2 * pi * step.began.frequency_hz) ** 2
    gauges["drive"].show_value(step.drive_v, limits.drive_v, "V")
    gauges["base"].show_value(base, limits.base_m_s2, "m/s\u00b2")
    gauges["velocity"].show_value(1e3 * velocity, 1e3 * limits.velocity_m_s, "mm/s")
    gauges["travel"].show_value(1e3 * travel, 1e3 * limits.travel_m, "mm")
    return True
