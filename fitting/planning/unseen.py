"""What a sweep could not have seen: effects that law and stated numbers imitate, and what they do to the law.

A verdict that names nothing says that nothing shows, not that nothing is there. An effect that the model
lacks changes the readings by w (whitened). The fit follows it by

    -(J^T J)^-1 J^T w

which shifts the law, and leaves w - J (J^T J)^-1 J^T w, which is all that could give it away. To first order
in the effect's size.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.verdict.result import Rivals
from fitting.effects.base import Effect
from fitting.planning.aims import Aims
from fitting.planning.confusion import SEEN
from fitting.planning.signatures import Signature, signatures_of

_MATTERS = 2.0
"""Standard errors of the band by which it must shift G' or eta: less lies within the 95 % band."""
_NOTHING = 1e-9
"""In standard deviations: an effect of which nothing is left."""


@dataclass(frozen=True)
class Unseen:
    """An effect that may be there without being named."""

    name: str
    chance: float
    """That a laboratory's set-up has it at all, before any data."""
    key: str | None
    """Of the unknown that says how strong it is; None for an effect that is there or not."""
    unit: str | None
    size: float | None
    """The largest that would not be seen, no larger than it is expected to be where a laboratory has it."""
    storage_modulus: float
    """By what share it would shift G', where in the band it shifts it most."""
    loss_factor: float
    """The same share of eta."""
    errors: float
    """The larger of both, in standard errors of the band there."""


def unseen(rivals: Rivals, effects: Sequence[Effect]) -> list[Unseen]:
    """Beside the likeliest explanation: what shifts the law by more than its 95 % band, worst first."""
    fitted, _ = rivals.each[0]
    asked = others(fitted, effects)
    signatures = signatures_of(rivals.problem, fitted.law, fitted.u, asked, beside=fitted.effects)
    return worst_first(signatures, rivals.evidence, fitted, rivals.problem.sweep.frequency_hz)


def others(fitted: Refitted, effects: Sequence[Effect]) -> list[Effect]:
    """Those that are in a fit in no form: what contains an effect of it, or is contained in it, is one."""
    there = {e.name for e in fitted.effects} | {e.extends for e in fitted.effects} - {None}
    return [e for e in effects if e.name not in there and e.extends not in there]


def worst_first(
    signatures: Sequence[Signature], evidence: Evidence, fitted: Refitted, frequency_hz: Array
) -> list[Unseen]:
    """What shifts the law by more than its 95 % band over the frequencies. Shape (any,)."""
    aims = Aims.over(fitted.law, float(frequency_hz.min()), float(frequency_hz.max()))
    found = [one for s in signatures if (one := _of(s, evidence, fitted, aims)) is not None]
    return sorted(found, key=lambda one: -one.errors)


def _of(s: Signature, evidence: Evidence, fitted: Refitted, aims: Aims) -> Unseen | None:
    """At the middle one of its places, by what it does there; None where that does not matter."""
    usual = np.array([s.expected(k) for k in range(len(s.starts))])
    left, steps = _followed(s, evidence, fitted)
    strengths = np.minimum(usual, SEEN / np.maximum(left, _NOTHING))
    shifts = np.einsum("qfi,si->sqf", aims.gradient, steps[:, : aims.gradient.shape[2]])
    shifts = np.abs(shifts) * strengths[:, None, None]
    errors = np.max(shifts / aims.errors(fitted.covariance), axis=(1, 2))
    at = int(np.argsort(errors)[len(errors) // 2])
    if errors[at] < _MATTERS or (s.sized(at) is None and strengths[at] < 1):
        return None
    k = s.sized(at)
    q = None if k is None else s.effect.parameters[k]
    by_G, by_eta = np.max(shifts[at], axis=1)
    return Unseen(
        s.effect.name,
        s.effect.chance,
        q.key if q else None,
        q.unit if q else None,
        s.size(at, float(strengths[at])),
        float(by_G),
        float(by_eta),
        float(errors[at]),
    )


def _followed(s: Signature, evidence: Evidence, fitted: Refitted) -> tuple[Array, Array]:
    """What is left of it in standard deviations, and how the fitted numbers follow it.

    Shapes (starts,), (starts, columns of the fit's Jacobian).
    """
    J, kept = fitted.weighted()
    W = np.zeros((len(s.starts), len(J)))
    for row, u, moved in zip(W, s.starts, s.moves, strict=True):
        of_sweep = evidence.jacobian(fitted.velocity_m_s, moved[None])[:, 0]
        of_bare_plate = evidence.bare_moves(s.effect, u)
        row[: len(of_sweep)] = of_sweep
        row[len(of_sweep) : len(of_sweep) + len(of_bare_plate)] = of_bare_plate
    steps = np.zeros((len(W), len(kept)))
    steps[:, kept] = -np.linalg.lstsq(J, W.T, rcond=None)[0].T
    return np.linalg.norm(W + steps[:, kept] @ J.T, axis=1), steps
