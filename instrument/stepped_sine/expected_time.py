"""How long a step is expected to take, as the run itself decides that it has come to rest.

`settling` bounds what is left of a transient by its drift: with q = e^{-sigma T} what drifts from block to
block counts q / (1 - q) times, so that a slow decay has to wait for much less drift than a fast one. A drift
that begins with the share s of the response is let go of after k blocks of length T, where

    s q / (1 - q) q^k = tolerance
"""

from collections.abc import Sequence

import numpy as np

from instrument.stepped_sine.drive import FAR
from instrument.stepped_sine.settings import SweepSettings

_SEEN = 0.1
"""Of the response: the drift that a step begins with. A transient is about as large as the response, and
a block's fit at another frequency sees a tenth of it. Of three simulated plates, with loss factors from 0.005
to 1, a beam and a shear pair, the steps together took 0.9 to 1.2 times what is expected with this."""
_FEWEST = 2
"""Blocks between which a first drift is seen."""
_CHECK_BLOCKS = 2.0
"""Of a loop check, as `step` has it."""
_SLOWEST_1_S = 1e-6
"""What has no damping at all would never settle: weeks are as good as that, and no division by zero."""


def settling_s(frequency_hz: float, decay_1_s: float, settings: SweepSettings) -> float:
    """From the end of the drive's ramp to the tolerance, in s, whatever `most_s` is."""
    block = settings.block_s(frequency_hz)
    excess = _first_bound(block, decay_1_s) / settings.settle.tolerance
    blocks = np.ceil(np.log(max(excess, 1.0)) / max(decay_1_s, _SLOWEST_1_S) / block)
    return float(block * max(_FEWEST, blocks))


def left_at_most_s(frequency_hz: float, decay_1_s: float, settings: SweepSettings) -> float:
    """The bound on the transient, relative, by the time that `most_s` would end the wait."""
    first = _first_bound(settings.block_s(frequency_hz), decay_1_s)
    return float(first * np.exp(-decay_1_s * settings.settle.most_s))


def step_s(frequency_hz: float, decay_1_s: float, settings: SweepSettings) -> float:
    """Of a whole step in s: the drive comes up, the response to rest (`most_s` ends that), and it is read."""
    wait = min(settling_s(frequency_hz, decay_1_s, settings), settings.settle.most_s)
    return settings.control.ramp_s + wait + settings.dwell_s(frequency_hz)


def loop_checks_s(
    frequencies_hz: Sequence[float], settings: SweepSettings, known_hz: Sequence[float] = ()
) -> list[float]:
    """Of the loop check before each step, in s: none where the shaker's gain is known from near by."""
    known, found = list(known_hz), []
    for f in frequencies_hz:
        near = any(abs(other / f - 1) < FAR for other in known)
        found.append(0.0 if near else settings.control.ramp_s + _CHECK_BLOCKS * settings.block_s(f))
        known.append(f)
    return found


def _first_bound(block_s: float, decay_1_s: float) -> float:
    # q / (1 - q), without loss of digits where q is nearly 1.
    return float(_SEEN / np.expm1(max(decay_1_s, _SLOWEST_1_S) * block_s))
