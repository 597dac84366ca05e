"""The kin of an explanation: what does almost the same, and is in no catalogue.

That an effect fits says how well its formula holds only as far as the readings show it: what hardly stands
out is as well explained by anything of about its kind. So beside an explanation stands all that does the same
but for a share eps of it: every resonance somewhat elsewhere, losing somewhat more or less, every segment
read by somewhat more or less, in no direction rather than another. A shear pair's one resonance is the law's:
its kin is read by somewhat more or less in every stretch of frequencies.

With d the whitened changes of the readings by these, one a column, in proportions to each other that are
given, P onto what the explanation's own law and unknowns do, r the residual, S the chi-square explained,

    A = d^T (1 - P) d,   b = d^T r,   s^2 = eps^2 S / tr A,
    Z_kin / Z = det(1 + s^2 A)^(-1/2) exp(s^2 b^T (1 + s^2 A)^-1 b / 2)

Weak effects have kin as likely as themselves; of strong ones that fit well none is left.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex, Mask
from fitting.diagnosis.inference.marginal import prior_precision
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.narrow_resonances import BESIDE, loss_of, with_sides
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.diagnosis.search.catalogue_search import ScoredFit, Search
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.several.several_response import SeveralResponse
from fitting.diagnosis.thresholds import KIN, VERDICT
from fitting.laws import CoreLaw
from fitting.nuisances.narrow import NarrowResonance, NarrowResonances
from fitting.reduced.resonance_parts import RealMode, modes_between
from fitting.specimen import Kind
from fitting.widened.enriched_plate import EnrichedReducedPlate

UNLISTED = "unlisted"
"""Its name beside those of effects."""
FREQUENCY, LOSS, _GAIN = 0.01, 0.1, 0.03
"""What a cause does to a resonance, to its loss factor and to the gain of a segment, relative: where effects
of the catalogue show, these go together. Only their proportions count."""
HAVE_MODES: tuple[Kind, ...] = ("plate", "beam")
"""Kinds of specimens with resonances besides the one that the core's modulus places."""
_STRETCH = np.log(2) / 3
"""In ln f: of a third of an octave, as wide as what a resonance of a fixture or of a mass's rocking disturbs
where it loses a tenth. A choice."""
_AT = 1e-6
"""Share of a number: nearer to its limit it may not move. Of the number itself, unlike in `verdict.stage` and
`search.stand_in`: a small one beside a limit of zero has room for more of its own size."""
_MOST = 600.0
"""Of a logarithm of odds: numbers end there."""
_Rows = dict[tuple[int, int], Complex]
"""Changes of the readings: by number of mode or segment, and which of its two. Shape (points,) each."""
_TINY = 1e-12
"""Where nothing is there to divide by."""


@dataclass(frozen=True, eq=False)
class Kin:
    """The kin of one explanation, and how likely it is."""

    odds: float
    """Over the explanation itself, chances counted in."""
    moved: Array
    """How far it has the logarithms of the law's parameters from there. Shape (parameters,)."""
    wider: Array
    """Covariance, beyond the explanation's own, of all its columns. Shape (columns, columns)."""
    along: Array
    """How far it goes along each direction. Shape (directions,)."""
    another_cause: float = 0.0
    """The chance that its share is one of another thing."""
    leaves: float = float("nan")
    """Chi-square of the readings, as far as they are linear."""

    def law(self, fitted: Refitted) -> CoreLaw:
        """Its own, within the limits of laws."""
        low, high = fitted.law.log_limits
        return fitted.law.with_logs(np.clip(np.log(fitted.law.values) + self.moved, low, high))


@dataclass(frozen=True, eq=False)
class Unlisted(ScoredFit):
    """The kin of some explanations together: one more explanation, never named."""

    of: tuple[tuple[ScoredFit, Kin, float], ...] = ()
    """Explanations with their kin and shares that add up to one, the likeliest kin first."""

    @property
    def chi2_per_dof(self) -> float:
        """Chi-square per degree of freedom that the likeliest kin leaves."""
        (first, kin, _), *_ = self.of
        dof = first.fitted.data - first.fitted.parameter_count
        return kin.leaves / dof if dof > 0 else float("nan")

    def weighing(self, none: ScoredFit) -> list[tuple[ScoredFit, float]]:
        """Explanations whose laws stand for its own, and their weights.

        While it is the explanation with a slightly different formula, the law stays near. A different cause
        may leave the law anywhere: half of its weight goes to the law without any effect.
        """
        back = sum(part * kin.another_cause for _, kin, part in self.of) / 2
        return [(none, back), (self, 1 - back)]

    @property
    def names(self) -> tuple[str, ...]:
        """Name of the cause in no catalogue, as effects have theirs."""
        return (UNLISTED,)


