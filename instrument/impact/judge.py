"""Is a hit good? Samples in, a verdict and notes out.

What is set right is noted (an offset, an inverted force); what cannot be is a reason to leave the hit out.
"""

from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array
from fitting.numerics.robust import robust_scatter
from instrument.impact.record import Hit

PULSE_LEVEL = 0.1
"""Share of the peak above which samples belong to a blow."""
DOUBLE_HIT = 0.05
"""Share of the peak at which a later blow counts."""
FLAT_SAMPLES = 4
"""Equal samples in a row at an extreme that no free motion makes."""
_JUMP = 3.0
"""Steps of the converter that make the edge of a flat top a jump."""
_COARSEST = 0.05
"""No converter's step is a larger share of what it measures."""
_TOPS = (0.005, 0.01, 0.02, 0.04)
"""Shares of the extremes, down to which samples of a clipped signal with noise on it pile up."""
_PILED = 5.0
"""Times as many samples there as in the next such share below: a parabola's top has 2.4 times as many, and of
1,650 unclipped hits by closed form 0.1 % had more."""
_FEWEST_PILED = 8
"""Samples at the extremes of which that is asked."""
_FEWEST_VISITS, _LEFT = 3, 0.8
"""Times that a clipped signal comes to its extremes, having been below this share of them between."""
_IMPULSE = 2
"""A blow so short may begin with the record: nothing of it is cut off."""
_SILENT = 10.0
"""A channel peaks at least so many times above its own scatter before the blow."""
_LONG_PULSE = 0.05
"""Share of the record above which a force is no blow."""
_RINGS = 0.25
"""Of the peak, to the other side: a hammer only pushes, and a sensor's undershoot is less."""


@dataclass(frozen=True)
class Judged:
    """A hit set right, whether it is used, and why not."""

    hit: Hit
    accepted: bool
    why: str
    notes: tuple[str, ...]
    pulse: slice
    """Samples of the blow."""


def judge(hit: Hit) -> Judged:
    """Remove offsets, turn an inverted force, and find what spoils the hit."""
    hit, notes = _set_right(hit)
    pulse = _pulse(hit.force_n)
    faults = [
        *_force_faults(hit, pulse),
        *(fault for channel in hit.responses for fault in _response_faults(channel.name, channel.samples)),
    ]
    return Judged(hit, not faults, "; ".join(faults), tuple(notes), pulse)


def _set_right(hit: Hit) -> tuple[Hit, list[str]]:
    notes = []
    force = hit.force_n - np.median(hit.force_n)
    peak = np.abs(force).max(initial=0.0)
    if peak > 0 and force[np.argmax(np.abs(force))] < 0:
        force = -force
        notes.append("the force is inverted: turned")
    offset = float(np.median(hit.force_n))
    if peak > 0 and abs(offset) > 1e-3 * peak:
        notes.append(f"the force has an offset of {offset:.3g} N: removed")
    responses = tuple(replace(c, samples=c.samples - np.mean(c.samples)) for c in hit.responses)
    return replace(hit, force_n=force, responses=responses), notes


def _pulse(force: Array) -> slice:
    peak = int(np.argmax(force))
    above = force > PULSE_LEVEL * force[peak]
    start, end = peak, peak
    while start > 0 and above[start - 1]:
        start -= 1
    while end < len(force) - 1 and above[end + 1]:
        end += 1
    return slice(start, end + 1)


def _force_faults(hit: Hit, pulse: slice) -> list[str]:
    force, rate = hit.force_n, hit.sample_rate_hz
    peak = float(force.max(initial=0.0))
    if peak <= 0 or peak < _SILENT * robust_scatter(force):
        return ["the force channel is silent"]
    if np.mean(np.abs(force) > PULSE_LEVEL * peak) > _LONG_PULSE or force.min() < -_RINGS * peak:
        return ["the force rings on like a response: are the channels swapped?"]
    faults = []
    if _is_flat(force):
        faults.append(f"the force is overloaded (flat top at {peak:.3g} N)")
    if pulse.start == 0 and pulse.stop > _IMPULSE:
        faults.append("the record begins inside the blow: no pre-trigger")
    # The pulse's own tail may undershoot and ring a little: look again after twice its length.
    width = pulse.stop - pulse.start
    after = force[min(pulse.stop + 2 * width, len(force)) :]
    limit = max(DOUBLE_HIT * peak, _SILENT * robust_scatter(force))
    if after.size and after.max() > limit:
        at = (len(force) - after.size + int(np.argmax(after)) - int(np.argmax(force))) / rate
        faults.append(
            f"double hit: {100 * after.max() / peak:.0f} % of the blow again after {at * 1e3:.1f} ms"
        )
    return faults


def _response_faults(name: str, samples: Array) -> list[str]:
    peak = float(np.abs(samples).max(initial=0.0))
    if peak == 0 or np.ptp(samples) < 1e-12 * max(1.0, peak):
        return [f"channel {name} is silent"]
    if _is_flat(samples) or _is_flat(-samples):
        return [f"channel {name} is overloaded (flat top at {peak:.3g})"]
    if _piles_up(samples):
        return [f"channel {name} is overloaded (its samples pile up at its extremes, {peak:.3g})"]
    return []


def _piles_up(samples: Array) -> bool:
    """Whether a signal was cut before noise came to it: more samples at its extremes than motion has."""
    sides = [(side, float(side.max())) for side in (samples, -samples)]
    for share in _TOPS:
        at_top = sum(int(np.sum(side > (1 - share) * top)) for side, top in sides)
        below = sum(int(np.sum(side > (1 - 2 * share) * top)) for side, top in sides) - at_top
        if at_top >= _FEWEST_PILED and at_top > _PILED * (below + 1):
            # What moves as a whole stays at its extreme as well, but comes there once.
            return sum(_visits(side, share, top) for side, top in sides) >= _FEWEST_VISITS
    return False


def _visits(side: Array, share: float, top: float) -> int:
    """How often it comes to its extreme, having left it by far."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], side > _LEFT * top, [False]]).astype(int)))
    return sum(
        bool(np.any(side[start:stop] > (1 - share) * top))
        for start, stop in zip(edges[::2], edges[1::2], strict=True)
    )


def _is_flat(samples: Array) -> bool:
    """Whether the samples stand still at their maximum, entered or left by a jump.

    A coarsely digitised but smooth peak stands still too; it is entered by single steps of the converter.
    """
    top = float(samples.max())
    at_top = samples >= top - 1e-9 * abs(top)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], at_top, [False]]).astype(int)))
    steps = np.diff(np.unique(samples))
    step = float(steps.min()) if steps.size else 0.0
    for start, stop in zip(edges[::2], edges[1::2], strict=True):
        if stop - start >= FLAT_SAMPLES:
            before = top - samples[start - 1] if start > 0 else 0.0
            after = top - samples[stop] if stop < len(samples) else 0.0
            if max(before, after) > min(_JUMP * step, _COARSEST * top):
                return True
    return False
