"""What instruments read wrongly, as changes of the response of known size, marginalised in every fit.

Gain and phase of a segment are off alike in all passes over it. Instruments drift besides: along every pass,
and from one to the next, so two levels are never read by quite the same instrument.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from fitting.arrays import Array, Complex, Mask
from fitting.data.levels import by_level
from fitting.discrepancy.model_error import AGAIN, AGAIN_WITHIN_S, DRIFT, GAIN
from fitting.sweep import Sweep


def channel_rows(
    sweep: Sweep,
    inside: Mask,
    v: Complex,
    *,
    has_phase: bool,
    parts: Sequence[Complex] | None = None,
    gain: float = GAIN,
) -> list[Complex]:
    """Changes of the velocity `v`, one standard deviation each, in one segment: the points `inside`.

    `parts` add up to it: each is read by a gain of its own, off by `gain`. Shapes (points,), each row too.
    """
    rows = [gain * part * inside for part in ([v] if parts is None else parts)]
    passes = list(_passes(sweep, inside))
    for here in passes:
        f = sweep.frequency_hz[here]
        along = np.zeros(len(v))
        along[here] = 2 * (f - f.min()) / max(float(np.ptp(f)), 1e-9) - 1
        rows.append(DRIFT * along * v)
        if len(passes) > 1:
            rows.append(DRIFT * v * here)
    return [*rows, *(1j * row for row in rows)] if has_phase else rows


def blow_rows(frequency_hz: Array, v: Complex) -> Complex:
    """Changes of what blows read, `v`, by further ones that nobody saw, one standard deviation each.

    A second blow a time T after the first, of which the force's window has cut off the pulse, multiplies the
    reading by 1 + a e^{-i 2 pi f T}. As many T as a band tells apart. Shape (points,); (any, points).
    """
    band = float(np.ptp(frequency_hz))
    delays = np.arange(1, int(AGAIN_WITHIN_S * band) + 1) / max(band, 1e-9)
    size = AGAIN / np.sqrt(max(1, len(delays)))
    rows = size * np.exp(-2j * np.pi * np.outer(delays, frequency_hz)) * v
    return np.concatenate([rows, 1j * rows])


def _passes(sweep: Sweep, inside: Mask) -> Iterator[Mask]:
    """Points of each pass; another level is another pass, whether or not it is numbered so."""
    for number in np.unique(sweep.sweep[inside]):
        at = np.flatnonzero(inside & (sweep.sweep == number))
        for level in by_level(sweep.commanded_m_s2[at]):
            here = np.zeros(len(sweep), dtype=bool)
            here[at[level]] = True
            yield here
