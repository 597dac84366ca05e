"""Sweeps, points and sums of several members, one after the other."""

from collections.abc import Sequence

import numpy as np

from fitting.arrays import Array
from fitting.effects.given import Points
from fitting.reduced.rational import RationalSweep
from fitting.sweep import Sweep


def parts_of(sweeps: Sequence[Sweep]) -> list[slice]:
    """Where the points of each are among all of them."""
    ends = np.cumsum([len(s) for s in sweeps])
    return [slice(int(e) - len(s), int(e)) for e, s in zip(ends, sweeps, strict=True)]


def joined(sweeps: Sequence[Sweep]) -> Sweep:
    """All points one after the other; every file's segments are its own, numbered on."""
    segments, last = [], 0
    for s in sweeps:
        _, numbers = np.unique(s.segment, return_inverse=True)
        segments.append(last + 1 + numbers.ravel())
        last = int(segments[-1].max())

    def all_of(name: str) -> Array | None:
        values = [getattr(s, name) for s in sweeps]
        return np.concatenate(values) if all(v is not None for v in values) else None

    return Sweep(
        frequency_hz=np.concatenate([s.frequency_hz for s in sweeps]),
        velocity_m_s=np.concatenate([s.response_m_s for s in sweeps]),
        commanded_m_s2=np.concatenate([s.commanded_m_s2 for s in sweeps]),
        segment=np.concatenate(segments),
        sweep=np.concatenate([s.sweep for s in sweeps]),
        std_m_s=all_of("response_std_m_s"),
        weight=all_of("weight"),
        time_s=all_of("time_s"),
    )


def joined_points(each: Sequence[Points]) -> Points:
    """What is known of all points. Shape (points of all,) each."""
    forces = [p.force_n for p in each if p.force_n is not None]
    shaken = [p for p in each if p.drive == "base"]
    # Where both drive, what is read is asked of those that a base moves.
    first = (shaken or each)[0]
    at_rest = np.concatenate([np.full(len(p.omega), p.drive == "force") for p in each])
    return Points(
        omega=np.concatenate([p.omega for p in each]),
        drive_amplitude=np.concatenate([p.drive_amplitude for p in each]),
        time_s=np.concatenate([p.time_s for p in each]),
        timed=all(p.timed for p in each),
        has_phase=each[0].has_phase,
        reads=first.reads,
        drive=first.drive,
        force_n=np.concatenate(forces) if len(forces) == len(each) else None,
        level_m_s2=_levels(each),
        at_rest=at_rest if 0 < len(shaken) < len(each) else None,
    )


def _levels(each: Sequence[Points]) -> Array | None:
    """What bases did, where one of them did not do what was commanded. Shape (points of all,)."""
    if all(p.level_m_s2 is None for p in each):
        return None
    return np.concatenate([p.drive_amplitude if p.level_m_s2 is None else p.level_m_s2 for p in each])


def side_by_side(each: Sequence[RationalSweep]) -> RationalSweep:
    """One sum over all points about the first one's modulus; terms that a member lacks are zero."""
    G_ref = each[0].G_ref
    terms = max(r.c.shape[1] for r in each)
    c, mu = [], []
    for r in each:
        # 1 + (G - G_r) mu = (1 + (G_0 - G_r) mu) (1 + (G - G_0) mu / (1 + (G_0 - G_r) mu))
        turned = 1 + (G_ref - r.G_ref) * r.mu
        wide = ((0, 0), (0, terms - r.c.shape[1]))
        c.append(np.pad(r.c / turned, wide))
        mu.append(np.pad(r.mu / turned, wide))
    return RationalSweep(
        np.concatenate([r.omega for r in each]), G_ref, np.concatenate(c), np.concatenate(mu)
    )
