"""What is to be said of a file whose stated levels are far from the base that it measured."""

from pathlib import Path

import numpy as np

from fitting.gravity import PUBLISHED_G_M_S2, STANDARD_GRAVITY_M_S2
from fitting.sweep import Sweep

_FAR = 3.0
"""Times, either way: no level control is so far off, and rms for peak to peak is 2.8."""
_SAME = 0.1
"""Of ln of a factor, that control and calibration leave between a level and its unit."""
_LEVELS = {STANDARD_GRAVITY_M_S2: "m/s^2", 1e3: "mg", 100.0: "percent of a level"}
"""Times the level in g that its number is in another unit."""
_BASES = {1 / STANDARD_GRAVITY_M_S2: "g", 1e3: "mm/s^2", 100.0: "cm/s^2"}
"""The same of `[base] acceleration_m_s2`."""


def level_remark(path: Path, sweep: Sweep, reference_m_s2: float, *, has_levels: bool) -> str:
    """One line for people; empty where the base was read about as stated, or nobody stated a level.

    `reference_m_s2`: of `[base]`; `has_levels`: whether the file has `level_g`.
    """
    if sweep.base_m_s2 is None or not (has_levels or reference_m_s2 != PUBLISHED_G_M_S2):
        return ""
    times = float(np.median(sweep.commanded_m_s2 / np.abs(sweep.base_m_s2)))
    if 1 / _FAR <= times <= _FAR:
        return ""
    asked = [f"is level_g in {unit}?" for at, unit in _LEVELS.items() if has_levels and _is(times, at)]
    asked += [f"is [base] acceleration_m_s2 in {unit}?" for at, unit in _BASES.items() if _is(times, at)]
    what = "level_g times [base] acceleration_m_s2" if has_levels else "[base] acceleration_m_s2"
    why = asked[0] if asked else "is one of them in another unit?"
    return f"{path}: {what} is {times:.2g} times base_accel (median): {why} The response is over base_accel"


def _is(times: float, value: float) -> bool:
    return abs(np.log(times / value)) < _SAME
