"""What is known when a step begins."""

from collections.abc import Callable
from dataclasses import dataclass

from instrument.stepped_sine.calibration import Calibration
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.raw import RangeSet
from instrument.stream.scaling import Scaling


@dataclass(frozen=True)
class StepContext:
    """What is known when a step begins: how the rig is set, and what was read of it last."""

    settings: SweepSettings
    scaling: Scaling
    sample_rate_hz: float
    vibrometer: RangeSet
    latest: int
    """The first sample that is yet to come."""
    wider: tuple[str, ...] = ()
    """Ranges coarser than the vibrometer's, the next first."""
    calibration: Callable[[str], Calibration | None] | None = None
    """Of a range by its name; None where readings are not to be calibrated."""
    signal_level: float | None = None
    temperature_c: float | None = None
    """Before the step, for points during whose dwell no input of the front-end reads it."""
    settled_at: frozenset[int] | None = None
    """Samples at which a recorded run began to read; None where that is for the analysis to say."""
    range_is_new: bool = False
    """Whether what went before was read in another range, and may ring on beyond this one."""
