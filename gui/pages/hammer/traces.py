"""Numbers for drawing: time traces of a hit, lines of an FRF, the surroundings of a mode. No Qt."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex
from fitting.modal.frf import Frf
from instrument.files.units import DERIVATIVE
from instrument.impact.curves import HalfPowerMarks, fit_curve, half_power_at
from instrument.impact.damping import Damping
from instrument.impact.judge import Judged
from instrument.impact.mode import Mode

XY = tuple[Array, Array]

_BEFORE, _AFTER = 3, 12
"""Lengths of the blow shown around it."""
_HALF_WIDTH_BANDWIDTHS, _HALF_WIDTH_LINES = 5.0, 8
"""Shown about a mode, whichever is more."""
_CURVE_POINTS = 600
_UNKNOWN_RATIO = 2e-3
"""Sets the width shown about a mode without a damping ratio."""


@dataclass(frozen=True)
class Traces:
    """Of one hit, set right (offsets off, the force upwards); time from the blow's peak."""

    blow: XY
    """ms and N: the blow and a little around it."""
    force: XY
    """s and N, the whole record."""
    response: XY
    """s and m/s^2, the whole record; m/s where a laser reads it."""

    @classmethod
    def of(cls, judged: Judged) -> "Traces":
        """The traces of a hit that has been judged."""
        hit, pulse = judged.hit, judged.pulse
        t = (np.arange(len(hit.force_n)) - int(np.argmax(hit.force_n))) / hit.sample_rate_hz
        width = pulse.stop - pulse.start
        shown = slice(max(0, pulse.start - _BEFORE * width), pulse.stop + _AFTER * width)
        return cls((1e3 * t[shown], hit.force_n[shown]), (t, hit.force_n), (t, hit.responses[0].samples))


@dataclass(frozen=True)
class Lines:
    """Of an FRF, from its first line above zero to where it is drawn."""

    frequency_hz: Array
    magnitude: Array
    phase_deg: Array

    @classmethod
    def of(cls, frf: Frf, reach_hz: float) -> "Lines":
        """Up to a frequency."""
        part = frf.between(float(frf.frequency_hz[1]), reach_hz)
        return cls(part.frequency_hz, np.abs(part.H), _degrees(part.H))


@dataclass(frozen=True)
class Surroundings:
    """Of one mode: where to look, and what was read there."""

    low_hz: float
    high_hz: float
    lines: Lines
    """Of the average, as the rational fit sees them."""
    fine: Lines
    """Padded and windowed, as half power sees them."""
    fit: Lines | None
    marks: HalfPowerMarks | None

    @classmethod
    def of(cls, found: Damping, mode: Mode) -> "Surroundings":
        """The surroundings of a mode, in its own channel."""
        plain, fine = found.plain[mode.channel], found.fine[mode.channel]
        step = float(plain.frequency_hz[1] - plain.frequency_hz[0])
        ratio = mode.damping_ratio if mode.damping_ratio > 0 else _UNKNOWN_RATIO
        reach = max(_HALF_WIDTH_BANDWIDTHS * 2 * ratio * mode.frequency_hz, _HALF_WIDTH_LINES * step)
        low, high = max(step, mode.frequency_hz - reach), mode.frequency_hz + reach
        return cls(
            low,
            high,
            _between(plain, low, high),
            _between(fine, low, high),
            _curve(mode, low, high),
            half_power_at(fine, mode),
        )


def _between(frf: Frf, low_hz: float, high_hz: float) -> Lines:
    part = frf.between(low_hz, high_hz)
    return Lines(part.frequency_hz, np.abs(part.H), _degrees(part.H))


def _curve(mode: Mode, low_hz: float, high_hz: float) -> Lines | None:
    """The fit between its lines, no further than it was made."""
    if mode.fit is None:
        return None
    inside = max(low_hz, mode.fit.frequency_hz[0]), min(high_hz, mode.fit.frequency_hz[-1])
    f = np.linspace(*inside, _CURVE_POINTS)
    H = fit_curve(mode.fit, f)
    return Lines(f, np.abs(H), _degrees(H))


def accelerance(frf: Frf) -> Frf:
    """The same measurement as acceleration over force."""
    H = frf.H * (1j * frf.omega) ** (DERIVATIVE["acceleration"] - DERIVATIVE[frf.motion])
    return Frf(frf.frequency_hz, H, "acceleration", frf.added_decay_1_s)


def _degrees(H: Complex) -> Array:
    """From -90 to 270: a plate's response is mostly near 0 or 180, and must not jump there."""
    return np.asarray(np.mod(np.degrees(np.angle(H)) + 90, 360) - 90)
