"""How good a measured point is, against the tolerances it was measured with."""

from typing import Literal

from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import PointMeasured

Quality = Literal["good", "with remarks", "out of limits"]
QUALITIES: tuple[Quality, ...] = ("good", "with remarks", "out of limits")


def quality_of(point: PointMeasured, settings: SweepSettings) -> Quality:
    """Out of limits: off its level or not settled, by the sweep's own tolerances; else by its remarks."""
    off_level = abs(point.control_error_percent) > 100 * settings.control.tolerance
    if off_level or any(remark.startswith("not settled") for remark in point.remarks):
        return "out of limits"
    return "with remarks" if point.remarks else "good"
