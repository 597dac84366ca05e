"""What a run is made of, before it begins."""

from dataclasses import dataclass
from typing import Literal

Kind = Literal["mount", "aim", "hit", "calibration", "soak", "step", "sentinel", "fit", "diagnosis", "change"]


@dataclass(frozen=True)
class TimedPiece:
    """One piece: two parts of its time, since only the second is a guess of the plate."""

    kind: Kind
    fixed_s: float
    settling_s: float = 0.0
    """From scratch to the tolerance; a step begins near its end and takes less."""


Region = tuple[int, float, float]
"""A segment's number, its lowest and its highest frequency in Hz."""
