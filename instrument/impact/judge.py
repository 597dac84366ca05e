"""Is a hit good? Samples in, a verdict and notes out.

What is set right is noted (an offset, an inverted force); what cannot be is a reason to leave the hit out.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from instrument.impact.record import Hit

Array = NDArray[np.float64]

PULSE_LEVEL = 0.1
"""Share of the peak above which samples belong to a blow."""
DOUBLE_HIT = 0.05
"""Share of the peak at which a later blow counts."""
FLAT_SAMPLES = 4
"""Equal samples in a row at an extreme that no free motion makes."""
_SILENT = 10.0
"""A channel peaks at least so many times above its own scatter before the blow."""
_LONG_PULSE = 0.05
"""Share of the record above which a force is no blow."""


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
    if peak <= 0 or peak < _SILENT * _scatter(force):
        return ["the force channel is silent"]
    if np.mean(np.abs(force) > PULSE_LEVEL * peak) > _LONG_PULSE:
        return ["the force rings on like a response: are the channels swapped?"]
    faults = []
    if _is_flat(force):
        faults.append(f"the force is overloaded (flat top at {peak:.3g} N)")
    if pulse.start == 0:
        faults.append("the record begins inside the blow: no pre-trigger")
    # The pulse's own tail may undershoot and ring a little: look again after twice its length.
    width = pulse.stop - pulse.start
    after = force[min(pulse.stop + 2 * width, len(force)) :]
    limit = max(DOUBLE_HIT * peak, _SILENT * _scatter(force))
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
    return []


def _scatter(samples: Array) -> float:
    """Robust standard deviation of samples that are mostly noise."""
    return float(1.4826 * np.median(np.abs(samples - np.median(samples))))


def _is_flat(samples: Array) -> bool:
    """Whether the samples stand still at their maximum."""
    top = float(samples.max())
    at_top = samples >= top - 1e-6 * abs(top)
    run = longest = 0
    for flag in at_top:
        run = run + 1 if flag else 0
        longest = max(longest, run)
    return longest >= FLAT_SAMPLES
