"""Whether the reference channel shows the base acceleration that was commanded."""

from dataclasses import dataclass

import numpy as np

from fitting.numerics.robust import robust_scatter
from fitting.sweep import Sweep

LEAST_PERCENT = 1.0
"""What an accelerometer's calibration leaves open: an error below it is not spoken of."""
_STANDARD_ERRORS = 3.0
"""Beyond, one sweep in 370 shows as much by chance."""
_FEWEST = 3
"""Points that show a scatter."""
_MEDIAN_TO_MEAN = np.sqrt(np.pi / 2)
"""Standard error of a median over that of a mean, for a normal distribution."""


@dataclass(frozen=True)
class LevelOff:
    """The reference channel is off the command.

    Either the base moved so, which the ratio of the channels takes out, or the channel's sensitivity is
    wrong, which it does not; these readings alone do not say which.
    """

    factor: float
    """Median of |reference| / command."""
    standard_error: float

    @property
    def percent(self) -> float:
        """Off the command."""
        return 100 * (self.factor - 1)


def level_error(sweep: Sweep) -> LevelOff | None:
    """None without a reference channel, or where it is within 1 % or its own scatter of the command.

    Points whose level the drive's limit did not let reach tell nothing of the channel.
    """
    if sweep.drive_limited is not None:
        sweep = sweep.take(~sweep.drive_limited)
    if sweep.base_m_s2 is None or len(sweep) < _FEWEST:
        return None
    ratio = np.abs(sweep.base_m_s2) / sweep.commanded_m_s2
    factor = float(np.median(ratio))
    scatter = robust_scatter(ratio)
    found = LevelOff(
        factor=factor,
        standard_error=float(_MEDIAN_TO_MEAN * scatter / np.sqrt(len(ratio))),
    )
    significant = abs(factor - 1) > _STANDARD_ERRORS * found.standard_error
    return found if significant and abs(found.percent) > LEAST_PERCENT else None