def kin_of(search: Search, fitted: Refitted, temper: float) -> Kin | None:
    """Kin of an explanation with effects; None where the noise is not known.

    `temper` as `marginal.cost` takes it.
    """
    problem = search.problem
    if not search.evidence.scale_known:
        return None
    none = search.none.fitted
    return kin_along(none, fitted, problem.plate, lambda: _directions(search, fitted), temper)


def kin_along(
    none: Refitted,
    fitted: Refitted,
    plate: EnrichedReducedPlate,
    directions: Callable[[], Array],
    temper: float,
) -> Kin | None:
    """Kin of an explanation from its fit, and from that without effects, `none`.

    `directions` computes whitened changes of the readings by which kin differs: shape (data, any). None
    where the effects' own formulas are no better than kin.
    """
    loose = KIN.beyond_formula * np.sqrt(
        max((max(VERDICT.formula_share, e.unexplained_share) for e in fitted.effects), default=1.0)
    )
    shares = [eps for eps in KIN.shares if eps > loose]
    if not shares:
        return None
    kept = _inside(fitted, plate)
    d = directions() / np.sqrt(temper)
    J, r = fitted.jacobian[:, kept].copy(), fitted.residuals.copy()
    J[: fitted.data] /= np.sqrt(temper)
    r[: fitted.data] /= np.sqrt(temper)
    H = J.T @ J + np.diag(prior_precision(fitted, plate)[kept])
    C = _inverse(H)
    # Where a fit ends before its end, what is left to its own unknowns is no one else's.
    left, of_data = r - J @ (C @ (J.T @ r)), J[: fitted.data]
    explained = max(0.0, none.chi2 - fitted.chi2) / temper
    by = of_data.T @ d
    found = weighed(C, by, d.T @ d, d.T @ left[: fitted.data], explained, shares)
    still = left[: fitted.data] + d @ found.along - of_data @ (C @ (by @ found.along))
    every = np.zeros(len(kept)), np.zeros((len(kept), len(kept)))
    every[0][kept], every[1][np.ix_(kept, kept)] = found.moved, found.wider
    moved, wider = every[0][: len(fitted.law.names)], every[1]
    return replace(found, moved=moved, wider=wider, leaves=temper * float(still @ still))


def _inside(fitted: Refitted, plate: EnrichedReducedPlate) -> Mask:
    """Which columns of a fit are of what may move: not at a limit. Shape (columns,)."""
    kept = fitted.weighted()[1]
    inside = np.ones(len(fitted.u), bool)
    for effect, own in fitted.each():
        low, high = effect.limits(plate)
        u, size = fitted.u[own], np.maximum(np.abs(fitted.u[own]), _TINY)
        inside[own] = (u - low > _AT * size) & (high - u > _AT * size)
    of_unknowns = inside[fitted.free]
    kept[len(kept) - len(of_unknowns) :] &= of_unknowns
    return kept


def _inverse(H: Array) -> Array:
    size = np.sqrt(np.diag(H))
    return np.asarray(np.linalg.inv(H / np.outer(size, size) + _TINY * np.eye(len(H))) / np.outer(size, size))


def weighed(C: Array, by: Array, dd: Array, b: Array, explained: float, shares: Sequence[float]) -> Kin:
    """By the formula above, for shares as likely as each other; `explained` is S.

    `C` is the covariance of what was fitted, `by` products of its columns with d, `dd` those of d among
    themselves. Shapes (columns, columns), (columns, directions), (directions, directions) and (directions,).
    """
    A = dd - by.T @ C @ by
    A = (A + A.T) / 2
    every, along, more = list[float](), list[Array](), list[Array]()
    for eps in shares:
        s2 = eps**2 * explained / max(float(np.trace(A)), _TINY)
        M = np.linalg.inv(np.eye(len(A)) + s2 * A)
        every.append(float(np.linalg.slogdet(M)[1] + s2 * b @ M @ b) / 2)
        along.append(-s2 * M @ b)
        more.append(s2 * C @ by @ M @ by.T @ C)
    logs = np.array(every)
    share = np.exp(logs - logs.max())
    odds = KIN.chance / (1 - KIN.chance) * float(np.exp(min(logs.max(), _MOST)) * share.mean())
    share /= share.sum()
    x = np.array(along)
    # What else was fitted makes room for it.
    moved = -x @ by.T @ C
    off = moved - share @ moved
    wider = np.tensordot(share, np.array(more), 1) + (off.T * share) @ off
    return Kin(odds, share @ moved, wider, share @ x, float(share @ (np.array(shares) >= KIN.another_cause)))


