"""One law, its shifts and the stated numbers fitted to the responses of all temperatures at once.

    chi2 = |whitened readings of all sweeps - prediction|^2 + |hammer test|^2 + |z|^2 + |b|^2

with G*_k(omega) = b_k G*(a_T omega) at temperature k. The plate and its mounting are one, their stated
numbers are counted once; a gain and a delay are each sweep's own, and all may be off alike. A law for each
temperature is fitted to the same with the same plate: what tells both apart is then the material alone.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refit import refit
from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.thresholds import STOPPING
from fitting.effects.base import Effect
from fitting.laws import CoreLaw
from fitting.laws.bent_law import REACH, BentLaw
from fitting.temperature.members import Joined
from fitting.temperature.one_law import OneLaw, OwnLaws
from fitting.temperature.shifted_fit import ShiftedFit
from fitting.temperature.shifts import Shift
from fitting.temperature.start import laws_near, start_of

_SLOW_BY, _REACH_BY = 1.5, 4.0
"""Decades of reduced frequency for each time that a law bends slowly as far as it usually does, and for each
unit of ln f over which such a bend goes on. Of sixty materials that no formula here describes (Havriliak and
Negami's, wide spectra, two relaxations), each beside the nearest fractional Zener, eta is off by 2 % over two
decades, 7 % over 3.5, 10 % over 5, 15 % over 6.5 and 20 % over 8, G' by four tenths of that; two places a
quarter of the decades apart in ln f are alike to 0.6."""
_NARROW = 2.0
"""Decades over which the usual bend is all there is."""
_FAINT, _LEAST = 0.03, 1e-3
"""Loss factor that a material keeps or lacks on a plateau whatever a formula says, of a rubber's size; the
smallest that is told from none."""
FREER = 2.0
"""Times that, where no law bends enough: no material owes a formula anything. A choice."""
_STUCK = 1.0
"""In chi-square: by how much more than one law does a law for each may miss and be at its end. A choice."""
_ROUNDS = 4
"""Of a fit's most evaluations: a bound on time; what has not come to its end by then says so."""


@dataclass(frozen=True)
class TemperatureProblem:
    """All members side by side, and how their temperatures shift one law."""

    joined: Joined
    shift: Shift
    vertical: bool
    begin: OneLaw | None = None
    """Where the fit of one law starts, where that is known."""

    @property
    def evidence(self) -> Evidence:
        """What all readings are worth."""
        return self.joined.evidence

    @property
    def points(self) -> tuple[int, ...]:
        """How many points each member has."""
        return self.joined.lengths

    @property
    def bands_hz(self) -> list[tuple[float, float]]:
        """Lowest and highest frequency of each member."""
        return self.joined.bands_hz

    def near(self, laws: Sequence[CoreLaw]) -> "TemperatureProblem":
        """The problem, the model's error asked where one law through the laws of each lies."""
        begin = self.one_law(laws)
        return replace(self, joined=self.joined.erring_at(begin), begin=begin)

    def erring_at(self, law: OneLaw) -> "TemperatureProblem | None":
        """The problem, the model's error asked at a law found; None of sweeps, not asked again."""
        joined = self.joined.erring_at(law)
        return replace(self, joined=joined, begin=law) if joined is not self.joined else None

    def one_law(self, laws: Sequence[CoreLaw]) -> OneLaw:
        """One law that lies near those of each temperature by itself: where the fit starts."""
        if self.begin is not None:
            return self.begin
        shift, bands = self.shift, self.bands_hz
        plain, log_a = start_of(laws, bands, shift.temperature_c, shift.reference_c)
        p = shift.near(log_a)
        law: CoreLaw = plain
        if not self.joined.exact:
            a = np.exp(shift.log_shift(p))
            reduced = np.array([f * k for b, k in zip(bands, a, strict=True) for f in b])
            decades = float(np.log10(reduced.max() / reduced.min()))
            slow = decades / _SLOW_BY if decades > _NARROW else 0.0
            reach = max(REACH, decades / _REACH_BY)
            law = _with_faint_losses(BentLaw.over(plain, reduced, slow=slow, slow_reach=reach))
        b = (1.0,) * (shift.moved_count if self.vertical else 0)
        as_stated = (1.0,) * (len(self.points) if shift.moves_temperatures else 0)
        return OneLaw(law, shift, tuple(shift.positive(p).tolist()), self.points, b, as_stated)

    def fitted(self, law: CoreLaw, z: Array, effects: Sequence[Effect] = ()) -> Refitted:
        """The best fit that is found from a law and its unknowns.

        `z` of shape (unknowns,): the stated numbers, then those of the effects.
        """
        response = self.joined.around(law).response(effects)
        for _ in range(_ROUNDS):
            found = refit(response, self.evidence, law, z)
            law, z = found.law, found.u
            if found.converged or found.chi2_per_dof > STOPPING.hopeless_chi2_per_dof:
                break
        return found

    def both(self, one: Refitted, own: Refitted) -> ShiftedFit:
        """One law and a law for each side by side: a law for each can do whatever one law does.

        Where it does worse its fit is stuck, and begins again from the one law at each temperature.
        """
        joint, each = one.law, own.law
        if own.chi2 <= one.chi2 + _STUCK or not isinstance(joint, OneLaw) or not isinstance(each, OwnLaws):
            return ShiftedFit(one, own, self.joined)
        laws = tuple(laws_near(joint, each.laws, self.bands_hz))
        again = self.fitted(replace(each, laws=laws), one.u, one.effects)
        return ShiftedFit(one, min(own, again, key=by_chi2), self.joined)

    def freer(self, fit: ShiftedFit) -> ShiftedFit | None:
        """A fit of one law that may bend further than in `fit`; None where it may not bend."""
        joint = fit.joint
        if not isinstance(joint.law, BentLaw):
            return None
        start = replace(joint, law=joint.law.freer(FREER))
        one = self.fitted(start, fit.one.u, fit.one.effects)
        return ShiftedFit(one, fit.own, fit.joined)

    def stated(self, each: Sequence[Array]) -> Array:
        """The mean of what members say by themselves of the stated numbers. Shape (numbers,)."""
        total, count = np.zeros(len(self.joined.each)), np.zeros(len(self.joined.each))
        for z, at in zip(each, self.joined.places, strict=True):
            total[at] += z
            count[at] += 1
        return total / count


def _with_faint_losses(bent: BentLaw) -> BentLaw:
    """The same, freer in eta where its law has next to none: on a plateau a formula's loss vanishes.

    None of few decades, where it does not.
    """
    if not bent.slow:
        return bent
    _, eta = bent.law.storage_and_loss(2 * np.pi * np.array(bent.knots_hz))
    return replace(bent, faint=tuple((1 + _FAINT / np.maximum(eta, _LEAST)).tolist()))


def fit_shifted(
    problem: TemperatureProblem,
    laws: Sequence[CoreLaw],
    z: Array,
    effects: Sequence[Effect] = (),
    u: Array | None = None,
) -> ShiftedFit:
    """One law and a law for each, from the laws and numbers that each temperature has by itself.

    Shapes: `z` (stated numbers,), `u` (unknowns of `effects`,).
    """
    start = np.concatenate([z, np.empty(0) if u is None else u])
    own = problem.fitted(OwnLaws(tuple(laws), problem.points), start, effects)
    one = problem.fitted(problem.one_law(laws), start, effects)
    return problem.both(one, own)
