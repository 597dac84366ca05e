"""What instruments read wrongly, as changes of the response of known size, marginalised in every fit.

Gain and phase of a segment are off alike in all passes over it. Instruments drift besides: along every pass,
and from one to the next, so two levels are never read by quite the same instrument.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from fitting.arrays import Complex, Mask
from fitting.model_error import DRIFT, GAIN
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


def _passes(sweep: Sweep, inside: Mask) -> Iterator[Mask]:
    """Points of each pass; another level is another pass, whether or not it is numbered so."""
    each = np.stack([sweep.sweep.astype(float), sweep.commanded_m_s2])
    for one in np.unique(each[:, inside], axis=1).T:
        yield inside & np.all(each == one[:, None], axis=0)
