"""Single effects: a first look by one linear step, then a full fit of law and unknowns."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fitting.diagnosis.evidence import Evidence
from fitting.diagnosis.refit import ROUGH, Fitted, refit
from fitting.diagnosis.response import Response
from fitting.diagnosis.task import Task
from fitting.effects.base import Effect
from fitting.laws import CoreLaw

Array = NDArray[np.float64]

FOLLOWED, FOLLOWED_PLACES = 2, 4
"""Of an effect's starts, how many are fitted bluntly; of one with a place to be found."""
FINISHED = 2
"""Blunt fits that are followed to the end."""
WRONG = 2.0
"""Chi-square per degree of freedom beyond which the law so far is no place to begin."""
HOPELESS = 30.0
"""Chi-square per degree of freedom that finer grids will not mend."""
_ROUNDS = 3
_FAR = 0.02


def look(task: Task, evidence: Evidence, before: Fitted, effect: Effect) -> list[tuple[float, Array]]:
    """Starts of an effect, scaled by a linear step, with the chi-square each may gain; best first."""
    response = Response(task, [*before.effects, effect], task.coarse)
    plain = Response(task, before.effects, task.coarse)
    law, known = before.law, before.u
    v = plain.velocity(law, known)
    r = before.residuals[: before.data]
    Q, _ = np.linalg.qr(before.jacobian[: before.data])
    lower, upper = effect.limits(response.plate)
    found = []
    for u in effect.starts(response.plate, task.points):
        with np.errstate(all="ignore"):
            moved = response.velocity(law, np.concatenate([known, u])) - v
        s = evidence.jacobian(v, moved[None])[:, 0]
        s = s - Q @ (Q.T @ s)
        size = float(s @ s)
        if not np.isfinite(size) or size <= 0:
            continue
        a = -float(r @ s) / size
        if not effect.unknowns:
            found.append((float(r @ r - (r + s) @ (r + s)), u))
            continue
        one_sided = any(q.neutral is not None and not q.lower < q.neutral < q.upper for q in effect.unknowns)
        if a <= 0 and one_sided:
            found.append((0.0, u))
            continue
        at = np.clip(effect.scaled(u, np.clip(a, -20, 20) or 1e-3), lower, upper)
        found.append((a**2 * size, at))
    return sorted(found, key=lambda f: -f[0])


def fit_with(
    task: Task,
    evidence: Evidence,
    before: Fitted,
    effect: Effect,
    priors: Array,
    starts: Sequence[tuple[float, Array]] | None = None,
    *,
    thorough: bool = False,
) -> Fitted | None:
    """The best fit with one more effect; None where it has nothing to start from.

    `thorough` follows more starts to the end, from the stated law too.
    """
    starts = look(task, evidence, before, effect) if starts is None else starts
    if not starts:
        return None
    effects = [*before.effects, effect]
    plain = effect.starts(task.plate, task.points)[:1] if effect.unknowns else []
    begun = [u for _, u in starts[: FOLLOWED_PLACES if _has_place(effect) else FOLLOWED]]
    near = [(before.law, u) for u in begun]
    # A linear step from a wrong law may lead astray: there a plain start, and the stated law too.
    far = [(law, u) for law in (before.law, task.stated_law) for u in [*plain, *begun[:1]]]
    response = Response(task, effects, task.coarse)
    first = []
    for blunt, tried in ((False, near), (True, far if thorough else [])):
        judged = evidence.blunt() if blunt else evidence
        found = [
            refit(response, judged, law, np.concatenate([before.u, u]), tolerance=ROUGH, priors=priors)
            for law, u in tried
        ]
        first += sorted(found, key=lambda f: f.chi2)[: FINISHED if thorough else 1]
    ends = [polished(task, effects, evidence, f.law, f.u, priors) for f in first]
    return min(ends, key=lambda f: f.chi2)


def blunt_chi2(task: Task, evidence: Evidence, before: Fitted, effect: Effect, priors: Array) -> float:
    """How well an effect does from plain starts in wide valleys: says which are worth going into."""
    response = Response(task, [*before.effects, effect], task.coarse)
    u = effect.starts(task.plate, task.points)[0]
    return min(
        refit(response, evidence.blunt(), law, u, tolerance=ROUGH, priors=priors).chi2
        for law in (before.law, task.stated_law)
    )


def _has_place(effect: Effect) -> bool:
    return any(q.neutral is None and not q.fixed for q in effect.unknowns)


def polished(
    task: Task, effects: Sequence[Effect], evidence: Evidence, law: CoreLaw, u: Array, priors: Array
) -> Fitted:
    """A fit to the end, its grid made for the law it starts from, and again where the law has moved far."""
    for _ in range(_ROUNDS):
        fitted = refit(Response(task.around(law), effects), evidence, law, u, priors=priors)
        if fitted.chi2_per_dof > HOPELESS:
            break
        omega = task.fine.nodes.omega
        moved = np.max(np.abs(fitted.law.modulus(omega) / law.modulus(omega) - 1))
        law, u = fitted.law, fitted.u
        if moved < _FAR:
            break
    return fitted
