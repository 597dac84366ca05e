"""Files that look like pieces of one sweep: as several each would get a gain and a delay of its own."""

from collections.abc import Hashable, Sequence
from pathlib import Path

import numpy as np

from fitting.sweep import Sweep

_SHOWN = 4


def looks_cut(paths: Sequence[Path], sweeps: Sequence[Sweep], specimens: Sequence[Hashable]) -> str:
    """One line of files of one specimen and spot whose bands share no frequency; empty where there are none.

    `specimens`: what tells a file's from another's, None for a session's own.
    """
    each = list(zip(paths, sweeps, specimens, strict=True))
    for path, sweep, specimen in each:
        like = [
            (p, s) for p, s, of in each if of == specimen and of is not None and _spots(s) == _spots(sweep)
        ]
        apart = [(p, s) for p, s in like if p == path or not _overlap(s, sweep)]
        if len(apart) > 1 and len(apart) == len(like):
            named = ", ".join(p.name for p, _ in apart[:_SHOWN]) + (", ..." if len(apart) > _SHOWN else "")
            return (
                f"{named}: of one specimen, in bands that do not overlap: where these are one sweep, give it "
                "as one file, or each gets a gain and a delay of its own"
            )
    return ""


def _spots(sweep: Sweep) -> frozenset[int]:
    return frozenset() if sweep.pickup is None else frozenset(sweep.pickup.tolist())


def _overlap(one: Sweep, other: Sweep) -> bool:
    """Whether a segment of one reaches into a segment of the other."""
    return any(a <= d and c <= b for a, b in _bands(one) for c, d in _bands(other))


def _bands(sweep: Sweep) -> list[tuple[float, float]]:
    """Ends of each segment, in Hz."""
    each = [sweep.frequency_hz[sweep.segment == number] for number in np.unique(sweep.segment)]
    return [(float(f.min()), float(f.max())) for f in each]
