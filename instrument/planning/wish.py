"""What a person asks of a plan, and what is assumed where nothing is said."""

import math
from dataclasses import dataclass, field

from fitting.planning.sensitivity import ReadingNoise
from instrument.stepped_sine.settings import Settle, SweepSettings

TARGET = 0.02
"""Relative standard error of G' and of eta over the band: what a design can use. A choice."""
CAUSES_SHARE = 0.25
"""Of rig time, for steps that separate causes and teach little about the law."""
NOISE = ReadingNoise(floor_m_s=5e-6, share=2e-3)
"""A vibrometer's and an accelerometer's floor over one second, and what repeats of a good rig scatter."""
LEVELS_G = (0.1, 0.2, 0.5, 1.0, 2.0)
"""Among which a plan chooses; what the rig allows limits them."""


def patient() -> SweepSettings:
    """As a sweep is measured where nobody says anything, but with all the time that steps need to settle."""
    return SweepSettings(settle=Settle(most_s=math.inf))


@dataclass(frozen=True)
class Wish:
    """What somebody wants of a plan."""

    target: float = TARGET
    """Relative standard error of G' and of eta, anywhere in the band."""
    band_hz: tuple[float, float] | None = None
    """None for the first three resonances."""
    noise: ReadingNoise = NOISE
    level_g: float | None = None
    """None to have it proposed."""
    causes_share: float = CAUSES_SHARE
    settings: SweepSettings = field(default_factory=patient)
