"""How far the hits of a test agree: each alone, at the modes that were found from all of them."""

from dataclasses import dataclass

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.modal.frf import Frf
from fitting.modal.rational_fit import MOST_TERMS, RationalFit, rational_fit
from instrument.impact.damping import Damping
from instrument.impact.mode import Mode
from instrument.impact.spectra import spectra

_FEWEST = 2
"""Hits that give a value, for there to be a scatter."""


@dataclass(frozen=True)
class Scatter:
    """Of one mode over the hits: standard deviations of single hits, not of their mean."""

    frequency_hz: float
    ratio: float
    """Of the damping ratio, in its own unit."""
    hits: int
    """That give a value by themselves."""


def scatter_over_hits(found: Damping) -> tuple[Scatter | None, ...]:
    """A `Scatter` for each mode, by the rational fit; None where fewer than two hits give a value."""
    used = [j for j in found.hits if j.accepted]
    if len(used) < _FEWEST:
        return (None,) * len(found.modes)
    alone = [spectra([j]).frfs for j in used]
    with threadpool_limits(1, "blas"):
        return tuple(_of_mode(mode, found.modes, alone) for mode in found.modes)


def _of_mode(mode: Mode, modes: tuple[Mode, ...], alone: list[dict[str, Frf]]) -> Scatter | None:
    if not mode.damping_ratio > 0:
        return None
    f, others = mode.frequency_hz, tuple(m.frequency_hz for m in modes if m is not mode)
    fits = [rational_fit(one[mode.channel], f, mode.damping_ratio, others, MOST_TERMS) for one in alone]
    values = np.array(
        [(fit.estimate.frequency_hz, fit.estimate.ratio) for fit in fits if isinstance(fit, RationalFit)]
    )
    if len(values) < _FEWEST:
        return None
    frequency_hz, ratio = values.std(axis=0, ddof=1)
    return Scatter(float(frequency_hz), float(ratio), len(values))