def _directions(search: Search, fitted: Refitted) -> Array:
    """Whitened changes of the readings by each resonance's place and loss, each segment's gain and phase.

    A resonance of a plate is off alike in all its files. Of a shear pair by each stretch's gain and phase.
    Shape (data, any).
    """
    problem, whole = search.problem, response_of(search.problem, fitted.effects)
    if isinstance(whole, SeveralResponse):
        files, plates, parts = (
            list(whole.each(fitted.law, fitted.u)),
            whole.problem.plates,
            whole.problem.starts_at,
        )
    else:
        files, plates, parts = [(whole, fitted.law, fitted.u)], (0,), [slice(0, len(problem.sweep))]
    v, found = np.zeros(len(problem.sweep), complex), dict[tuple[int, ...], Complex]()
    for k, ((response, law, u), plate, part) in enumerate(zip(files, plates, parts, strict=True)):
        has_modes = response.problem.specimen.kind in HAVE_MODES
        v[part], by_modes, by_gains = (_of_one if has_modes else _of_pair)(response, law, u)
        own = {(0, plate, *key): row for key, row in by_modes.items()}
        own |= {(1, k, *key): row for key, row in by_gains.items()}
        for key, row in own.items():
            found.setdefault(key, np.zeros(len(v), complex))[part] += row
    return search.evidence.jacobian(v, np.array(list(found.values())).reshape(-1, len(v)))


def _of_one(response: SweepResponse, law: CoreLaw, u: Array) -> tuple[Complex, _Rows, _Rows]:
    """What one file reads, and its changes: by mode and place or loss, by segment and gain or phase.

    Shape (points,) each, of `u` (unknowns,).
    """
    problem, stated = response.problem, response.problem.nuisances
    own, modes, known = problem.plate.take([]), _modes(problem, law), stated.narrow
    narrow = {one.number: one for one in known.each}
    free = NarrowResonances(tuple(narrow.get(m.number + 1) or _free(loss_of(own, m, law), m) for m in modes))
    # Narrow resonances stay where they were found.
    others = len(stated) - len(known.numbers)
    found = dict(zip((n.name for n in known.numbers), u[others : len(stated)], strict=True))
    at = [found.get(n.name, 0.0) for n in free.numbers]
    fewer = replace(stated, each=stated.each[:others], narrow=NarrowResonances())
    plate = with_sides(problem.plate, [2 * np.pi * m.frequency_hz * m.shape for m in modes])
    asked = replace(problem, plate=plate, nuisances=fewer.with_narrow(free)).around(law)
    v, dv = response_of(asked, response.effects).with_derivatives(
        law, np.concatenate([u[:others], at, u[len(stated) :]])
    )
    by_modes, first = _Rows(), len(law.names) + others
    for k, one in enumerate(free.each):
        by_place, by_loss = dv[first + 2 * k : first + 2 * k + 2]
        by_modes[one.number, 0] = FREQUENCY / one.by_itself * by_place
        by_modes[one.number, 1] = LOSS * one.loss / max(one.loss_by_itself, _TINY) * by_loss
    return v, by_modes, _by_gains(problem, v, problem.sweep.segment)


def _of_pair(response: SweepResponse, law: CoreLaw, u: Array) -> tuple[Complex, _Rows, _Rows]:
    """The same of a shear pair: no mode, and stretches in the place of segments. `u` of shape (unknowns,)."""
    problem, v = response.problem, response.velocity(law, u)
    f = problem.sweep.frequency_hz
    return v, _Rows(), _by_gains(problem, v, np.floor(np.log(f / f.min()) / _STRETCH).astype(int))


def _by_gains(problem: DiagnosisProblem, v: Complex, group: NDArray[np.int_]) -> _Rows:
    """By each group's gain and phase. Shape (points,) of all."""
    found = _Rows()
    for number in np.unique(group):
        found[int(number), 0] = _GAIN * v * (group == number)
        if problem.points.has_phase:
            found[int(number), 1] = 1j * found[int(number), 0]
    return found


def _modes(problem: DiagnosisProblem, law: CoreLaw) -> list[RealMode]:
    """Of the structure without any effect, those in a segment and beside it."""
    own, found = problem.plate.take([]), dict[int, RealMode]()
    for number in np.unique(problem.sweep.segment):
        f = problem.sweep.frequency_hz[problem.sweep.segment == number]
        for mode in modes_between(own, law, float(f.min()) / BESIDE, float(f.max()) * BESIDE):
            found.setdefault(mode.number, mode)
    return [found[number] for number in sorted(found)]


def _free(loss: float, mode: RealMode) -> NarrowResonance:
    return NarrowResonance(mode.number + 1, mode.frequency_hz, FREQUENCY, 0.0, loss, LOSS * loss, 0.0)
