"""Steps that tell causes apart: what teaches most about how strong the effects are, all of them at once.

Every effect is an unknown of its expected size beside law, stated numbers and the model's errors. A step is
worth the mutual information between its reading and those unknowns, which counts what separates one from
another and not only what shows:

    I = 1/2 ln det(1 + a C a^T) - 1/2 ln det(1 + a C_0 a^T)

C holds the effects, C_0 is without any. To first order in their strengths.
"""

from collections.abc import Sequence

import numpy as np

from fitting.arrays import Array, Integers
from fitting.planning.choice import with_reading
from fitting.planning.sensitivity import Sensitivity
from fitting.planning.signatures import Signature

_STARTS = 3
"""Of an effect with a place: so many places stand for all."""
_MOST = 5.0
"""Expected sizes in a start's strength: no unknown is looked at where it is not linear any more."""


class Causes:
    """Of one sensitivity and some effects."""

    def __init__(self, s: Sensitivity, signatures: Sequence[Signature]) -> None:
        self._plain = s.rows
        columns = [_columns(s, g) for g in signatures]
        n, m = len(s.prior), sum(c.shape[2] for c in columns)
        self._rows = np.concatenate([s.rows, *columns], axis=2)
        self._prior = np.eye(n + m)
        self._prior[:n, :n] = s.prior
        self._sensitivity = s

    def choose(self, seconds: Array, taken: Array, budget_s: float, most: int | None = None) -> Integers:
        """Candidates for so much rig time beside those taken, as they are chosen. Shapes (candidates,)."""
        count = np.asarray(taken, dtype=float).copy()
        C_0 = self._sensitivity.covariance(count)
        kept = np.flatnonzero(count)
        A = (self._rows[kept] * np.sqrt(count[kept])[:, None, None]).reshape(-1, len(self._prior))
        C = np.linalg.inv(self._prior + A.T @ A)
        order: list[int] = []
        used = 0.0
        while most is None or len(order) < most:
            worth = (_entropy(self._rows, C) - _entropy(self._plain, C_0)) / seconds
            worth[(count > 0) | (used + seconds > budget_s)] = -np.inf
            best = int(np.argmax(worth))
            if not np.isfinite(worth[best]):
                break
            C, C_0 = with_reading(C, self._rows[best]), with_reading(C_0, self._plain[best])
            count[best] += 1
            used += float(seconds[best])
            order.append(best)
        return np.array(order, dtype=np.intp)


def _columns(s: Sensitivity, g: Signature) -> Array:
    """Of one effect in its expected size. Shape (candidates, 2, starts)."""
    chosen = np.unique(np.linspace(0, len(g.starts) - 1, _STARTS).astype(int)) if g.has_place else [0]
    over = np.array([min(g.expected(k), _MOST) * g.moves[k] / s.sigma_m_s for k in chosen])
    return np.ascontiguousarray(np.stack([over.real, over.imag], axis=2).transpose(1, 2, 0))


def _entropy(rows: Array, covariance: Array) -> Array:
    """1/2 ln det(1 + a C a^T) of each candidate. Shape (candidates,)."""
    S = (rows @ covariance) @ rows.transpose(0, 2, 1) + np.eye(2)
    return np.asarray(np.log(np.maximum(np.linalg.det(S), 1.0)) / 2)
