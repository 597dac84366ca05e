"""How good a measured point is, against the tolerances it was measured with."""

from collections.abc import Sequence
from typing import Literal

from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import PointMeasured

Quality = Literal["good", "with remarks", "out of limits"]
QUALITIES: tuple[Quality, ...] = ("good", "with remarks", "out of limits")


def how_long(points: Sequence[PointMeasured]) -> str:
    """Steps and other points of a sweep, and what settling and reading all of them took."""
    points = [p for p in points if p.purpose != "calibration"]
    steps = sum(p.purpose == "step" for p in points)
    said = [_counted(steps, "step")]
    if len(points) > steps:
        said.append(_counted(len(points) - steps, "sentinel"))
    seconds = sum(p.settle_s + p.dwell_s for p in points)
    return f"{' and '.join(said)}, {seconds:.0f} s of settling and reading"


def _counted(count: int, what: str) -> str:
    return f"{count} {what}{'s' * (count != 1)}"


def quality_of(point: PointMeasured, settings: SweepSettings) -> Quality:
    """Out of limits: off its level or not settled, by the sweep's own tolerances; else by its remarks."""
    off_level = abs(point.control_error_percent) > 100 * settings.control.tolerance
    if off_level or any(remark.startswith("not settled") for remark in point.remarks):
        return "out of limits"
    return "with remarks" if point.remarks else "good"
