"""Tables of modes beside what the best core makes of them: another unit or specimen is asked about."""

import numpy as np

from fitting.arrays import Array

FAR = 0.3
"""Median |ln(measured/predicted)| of the frequencies after the fit: a choice."""
_KILO = 1e3
_AS_KILO = 1.7
"""Of the factor 1000, either way: what the core may make of it."""


def modal_doubt(measured_hz: Array, predicted_hz: Array) -> str:
    """What to ask of modes that no core explains, (modes,) each; empty where they are near."""
    ratio = np.log(np.asarray(predicted_hz) / np.asarray(measured_hz))
    if float(np.median(np.abs(ratio))) <= FAR:
        return ""
    middle = float(np.median(ratio))
    if abs(middle - np.log(_KILO)) < _AS_KILO:
        return "the frequencies are in kHz, expected Hz"
    return "no core brings the modes near these frequencies, expected another specimen, mode numbers or unit"
