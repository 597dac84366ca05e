"""What was read off an FRF, as curves and places to draw."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex
from fitting.modal.frf import Frf
from fitting.modal.rational_fit import RationalFit
from instrument.impact.damping import marks
from instrument.impact.mode import Mode


@dataclass(frozen=True)
class HalfPowerMarks:
    """Where half power was read."""

    low_hz: float
    high_hz: float
    level: float
    """Of |H| at both crossings: the peak's over the root of two."""


def half_power_at(fine: Frf, mode: Mode) -> HalfPowerMarks | None:
    """On the padded FRF; None where the response does not fall to half power on both sides."""
    found = marks(fine, mode)
    if found is None:
        return None
    low, _, high = found
    level = np.interp([low, high], fine.frequency_hz, np.abs(fine.H)).mean()
    return HalfPowerMarks(low, high, float(level))


def fit_curve(fit: RationalFit, frequency_hz: Array) -> Complex:
    """The rational fit at any frequencies inside its window.

    On its own lines it lies in the span of its poles and a straight line: that gives the coefficients back.
    Shape of `frequency_hz`.
    """
    middle = fit.frequency_hz.mean()
    c, *_ = np.linalg.lstsq(_columns(fit.frequency_hz, middle, fit.poles), fit.H, rcond=None)
    return np.asarray(_columns(frequency_hz, middle, fit.poles) @ c)


def _columns(frequency_hz: Array, middle_hz: float, poles: Complex) -> Complex:
    resonances = np.abs(poles.real) / (2j * np.pi * frequency_hz[:, None] - poles)
    ones = np.ones(len(frequency_hz))
    return np.column_stack([resonances, ones, (frequency_hz - middle_hz) / middle_hz])
