"""Before anything is measured: which effects a plan would see, and which it could not tell apart.

Every effect's signature is put over the noise and freed of all that law, bend, stated numbers and the
model's own errors can imitate. What is left, in standard deviations, says how large the effect must be to
be seen; what is left of it beside another effect's signature, how large to be told from that one. To
first order: strong effects are seen no worse than this says, but a place or a frequency that is free
beside the strength imitates more.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.planning.sensitivity import Sensitivity
from fitting.planning.signatures import Signature

SEEN = 4.0
"""Standard deviations from which an effect is seen: a gain of 16 in chi-square, which one in 2000 sweeps
without any effect shows (docs/planning.md)."""
CONFUSED = 3.0
"""Times its size to be seen that an effect must have to be told from another: from here on they are
confused."""
_NOTHING = 1e-9
"""In standard deviations: an effect that changes no reading."""


@dataclass(frozen=True)
class Rival:
    """Another effect that one is mistaken for."""

    name: str
    times: float
    """How many times larger than just seen the effect must be to be told from it; infinite for never."""


@dataclass(frozen=True)
class EffectOutlook:
    """What a plan can say of one effect."""

    name: str
    key: str | None
    """Of the unknown that says how strong it is; None for an effect that is there or not."""
    unit: str | None
    seen_at: float | None
    """Size at which it is seen, at half its places; infinite where nothing of it is left."""
    seen_at_best: float | None
    """The same at the place that shows most."""
    chance_seen: float
    """That it is larger than that, where a laboratory has it: by the prior of its size."""
    rivals: tuple[Rival, ...]
    """From which it must be `CONFUSED` times as large to be told apart, worst first."""


def outlooks(s: Sensitivity, taken: Array, signatures: Sequence[Signature]) -> list[EffectOutlook]:
    """Of a plan with so many readings at each candidate, what is seen best first. Shape (candidates,)."""
    left = [projected(s, taken, g) for g in signatures]
    found = [_outlook(k, signatures, left) for k in range(len(signatures))]
    return sorted(found, key=lambda o: -o.chance_seen)


def projected(s: Sensitivity, taken: Array, signature: Signature) -> Array:
    """What of a signature nothing else imitates, a row a start, over the noise. Shape (starts, any)."""
    kept = np.flatnonzero(taken)
    root = np.sqrt(taken[kept])
    A = (s.rows[kept] * root[:, None, None]).reshape(-1, len(s.prior))
    over = signature.moves[:, kept] * (root / s.sigma_m_s[kept])
    S = np.stack([over.real, over.imag], axis=2).reshape(len(over), -1)
    # The priors are readings too: those of what is zero without the effect.
    L = np.linalg.cholesky(s.prior).T
    J = np.vstack([A, L])
    whole = np.hstack([S, np.zeros((len(S), len(L)))])
    Q, _ = np.linalg.qr(J)
    return np.asarray(whole - (whole @ Q) @ Q.T)


def _outlook(k: int, signatures: Sequence[Signature], left: Sequence[Array]) -> EffectOutlook:
    g, mine = signatures[k], left[k]
    size = np.linalg.norm(mine, axis=1)
    strengths = SEEN / np.maximum(size, _NOTHING)
    order = np.argsort(strengths)
    best, usual = int(order[0]), int(order[len(order) // 2])
    rivals = []
    for other, theirs in enumerate(left):
        if other == k or _is_part(g, signatures[other]):
            continue
        times = np.median([_times(mine[i], theirs, signatures[other].freedom) for i in order])
        if times >= CONFUSED:
            rivals.append(Rival(signatures[other].effect.name, float(times)))
    at = g.sized(usual)
    q = g.effect.parameters[at] if at is not None else None
    chances = [g.chance_above(i, float(strengths[i])) for i in range(len(size))]
    return EffectOutlook(
        g.effect.name,
        q.key if q else None,
        q.unit if q else None,
        g.size(usual, float(strengths[usual])),
        g.size(best, float(strengths[best])),
        float(np.mean(chances)),
        tuple(sorted(rivals, key=lambda r: -r.times)),
    )


def _is_part(one: Signature, other: Signature) -> bool:
    """Whether one effect contains the other: then they are not rivals but more and less of the same."""
    a, b = one.effect, other.effect
    return a.extends == b.name or b.extends == a.name


def _times(mine: Array, theirs: Array, freedom: int) -> float:
    """How many times over what is seen must be to stand out beside the best of another effect's."""
    size = float(np.linalg.norm(mine))
    if size < _NOTHING:
        return np.inf
    rest, basis = mine / size, np.zeros((0, len(mine)))
    norms = np.linalg.norm(theirs, axis=1)
    shapes = theirs[norms > _NOTHING] / norms[norms > _NOTHING, None]
    # As many of its starts together as it has unknowns: a place between two is nearly their sum.
    for _ in range(min(freedom, len(shapes))):
        shapes = shapes - (shapes @ basis.T) @ basis
        long = np.linalg.norm(shapes, axis=1)
        shapes = np.where(long[:, None] > 1e-6, shapes / np.maximum(long, _NOTHING)[:, None], 0.0)
        best = shapes[int(np.argmax(np.abs(shapes @ rest)))]
        basis = np.vstack([basis, best])
        rest = rest - (rest @ best) * best
    return float(1 / max(float(np.linalg.norm(rest)), _NOTHING))
