"""Which measurement would tell the explanations of a sweep apart, for its noise and its cost."""

from dataclasses import dataclass, field

import numpy as np

from fitting.gravity import PUBLISHED_G_M_S2
from fitting.sweep import Sweep
from instrument.facts.follow_up import FollowUp
from instrument.models.diagnosis import Diagnosed
from instrument.planning.costs import step_seconds
from instrument.stepped_sine.settings import SweepSettings

__all__ = ["FollowUp", "Possible", "rank_follow_ups"]

HANDS_S = {"spot": 120.0, "added_mass": 180.0}
"""Of a person's time. A choice."""
_SETTLED_BY = 0.003
"""Loss of a pole where none is known: half the loss factor of bare metal."""


@dataclass(frozen=True)
class Possible:
    """What can be done on this rig."""

    settings: SweepSettings = field(default_factory=SweepSettings)
    hands: bool = True
    """Whether somebody is there."""


def rank_follow_ups(
    diagnosed: Diagnosed, sweep: Sweep, possible: Possible | None = None
) -> tuple[FollowUp, ...]:
    """Next measurements, best first; none where one explanation is left.

    `sweep` is the whole one that was diagnosed.
    """
    possible = possible or Possible()
    rivals = diagnosed.result.rivals
    if rivals is None or len(rivals.each) < 2:
        return ()
    time = sweep.time_s if sweep.time_s is not None else sweep.frequency_hz
    order = np.argsort(-time, kind="stable")
    f, segments = sweep.frequency_hz[order], sweep.segment[order]
    poles = np.asarray(np.unique(f) * (1 + 1j * _SETTLED_BY), dtype=complex)
    seconds = float(step_seconds(f, poles, possible.settings).sum())
    level = float(sweep.commanded_m_s2.max()) / PUBLISHED_G_M_S2
    return (
        FollowUp(
            kind="reversed",
            needs_hands=False,
            frequencies_hz=tuple(f.tolist()),
            segments=tuple(segments.tolist()),
            level_g=level,
            seconds=seconds,
            separation=0.0,
            probability_resolved=0.0,
            between=rivals.names,
            why="What drifts in time is not what varies over frequency.",
            todo="Sweep the same steps backwards.",
        ),
    )
