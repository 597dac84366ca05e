"""Readings that a result has set aside, found again among the points of a session."""

from collections.abc import Sequence

import numpy as np

from fitting.data.aside import DISTURBED, INSENSITIVE, LOST, Reasons, reasons
from instrument.facts.rows import PointSetAside
from instrument.stream.derived import PointMeasured

NAME = "set aside, not fitted"
"""Of readings that take no part, in every legend."""
_SAME = 1e-9
"""Relative: what a result has of a reading was computed of the same numbers."""

_WORDS = {
    LOST: "far off the readings beside it: a signal lost, or an overload",
    "mains_hum": "the mains hums there",
    DISTURBED: "in a stretch that a fixture's own resonance disturbs",
    INSENSITIVE: "hardly depends on the core: it shows what the rig does wrong",
}


def words_of(why: str) -> str:
    """Why a reading is set aside, in words; of another package's effect its name."""
    return _WORDS.get(why, why)


def why_aside(points: Sequence[PointMeasured], aside: Sequence[PointSetAside]) -> Reasons:
    """Of every point why it took no part in what `aside` is of; empty where it did. Shape (points,)."""
    why = reasons(np.zeros(len(points), bool), "")
    if not aside:
        return why
    f = np.array([p.frequency_hz for p in points])
    size = np.array([abs(p.velocity_m_s / p.base_m_s2 * p.level_m_s2) for p in points])
    for one in aside:
        why[(f == one.frequency_hz) & np.isclose(size, one.measured_m_s, rtol=_SAME, atol=0)] = one.why
    return why
