"""The joint fit without any effect: law, stated numbers, model error and hammer test in one posterior.

`identify` reports it, `diagnose` begins with it.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from fitting.arrays import Array, Complex
from fitting.data.noise import Noise
from fitting.diagnosis.executor import ALONE, Executor
from fitting.diagnosis.inference.evidence import BareModes, Evidence
from fitting.diagnosis.inference.refit import ROUGH, refit
from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.inference.usual_law import followed, followed_to_convergence, polished, within_search
from fitting.diagnosis.inference.wide_valley import in_wide_valley, with_stated
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.model_error import model_error
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.thresholds import STOPPING
from fitting.identification.direct import fit_direct
from fitting.identification.fit import Fit
from fitting.identification.model import SweepModel
from fitting.identification.residuals import Residuals
from fitting.laws import CoreLaw
from fitting.laws.bent_law import BentLaw
from fitting.numerics.chances import chi2_above
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.widened.enriched_plate import EnrichedReducedPlate

_FAR = 0.1
"""Relative change of the modulus from which the grids and the model's error are made anew."""
_THE_SAME = 1.0
"""Rough fits from two starts count as the same minimum below this difference in chi-square: one standard
error is worth as much."""
_ROUNDS, _SETTLING = 3, 4
"""Bounds on time: rounds in all, and those that a law that swings may have beside them."""
_BY_CHANCE, _MUCH = 1e-4, 3.0
"""Probability below which noise alone does not leave as much; chi-square per degree of freedom above which it
is a cause to be found that moves the law, not how readings are weighed. Choices."""
_SETTLED = 0.5
"""In standard errors: a law that a round moves by less has settled. A choice."""


@dataclass(frozen=True)
class Begun:
    """Result of the joint fit without effects, from which everything else starts."""

    problem: DiagnosisProblem
    """Its grids made for the law found, its plate condensed."""
    plate: EnrichedReducedPlate
    """As it was given: on the reduced plate's columns."""
    evidence: Evidence
    none: Refitted
    first: Fit
    """By the law alone, the plate as stated: how the start was found."""
    is_clear: bool
    """Whether all starts led to one law that explains the readings: there is no other to look for."""


def begin(
    problem: DiagnosisProblem,
    reduced: ReducedPlate | None,
    noise: Noise,
    bare: BareModes | None,
    start: CoreLaw,
    executor: Executor = ALONE,
    *,
    to_its_end: bool = True,
) -> Begun:
    """The fit without any effect, and the evidence all candidates are judged by.

    `to_its_end`: as far as is reported; else as far as a search begins from, which follows it if it matters.
    """
    sweep, points = problem.sweep, problem.points
    start = start.to_fit(sweep.frequency_hz)
    model = SweepModel(
        problem.rational, np.arange(len(sweep)), sweep.commanded_m_s2, points.reads, points.at_rest
    )
    first = fit_direct(Residuals.of(sweep, noise, model), start)
    begun = _Beginning(reduced, noise, bare, start, model, first, executor).in_rounds(problem)
    if to_its_end:
        return ended(begun, executor)
    if begun.none.chi2_per_dof < STOPPING.wrong_law_chi2_per_dof:
        return replace(begun, none=followed_to_convergence(begun.problem, begun.evidence, begun.none))
    return begun


def ended(begun: Begun, executor: Executor = ALONE) -> Begun:
    """The same, its fit followed as far as is reported."""
    follow = followed_to_convergence if begun.is_clear else partial(followed, executor=executor)
    return replace(begun, none=follow(begun.problem, begun.evidence, begun.none))


@dataclass(frozen=True)
class _Beginning:
    """One joint fit without effects: what it is begun with."""

    reduced: ReducedPlate | None
    noise: Noise
    bare: BareModes | None
    start: CoreLaw
    """As stated."""
    model: SweepModel
    first: Fit
    executor: Executor

    def in_rounds(self, problem: DiagnosisProblem) -> Begun:
        """Until grids and the model's error are those of the law found."""
        inside = within_search(self.first.law, problem.sweep.omega)
        # A fit of the law alone may end at its limits because stated numbers are slightly wrong.
        at_limits = inside is not self.first.law
        laws = [_free_to_bend(problem, law) for law in ((self.first.law, inside) if at_limits else (inside,))]
        problem = problem.with_narrow(laws[0])
        law, u, meets = laws[0], problem.as_stated, False
        v = self.model.velocity(law)
        for round in range(_ROUNDS):
            here = problem.condensed(law).around(law)
            about, evidence = law, self._evidence(here, law, u, v)
            if len(laws) > 1:
                law, u, meets = _best_of(here, evidence, laws, u)
                laws = [law]
            none = polished(here, (), evidence, law, u)
            is_clear = meets and none.chi2_per_dof < STOPPING.explained_chi2_per_dof
            is_far = at_limits or none.chi2_per_dof > STOPPING.wrong_law_chi2_per_dof
            if round == 0 and not is_clear and is_far:
                # The law alone did what tolerances might do, and led to a valley of its own.
                stated = _free_to_bend(problem, self.start)
                none = _from_elsewhere(here, evidence, stated, none, self.executor)
            moved = _moved(problem, law, none.law)
            law, u = none.law, none.u
            if moved < _FAR and not (problem.errs_as_found and round == 0):
                break
            v = self.model.velocity(law)
            if problem.errs_as_found:
                problem, v = problem.as_found(none.z), none.velocity_m_s
        begun = Begun(here, problem.plate, evidence, none, self.first, is_clear)
        return self._settled(problem, begun, about) if _leaves_somewhat_more(none) else begun

    def _settled(self, problem: DiagnosisProblem, begun: Begun, about: CoreLaw) -> Begun:
        """Where the law no longer depends on which law the model's error is that of.

        Where the model leaves more than chance does, the law goes by how readings are weighed, and may swing
        from round to round by many of its standard errors: the error is then that of all laws on the way,
        their mean covariance. `about`: the law that it is of so far.
        """
        known = [begun.evidence]
        for _ in range(_SETTLING):
            none = begun.none
            if _off_in_errors(problem, about, none) < _SETTLED:
                break
            about, v = none.law, self.model.velocity(none.law)
            if problem.errs_as_found:
                problem, v = problem.as_found(none.z), none.velocity_m_s
            here = problem.condensed(about).around(about)
            known.append(self._evidence(here, about, none.u, v))
            evidence = known[-1].with_errors_of(known)
            found = polished(here, (), evidence, about, none.u)
            begun = replace(begun, problem=here, evidence=evidence, none=found)
        return begun

    def _evidence(self, here: DiagnosisProblem, law: CoreLaw, u: Array, v: Complex) -> Evidence:
        """With the model's error about a law and what it gives, shape (points,), in m/s."""
        sweep = here.sweep
        error = model_error(here, self.reduced, law, v)
        evidence = Evidence.of(sweep, self.noise, error, v, self.bare)
        return evidence if self.noise.is_known or not len(u) else _sized(evidence, self.first, law)


