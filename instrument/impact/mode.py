"""A mode of an impact test."""

from dataclasses import dataclass

from fitting.modal.frf import DampingEstimate, Refusal
from fitting.modal.rational_fit import RationalFit


@dataclass(frozen=True)
class Mode:
    """One mode: what each method says, what is adopted, and what speaks against it."""

    frequency_hz: float
    damping_ratio: float
    """NaN where no method gives one."""
    channel: str
    half_power: DampingEstimate | Refusal
    rational_fit: DampingEstimate | Refusal
    lscf: DampingEstimate | Refusal
    lines_in_bandwidth: float
    bandwidths_to_next: float
    """Distance to the nearest other mode; infinite for a single one."""
    accepted: bool
    why: str
    fit: RationalFit | None = None
    """For drawing."""
