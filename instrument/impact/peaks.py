"""Peaks of FRFs: those that stand out of the lines' scatter, and those that nobody found a mode for."""

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.ndimage import median_filter

from fitting.arrays import Array
from fitting.modal.frf import Frf
from instrument.errors import BadInput
from instrument.impact.mode import Mode

_FEWEST_LINES = 5
"""Of a band, to see a peak and its surroundings."""
PROMINENCE = 6.0
"""Of a peak over the scatter of the lines."""
_SCATTER_LINES = 101
"""Over which the lines' usual size is a median: far wider than a lightly damped peak. A choice."""
MOST_MODES = 60
"""Peaks looked at, the highest: a bound on time."""
_EVIDENT = 4.0
"""Times `PROMINENCE`: what anyone sees in the curve. A choice."""
_NAMED = 6
"""Peaks that one line names: a choice."""
_OWN = 4.0
"""Half bandwidths, or lines, about a mode that are its own peak's."""
_BEYOND = 1.05
"""Times the band's end that there must be above it, to be looked at."""
_SAME = 2e-3
"""Relative distance within which two channels' peaks are one mode."""


def peaks_of(plain: Frf, fine: Frf, band: tuple[float, float]) -> list[tuple[float, float]]:
    """Frequency and height over the scatter of the most outstanding peaks.

    Not in decibels: noise has deep nulls, and its peaks stand higher above those than modes do. Raises
    `BadInput` for a band of a few lines.
    """
    inside = fine.between(*band)
    if min(len(inside.H), len(plain.between(*band).H)) < _FEWEST_LINES:
        raise BadInput(
            f"band {band[0]:g} to {band[1]:g} Hz holds {len(inside.H)} lines, expected {_FEWEST_LINES} or "
            f"more: they go from {fine.frequency_hz[0]:g} to {fine.frequency_hz[-1]:g} Hz"
        )
    # Loaded here: with what it brings along it takes as long as a third of the window's start.
    from scipy.signal import find_peaks

    where, facts = find_peaks(np.abs(inside.H), prominence=0)
    height = facts["prominences"] / _scatter(plain, inside.frequency_hz[where])
    best = [k for k in np.argsort(-height)[:MOST_MODES] if height[k] > PROMINENCE]
    return [(float(inside.frequency_hz[where[k]]), float(height[k])) for k in best]


def _scatter(frf: Frf, at_hz: Array) -> Array:
    """Typical departure of a line from its neighbours' mean, nearby: noise, not modes."""
    away = np.abs(frf.H[1:-1] - (frf.H[:-2] + frf.H[2:]) / 2)
    typical = median_filter(away, size=_SCATTER_LINES, mode="nearest")
    return np.interp(at_hz, frf.frequency_hz[1:-1], np.maximum(typical, 1e-12 * np.abs(frf.H).max()))


def merged(peaks: list[tuple[float, float]], apart_hz: float) -> list[float]:
    """One frequency a mode: channels see the same one a little apart."""
    kept: list[tuple[float, float]] = []
    for f, prominence in sorted(peaks):
        if kept and f - kept[-1][0] < max(apart_hz, _SAME * f):
            kept[-1] = max(kept[-1], (f, prominence), key=lambda peak: peak[1])
        else:
            kept.append((f, prominence))
    return [f for f, _ in kept]


def without_a_pole(
    plain: Mapping[str, Frf], fine: Mapping[str, Frf], band: tuple[float, float], modes: Sequence[Mode]
) -> list[str]:
    """Peaks that nobody overlooks and that are no mode: said, lest a mode is lost without a word."""
    step = max(float(np.median(np.diff(frf.frequency_hz))) for frf in plain.values())
    lost = [f for f in _evident(plain, fine, band) if not any(_covers(m, f, step) for m in modes)]
    if not lost:
        return []
    at = ", ".join(f"{f:.4g}" for f in lost)
    return [f"no pole explains the {_peaks_words(lost)} at {at} Hz: mains, an alias, or a mode beside one?"]


def beyond(
    plain: Mapping[str, Frf], fine: Mapping[str, Frf], band: tuple[float, float], highest_hz: float
) -> list[str]:
    """Peaks above where the blow excites enough to look for modes."""
    if highest_hz < _BEYOND * band[1]:
        return []
    above = _evident(plain, fine, (band[1], highest_hz))
    if not above:
        return []
    at = ", ".join(f"{f:.4g}" for f in above)
    return [
        f"not looked at: {_peaks_words(above)} at {at} Hz, beyond {band[1]:.4g} Hz, where the blow excites "
        f"little; a harder tip, or --band {band[0]:.3g}:{1.1 * above[-1]:.4g}"
    ]


def _evident(plain: Mapping[str, Frf], fine: Mapping[str, Frf], band: tuple[float, float]) -> list[float]:
    found = [
        peak
        for name, frf in fine.items()
        if len(plain[name].between(*band).H) >= _FEWEST_LINES
        for peak in peaks_of(plain[name], frf, band)
        if peak[1] > _EVIDENT * PROMINENCE
    ]
    return merged(found, _SAME * band[1])[:_NAMED]


def _covers(mode: Mode, f: float, step: float) -> bool:
    """Whether a peak is that mode's own, or a line or two from it."""
    ratio = mode.damping_ratio if mode.damping_ratio > 0 else 0.0
    return abs(mode.frequency_hz - f) < max(_OWN * ratio * f, _OWN * step)


def _peaks_words(at: Sequence[float]) -> str:
    return "peak" if len(at) == 1 else "peaks"
