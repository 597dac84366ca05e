"""Half-power bandwidth: the paper's method, with the exact formula of each kind of response.

With f1, f2 where |H| is 1/sqrt(2) of its peak, a single viscous mode has exactly

    mobility                     f_n = sqrt(f1 f2),  zeta = (f2 - f1)/(2 f_n)
    receptance and accelerance   zeta = sin(arctan((f2^2 - f1^2)/(f2^2 + f1^2))/2)

Crossings are interpolated in |H|^-2, a parabola near a peak. Read on n lines inside the
bandwidth without interpolation the ratio comes out some 40 % high (n = 1), 2 % (5), 0.5 % (10);
zero padding makes n large. A neighbour 5 bandwidths away still adds some 5 %.

A record that ends after T, where a decay exp(-s t) has e = exp(-s T) left, multiplies the mode by
1 - e exp(-i (w - w_n) T). To first order in e the peak's power is lower by 2 e and that at w_n +- s by
2 e cos(s T), which moves either crossing by 2 e (1 - cos(s T)) of s.
"""

import numpy as np

from fitting.arrays import Array
from fitting.modal.attempt import refusing
from fitting.modal.frf import DampingEstimate, Frf, Motion, Refusal, corrected, is_near

_FEWEST_POINTS = 5
"""Lines between the crossings below which interpolation cannot be trusted."""


@refusing
def half_power(
    frf: Frf, near_hz: float, noise: float = 0.0, record_s: float = np.inf
) -> DampingEstimate | Refusal:
    """Ratio of the peak nearest to `near_hz`.

    `noise` is the standard deviation of one line of H; it gives the standard error, into which goes what the
    end of a record of `record_s` does to the ratio.
    """
    marks = half_power_marks(frf, near_hz)
    if isinstance(marks, Refusal):
        return marks
    f1, f_peak, f2, inside = marks
    if not is_near(f_peak, near_hz):
        return Refusal(f"no peak near {near_hz:g} Hz: the nearest is at {f_peak:.4g} Hz")
    if inside < _FEWEST_POINTS:
        return Refusal(f"{inside} lines between the half-power points, expected {_FEWEST_POINTS} or more")
    ratio, f_n = ratio_of(f1, f2, frf.motion)
    peak = float(np.max(np.abs(frf.between(f1, f2).H)))
    # A crossing moves by noise over slope; the slope there is about peak/(sqrt(2) half bandwidth).
    error = noise / peak * ratio * 2 if noise > 0 else float("nan")
    error = float(np.hypot(error, ratio * cut_off(np.pi * (f2 - f1) * record_s)))
    return DampingEstimate(*corrected(f_n or f_peak, ratio, frf.added_decay_1_s), error)


def cut_off(decays: float) -> float:
    """What the end of a record does to a bandwidth, relative: it lasts for `decays` times 1/s."""
    return float(2 * np.exp(-decays) * (1 - np.cos(decays))) if np.isfinite(decays) else 0.0


def ratio_of(f1: float, f2: float, motion: Motion) -> tuple[float, float]:
    """Zeta and f_n of a single mode from its half-power frequencies."""
    if motion == "velocity":
        f_n = float(np.sqrt(f1 * f2))
        return (f2 - f1) / (2 * f_n), f_n
    theta = 0.5 * np.arctan((f2**2 - f1**2) / (f2**2 + f1**2))
    zeta = float(np.sin(theta))
    # receptance: (f1^2 + f2^2)/2 = f_n^2 cos(2 theta); accelerance: the same of 1/f
    mean = (f1**2 + f2**2) / 2 if motion == "displacement" else 2 / (f1**-2 + f2**-2)
    factor = 1 / np.cos(2 * theta) if motion == "displacement" else np.cos(2 * theta)
    return zeta, float(np.sqrt(mean * factor))


def half_power_marks(frf: Frf, near_hz: float) -> tuple[float, float, float, int] | Refusal:
    """Frequencies f1, peak and f2, and how many lines lie between the crossings."""
    f, power = frf.frequency_hz, np.abs(frf.H) ** 2
    k = _climb(power, int(np.argmin(np.abs(f - near_hz))))
    if k in (0, len(f) - 1):
        return Refusal("the peak lies at the edge of the band")
    f_peak, top = _vertex(f[k - 1 : k + 2], 1 / power[k - 1 : k + 2])
    half = top / 2
    left, right = k, k
    while left > 0 and power[left] > half:
        left -= 1
    while right < len(f) - 1 and power[right] > half:
        right += 1
    if power[left] > half or power[right] > half:
        return Refusal("the response does not fall to half power on both sides")
    f1 = _crossing(f[left], f[left + 1], power[left], power[left + 1], half, f_peak)
    f2 = _crossing(f[right], f[right - 1], power[right], power[right - 1], half, f_peak)
    return f1, f_peak, f2, right - left - 1


def _climb(power: Array, k: int) -> int:
    while True:
        best = max(range(max(k - 1, 0), min(k + 2, len(power))), key=lambda i: power[i])
        if best == k:
            return k
        k = best


def _vertex(f: Array, inverse_power: Array) -> tuple[float, float]:
    """Peak frequency and peak power by a parabola through three lines of |H|^-2."""
    t = f - f[1]
    a, b, c = np.polyfit(t, inverse_power, 2)
    if a <= 0:
        return float(f[1]), float(1 / inverse_power[1])
    at = float(np.clip(-b / (2 * a), t[0], t[2]))
    least = c + b * at + a * at**2
    return float(f[1] + at), float(1 / max(least, 0.5 * inverse_power[1]))


def _crossing(f_low: float, f_high: float, p_low: float, p_high: float, half: float, f_peak: float) -> float:
    """Where |H|^-2 crosses 1/half, linear in (f - f_peak)^2 between two lines."""
    x_low, x_high = (f_low - f_peak) ** 2, (f_high - f_peak) ** 2
    y_low, y_high, y = 1 / p_low, 1 / p_high, 1 / half
    x = x_high + (x_low - x_high) * (y - y_high) / (y_low - y_high)
    return float(f_peak + np.copysign(np.sqrt(max(x, 0.0)), f_low - f_peak))