def _best_of(
    problem: DiagnosisProblem, evidence: Evidence, laws: Sequence[CoreLaw], u: Array
) -> tuple[CoreLaw, Array, bool]:
    """Law and stated numbers of the best rough fit from several laws, and whether all came to one end."""
    rough = response_of(problem, (), problem.coarse)
    fits = [refit(rough, evidence, one, u, tolerance=ROUGH) for one in laws]
    best = min(fits, key=by_chi2)
    return best.law, best.u, _are_one(fits)


def _moved(problem: DiagnosisProblem, law: CoreLaw, to: CoreLaw) -> float:
    """The largest relative change of the modulus, at the frequencies of the coarse grid."""
    omega = problem.coarse.nodes.omega
    return float(np.max(np.abs(to.modulus(omega) / law.modulus(omega) - 1)))


def _off_in_errors(problem: DiagnosisProblem, law: CoreLaw, none: Refitted) -> float:
    """How far a law is from the one that was found, at the most, in standard errors of the latter's.

    Of ln |G*| and of its phase, at the frequencies of the coarse grid.
    """
    omega, found = problem.coarse.nodes.omega, none.law
    ratio = np.log(law.modulus(omega) / found.modulus(omega))
    slopes = found.jacobian(omega) * found.values[:, None] / found.modulus(omega)
    off, by = np.concatenate([ratio.real, ratio.imag]), np.hstack([slopes.real, slopes.imag])
    of_law = slice(len(found.names))
    variance = np.einsum("kp,kl,lp->p", by, none.covariance[of_law, of_law], by)
    known = variance > 0
    return float(np.max(np.abs(off[known]) / np.sqrt(variance[known]), initial=0.0))


def _leaves_somewhat_more(none: Refitted) -> bool:
    """Whether it leaves more than noise does by itself, and yet no more than instruments that wander do."""
    dof = none.data - none.parameter_count
    if not none.noise_known or dof < 1 or none.chi2_per_dof > _MUCH:
        return False
    return chi2_above(none.chi2_per_dof * dof, dof) < _BY_CHANCE


def _free_to_bend(problem: DiagnosisProblem, law: CoreLaw) -> CoreLaw:
    """As it is fitted: that of an exact specimen is its formula."""
    if problem.specimen.exact:
        return law
    return BentLaw.over(law, problem.sweep.frequency_hz, problem.freedom)


def _sized(evidence: Evidence, first: Fit, law: CoreLaw) -> Evidence:
    """With the noise that the law alone has left, where nobody knows of another.

    Tolerances weigh against readings: those need a size, and their misfit is all there is.
    """
    dof = max(1, evidence.count - len(law.names))
    return evidence.scaled(float(np.linalg.norm(first.residuals) / np.sqrt(dof)))


def _are_one(fits: Sequence[Refitted]) -> bool:
    """Whether rough fits from several laws have come to the same end."""
    chi2 = [f.chi2 for f in fits]
    return max(chi2) - min(chi2) < _THE_SAME and all(f.converged for f in fits)


def _from_elsewhere(
    problem: DiagnosisProblem, evidence: Evidence, stated: CoreLaw, none: Refitted, executor: Executor
) -> Refitted:
    """The best of a fit and those from everything as stated, and from the wide valley about its law."""
    wide = in_wide_valley(problem, (), evidence, none.law, np.zeros(0))
    starts = [(stated, problem.as_stated), (wide.law, with_stated(problem, wide))]
    found = executor.starmap(_Elsewhere(problem, evidence, none).polished, starts)
    return min([none, *found], key=by_chi2)


@dataclass(frozen=True)
class _Elsewhere:
    """Fits from elsewhere, as far as they may come below one that is known."""

    problem: DiagnosisProblem
    evidence: Evidence
    none: Refitted

    def polished(self, law: CoreLaw, z: Array) -> Refitted:
        """From a law and stated numbers, shape (stated,)."""
        rough = response_of(self.problem, (), self.problem.coarse)
        found, goal = refit(rough, self.evidence, law, z, tolerance=ROUGH), self.none.chi2
        if found.chi2 >= goal and (found.converged or not found.may_reach(goal)):
            return self.none
        return polished(self.problem, (), self.evidence, found.law, found.u, goal=goal)
