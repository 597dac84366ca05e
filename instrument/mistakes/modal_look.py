"""Tables of modes beside what the best core makes of them: another unit or specimen is asked about."""

from collections.abc import Sequence

import numpy as np

from fitting.arrays import Array

FAR = 0.3
"""Median |ln(measured/predicted)| of the frequencies after the fit: a choice."""
_KILO = 1e3
_AS_KILO = 1.7
"""Of the factor 1000, either way: what the core may make of it."""
_MISSED = 0.07
"""|ln(measured/predicted)| of a frequency that no law of its own brings nearer: a clamp that yields, and what
else a rig does, takes a few percent. A choice."""


def modal_doubt(measured_hz: Array, predicted_hz: Array) -> str:
    """What to ask of modes that no core explains, (modes,) each; empty where they are near."""
    ratio = np.log(np.asarray(predicted_hz) / np.asarray(measured_hz))
    if float(np.median(np.abs(ratio))) <= FAR:
        return ""
    middle = float(np.median(ratio))
    if abs(middle - np.log(_KILO)) < _AS_KILO:
        return "the frequencies are in kHz, expected Hz"
    return "no core brings the modes near these frequencies, expected another specimen, mode numbers or unit"


def numbering_doubt(ratios: Sequence[Array]) -> str:
    """The same of several temperatures, each with a law of its own; empty where most are near.

    `ratios`: ln(predicted/measured) of each, shape (modes,).
    """
    worst = float(np.median([np.abs(one).max() for one in ratios]))
    if worst <= _MISSED:
        return ""
    return (
        "no core of its own brings the modes of a temperature nearer to these frequencies than "
        f"{100 * worst:.0f} %, expected another specimen or mode numbers"
    )
