"""A mistake in one segment alone: a range read in another unit, a cable turned on the way."""

import numpy as np

from fitting.arrays import Complex, Mask
from fitting.specimen import Drive
from fitting.sweep import Sweep
from instrument.mistakes.any_core import FURTHEST, AnyCore, Nearest
from instrument.mistakes.response_mistakes import Mistake, response_of, words_of

_LEFT = 0.2
"""Distance that may be left where each segment has a factor of its own."""
_BETTER = 0.5
"""Of the distance without."""
_TURN = 0.35
"""Rad from none or half a turn: in between a resonance lies elsewhere."""


def mistake_in_a_segment(sweep: Sweep, model: AnyCore, as_is: Nearest, drive: Drive) -> str | None:
    """What was done to less than half of the segments; empty where a diagnosis finds it, else None."""
    numbers = np.unique(sweep.segment)
    off = np.log(response_of(sweep)) - model.log_velocity(as_is.core[None])[0]
    turned = np.log(response_of(sweep).conj()) - model.log_velocity(as_is.core[None])[0]
    left, said, slight = np.zeros(len(sweep)), [], 0
    for number in numbers:
        part = sweep.segment == number
        choices = [(_own(one, part, sweep.has_phase), conj) for one, conj in ((off, False), (turned, True))]
        (size, factor), conjugated = min(choices[: 1 + sweep.has_phase], key=lambda one: one[0][0].mean())
        left[part] = size
        mistake = Mistake(response_of, conjugated=conjugated)
        words = words_of(mistake, factor, drive)
        if mistake.is_slight(factor) and abs(np.log(abs(factor))) > _TURN:
            slight += 1
        elif words and abs(np.sin(np.angle(factor))) < np.sin(_TURN):
            f = sweep.frequency_hz[part]
            said.append(f"in segment {number} ({f.min():g} to {f.max():g} Hz) {words}")
    if left.mean() > min(_LEFT, _BETTER * as_is.distance) or 2 * len(said) >= len(numbers):
        return None
    if said:
        return ", and ".join(said)
    return "" if 0 < 2 * slight < len(numbers) else None


def _own(off: Complex, part: Mask, has_phase: bool) -> tuple[np.ndarray, complex]:
    """What is left of ln(measured/predicted) beside a factor, and the factor."""
    own = off[part]
    turn = float(np.angle(np.mean(np.exp(1j * own.imag)))) if has_phase else 0.0
    log_factor = np.median(own.real) + 1j * turn
    rest = own - log_factor
    phase = np.angle(np.exp(1j * rest.imag)) if has_phase else 0.0
    return np.minimum(np.abs(rest.real + 1j * phase), FURTHEST), complex(np.exp(log_factor))
