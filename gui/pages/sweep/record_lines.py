"""Everything there is to say of one point. No Qt."""

from dataclasses import dataclass

import numpy as np

from gui.pages.sweep.seen import Seen
from instrument.results.quality import QUALITIES
from instrument.stepped_sine.settings import STANDARD_GRAVITY_M_S2, SweepSettings
from instrument.stream.derived import PointMeasured


@dataclass(frozen=True)
class Line:
    """A quantity of a point."""

    name: str
    value: str
    """With its unit."""
    tip: str = ""


def record_lines(seen: Seen, number: int, settings: SweepSettings) -> list[Line]:
    """All of a point's record, what matters most first."""
    p = seen.points.timed[number].point
    return [
        Line("Frequency", f"{p.frequency_hz:.7g} Hz"),
        Line("Quality", QUALITIES[seen.points.quality[number]], "Against the tolerances of the sweep"),
        *(Line("Remark", remark) for remark in p.remarks),
        *_response(seen, number),
        *_prediction(seen, number),
        *_base(p, settings),
        *_velocity(p),
        *_circumstances(seen, number, p),
    ]


def _response(seen: Seen, number: int) -> list[Line]:
    p, z = seen.points, seen.points.over_base_s[number]
    noise = float(np.hypot(p.noise_percent("velocity")[number], p.noise_percent("base")[number]))
    tip = f"Velocity over base acceleration, {seen.reads}"
    return [
        Line("|v/a|", f"{1e3 * abs(z):.5g} (mm/s)/(m/s\u00b2)", tip),
        Line("Phase of v/a", f"{np.degrees(np.angle(z)):.3f}\u00b0", tip),
        Line(
            "Noise of v/a",
            f"{noise:.2g} %, {np.degrees(noise / 100):.2g}\u00b0",
            "Standard deviation by the noise of both channels",
        ),
    ]


def _prediction(seen: Seen, number: int) -> list[Line]:
    predicted = seen.predicted.of(number)
    if predicted is None:
        return []
    p = seen.points
    measured = float(abs(p.over_base_s[number]) * p.level_m_s2[number])
    off = 100 * (predicted - measured) / measured
    return [
        Line(
            f"Fit {seen.fit} predicts",
            f"{1e3 * predicted:.5g} mm/s, {off:+.2f} %",
            "Amplitude at the level commanded, and its difference to the measured one",
        )
    ]


def _base(p: PointMeasured, settings: SweepSettings) -> list[Line]:
    a = p.base_m_s2
    return [
        Line(
            "Level asked for", f"{p.level_m_s2:.4g} m/s\u00b2 ({p.level_m_s2 / STANDARD_GRAVITY_M_S2:.3g} g)"
        ),
        Line("Base acceleration", f"{abs(a):.5g} m/s\u00b2", "Zero to peak, of the fundamental"),
        Line(
            "Level error",
            f"{p.control_error_percent:+.3f} % (\u00b1{100 * settings.control.tolerance:g} %)",
        ),
        Line("Base re, im", f"{a.real:.5g}, {a.imag:.5g} m/s\u00b2", _PHASOR),
        Line("Base noise", f"{p.base_accel_std_m_s2:.2g} m/s\u00b2", _NOISE),
        Line("Base distortion", f"{p.base_distortion_percent:.2g} %", _DISTORTION),
        Line("Drive", f"{p.drive_v:.4g} V"),
    ]


def _velocity(p: PointMeasured) -> list[Line]:
    v = 1e3 * p.velocity_m_s
    return [
        Line(
            "Velocity", f"{abs(v):.5g} mm/s", "Zero to peak; gain and delay of the calibration are taken off"
        ),
        Line("Velocity re, im", f"{v.real:.5g}, {v.imag:.5g} mm/s", _PHASOR),
        Line("Velocity noise", f"{1e3 * p.velocity_std_m_s:.2g} mm/s", _NOISE),
        Line("Velocity distortion", f"{p.velocity_distortion_percent:.2g} %", _DISTORTION),
        Line("Range", p.range_name, "Of the vibrometer"),
        Line("Light", _known(p.signal_level, ".2f", ""), "That came back to the vibrometer, 0 to 1"),
    ]


def _circumstances(seen: Seen, number: int, p: PointMeasured) -> list[Line]:
    return [
        Line("Settling", f"{p.settle_s:.3g} s", "From the last change of drive until it was at rest"),
        Line("Dwell", f"{p.dwell_s:.3g} s", "Length of the reading"),
        Line("Temperature", _known(p.temperature_c, ".2f", " \u00b0C")),
        Line("Time", f"{seen.points.time_s[number]:.2f} s", "Since the session's first sample"),
        Line("First sample", str(p.sample), "Of the dwell, in its acquisition"),
        Line("Step", f"{p.step} ({p.purpose})"),
        Line("Segment, pass", f"{p.segment}, {p.sweep}"),
    ]


def _known(value: float | None, digits: str, unit: str) -> str:
    return "\u2013" if value is None else f"{value:{digits}}{unit}"


_PHASOR = "Phasor of e^{+i omega t}, zero to peak, time from the acquisition's first sample"
_NOISE = "Standard deviation of each part of the phasor"
_DISTORTION = "Root sum of squares of the harmonics over the fundamental"
