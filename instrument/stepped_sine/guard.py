"""The limits of a step: base, response, travel, in every block that is read; the base in ramps too."""

import numpy as np
from numpy.typing import NDArray

from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import LimitExceeded, LimitWarned
from instrument.stream.event import Derived
from instrument.stream.raw import StepBegan

_BASE, _LOWER = "base acceleration", "lower the level"


class Guard:
    """Warns once a step and quantity, stops where a limit is exceeded."""

    def __init__(self, began: StepBegan, settings: SweepSettings) -> None:
        self._began, self._settings = began, settings
        self._warned: set[str] = set()

    def look(self, x: NDArray[np.float64], drive_v: float) -> list[Derived]:
        """Peaks of base acceleration and velocity and the drive against their limits.

        SI, shape (2, samples).
        """
        limits = self._settings.limits
        base, velocity = np.ptp(x, axis=1) / 2
        travel = base / (2 * np.pi * self._began.frequency_hz) ** 2
        watched = [
            (_BASE, base, limits.base_m_s2, "m/s^2", _LOWER),
            ("velocity", velocity, limits.velocity_m_s, "m/s", _LOWER),
            (
                "travel of the base",
                1e3 * travel,
                1e3 * limits.travel_m,
                "mm",
                "lower the level or leave out low f",
            ),
        ]
        events: list[Derived] = []
        for what, value, limit, unit, remedy in watched:
            if value > limit:
                return [self.stop(what, float(value), limit, unit, remedy)]
            events += self._near(what, float(value), limit, unit)
        return events + self._near("drive", drive_v, limits.drive_v, "V")

    def ramp(self, base_m_s2: NDArray[np.float64]) -> list[Derived]:
        """The base's peak on the way to a new drive against its limit; a level it has none yet.

        Shape (samples,).
        """
        peak, limit = float(np.ptp(base_m_s2)) / 2 if len(base_m_s2) else 0.0, self._settings.limits.base_m_s2
        return [self.stop(f"{_BASE} on the way", peak, limit, "m/s^2", _LOWER)] if peak > limit else []

    def stop(self, what: str, value: float, limit: float, unit: str, remedy: str) -> LimitExceeded:
        """The event that ends the run."""
        return LimitExceeded(self._began.step, what, value, limit, unit, remedy, self._began.frequency_hz)

    def level(self, base_m_s2: float) -> list[Derived]:
        """The fitted base acceleration against the abort band around its level."""
        if self._began.level_m_s2 is None:
            return []
        highest = self._began.level_m_s2 * (1 + self._settings.control.abort)
        if base_m_s2 <= highest:
            return []
        remedy = "the drive does not follow its model; check the loop, or widen control.abort_percent"
        return [self.stop("base acceleration over its level", base_m_s2, highest, "m/s^2", remedy)]

    def under_level(self, base_m_s2: float, level_m_s2: float) -> LimitExceeded:
        """A level that is not reached, whatever the drive may do."""
        key = "[sweep.calibration] level_g" if self._began.purpose == "calibration" else "[sweep] level_g"
        return self.stop(
            f"{_BASE} under the {level_m_s2:.4g} m/s^2 of {key}, short by",
            level_m_s2 - base_m_s2,
            self._settings.control.abort * level_m_s2,
            "m/s^2",
            "is the accelerometer on the base, its sensitivity_mv_per_unit right? where that is too high, "
            "the base moves more than it says; only if both are, lower that level_g, or raise limits.drive_v "
            "as far as the shaker allows",
        )

    def _near(self, what: str, value: float, limit: float, unit: str) -> list[Derived]:
        if value <= self._settings.limits.warn * limit or what in self._warned:
            return []
        self._warned.add(what)
        return [LimitWarned(self._began.step, what, value, limit, unit, self._began.frequency_hz)]
