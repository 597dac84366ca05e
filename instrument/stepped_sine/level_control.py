"""The drive of one step corrected to the level wanted at its base, or given up where the base is lost."""

from collections.abc import Callable

from instrument.stepped_sine.guard import Guard
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import DriveRequested
from instrument.stream.event import Derived
from instrument.stream.raw import StepBegan

_TRIM = 0.5
"""Share of the control tolerance at which the drive is corrected: drift has room until the point is read."""
_LOST = 0.55
"""Below this share of the wanted level the drive is not corrected, as the sensor or the loop is suspected:
known gains are right within a tenth, and the drive would be nearly twice what was reckoned with. A choice."""
_LOST_BLOCKS = 3
"""So many in a row, until the loop counts as lost: a build-up rises meanwhile. A choice."""
_RISES = 1.1
"""From block to block, by which a base that is only building up rises. A choice."""


class LevelControl:
    """The level at the base of one step, and the corrections of its drive, as many as are allowed.

    Levels and the base's amplitude are in m/s^2, the drive in V.
    """

    def __init__(
        self, began: StepBegan, settings: SweepSettings, guard: Guard, remark: Callable[[str], None]
    ) -> None:
        """`guard` words what ends the run; `remark` takes what the step's point has to say."""
        self._began, self._settings, self._guard, self._remark = began, settings, guard, remark
        self._corrections = self._blocks_far_under = 0

    @property
    def level_m_s2(self) -> float:
        """The level wanted; 0 where there is none."""
        return self._began.level_m_s2 or 0.0

    @property
    def trim(self) -> float:
        """Relative error of the level from which on the drive is corrected."""
        return _TRIM * self._settings.control.tolerance

    @property
    def may_correct(self) -> bool:
        """Whether corrections are left."""
        return self._corrections < self._settings.control.most_corrections

    @property
    def far_under(self) -> bool:
        """Whether the base was so far under its level in the last block that it may be lost."""
        return self._blocks_far_under > 0

    def restart(self) -> None:
        """Forget the blocks before a new command."""
        self._blocks_far_under = 0

    def error(self, base_m_s2: float) -> float:
        """Relative error of the level."""
        return base_m_s2 / self.level_m_s2 - 1

    def correct(self, base_m_s2: float, error: float, drive_v: float) -> list[Derived]:
        """Ask for the drive that makes the base's amplitude the level, within the drive's limit."""
        self._corrections += 1
        wanted_v = drive_v * self.level_m_s2 / base_m_s2
        within_v = min(wanted_v, self._settings.limits.drive_v)
        if within_v < wanted_v:
            self._remark(f"drive held at its limit of {within_v:.3g} V")
            self._corrections = self._settings.control.most_corrections
        return [DriveRequested(self._began.step, within_v, f"base {100 * error:+.2g} % off its level")]

    def correct_in_dwell(self, base_m_s2: float, error: float, drive_v: float) -> list[Derived]:
        """Ask for a drive as `correct` does, but for no more than a base that is just not lost would need.

        However far: a base that fell in the dwell is judged by the blocks after it.
        """
        return self.correct(max(base_m_s2, _LOST * self.level_m_s2), error, drive_v)

    def lost(self, base_m_s2: float, before_m_s2: float | None, drive_v: float) -> list[Derived]:
        """The base far under what the known gain promises is no level to correct: no drive is raised for it.

        A sensor that came off, an amplifier that fell silent, a shaker that does not follow: with the drive
        at its limit, whatever comes back comes back at full force. `before_m_s2` is the base's amplitude in
        the block before.
        """
        least = _LOST * self.level_m_s2
        held = drive_v >= self._settings.limits.drive_v
        if base_m_s2 >= least or held:
            self._blocks_far_under = 0
            return []
        rises = before_m_s2 is not None and base_m_s2 > _RISES * before_m_s2
        self._blocks_far_under = 1 if rises else self._blocks_far_under + 1
        if self._blocks_far_under < _LOST_BLOCKS:
            return []
        remedy = (
            "is the accelerometer on, its cable whole, the amplifier on? the drive is not raised to find out"
        )
        return [self._guard.stop("base acceleration lost: it is", base_m_s2, least, "m/s^2", remedy)]
