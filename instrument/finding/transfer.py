"""A diagnosis of several shear pairs that nothing explains, and what a rig does alike to all of them."""

from dataclasses import replace
from typing import Protocol

import numpy as np

from fitting.arrays import Complex, Mask
from fitting.data.noise import Noise
from fitting.diagnosis.checks.structure import structure
from fitting.diagnosis.inference.begin import Begun, begin
from fitting.diagnosis.inference.evidence import BareModes, Evidence
from fitting.diagnosis.problem.model_error import model_error
from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.diagnosis.verdict.result import Diagnosis, FoundEffect, ParameterEstimate, Stage
from fitting.diagnosis.verdict.rig_transfer import RigTransfer, rig_transfer, validation_of
from fitting.diagnosis.verdict.stage import stage_of
from fitting.digits import times
from fitting.effects import CATALOGUE
from fitting.identification.result import differences_percent
from fitting.laws import CoreLaw
from fitting.structures.shear_pair import ShearPair


class ProblemSource(Protocol):
    """What makes the problem of the points in use."""

    used: list[Mask]
    bare: BareModes | None

    @property
    def start(self) -> CoreLaw:
        """Where the law begins."""

    def problem(self) -> tuple[SeveralProblem, Noise]:
        """Of the points in use."""


def with_transfer(result: Diagnosis, work: ProblemSource) -> Diagnosis:
    """The same, or with `fixture_transfer` beside what the channels show and its law as the one after.

    All points take part again: what spoils a stretch of every file alike is what is looked for. The same,
    too, where that explains the readings less well than the law alone.
    """
    used = work.used
    work.used = [np.ones(len(one), bool) for one in used]
    begun, noise = _begun(work)
    problem = begun.problem
    assert isinstance(problem, SeveralProblem)
    if not _are_pairs(problem) or not noise.is_known or len(set(problem.file_of_points)) < 2:
        work.used = used
        return result
    found = rig_transfer(problem, begun.evidence, begun.none)
    if found is None:
        work.used = used
        return result
    noise_percent = 100 * noise.std_m_s / np.abs(problem.sweep.response_m_s)
    validation = validation_of(found, problem.sweep.segment, noise_percent)
    there, thin = np.concatenate(used), np.zeros(len(problem.sweep), bool)
    thin[found.taken] = True
    ends = np.cumsum([len(one) for one in used])[:-1]
    work.used = np.split(thin, ends)
    again, _ = _begun(work, found)
    stage = stage_of(again.problem, again.evidence, again.none, validation, 1.0)
    work.used = used
    after = _as_read(stage, again, *work.problem(), found.ln_g[there])
    if after.chi2_per_dof > result.before.chi2_per_dof:
        # To first order it explained what it does not: the band of what is unknown stays.
        return result
    effect = _effect(found, problem)
    story = CATALOGUE["fixture_transfer"].story({k: p.value for k, p in effect.parameters.items()})
    said = (
        f"{story[0].upper()}{story[1:]}; with that factor free at every frequency, and stretches that were "
        f"set aside back again, the files follow one law ({times(found.nats)} as likely as with each "
        "file off by itself)."
    )
    return replace(
        result, after=after, channels=(*result.channels, effect), explanation=(*result.explanation, said)
    )


def _begun(work: ProblemSource, found: RigTransfer | None = None) -> tuple[Begun, Noise]:
    problem, noise = work.problem()
    if found is not None:
        problem = replace(problem, wandering=found.wandering)
    return begin(problem, None, noise, work.bare, work.start), noise


def _are_pairs(problem: SeveralProblem) -> bool:
    return all(isinstance(m, SmallProblem) and isinstance(m.specimen, ShearPair) for m in problem.members)


def _as_read(stage: Stage, again: Begun, problem: SeveralProblem, noise: Noise, ln_g: Complex) -> Stage:
    """The law found of some points, and what it leaves of all that the diagnosis took."""
    law, u, sweep = again.none.law, again.none.u, problem.sweep
    plain = response_of(problem, ()).velocity(law, u)
    v = plain * np.exp(ln_g)
    evidence = Evidence.of(sweep, noise, model_error(problem, None, law, plain), plain, None)
    whitened = evidence.residuals(v)
    chi2 = float(whitened @ whitened / max(1, evidence.count - again.none.parameter_count))
    return replace(
        stage,
        predicted_m_s=v,
        difference_percent=differences_percent(sweep, v),
        whitened=whitened,
        chi2_per_dof=chi2,
        structure=structure(sweep, evidence, whitened, chi2),
    )


def _effect(found: RigTransfer, problem: SeveralProblem) -> FoundEffect:
    nan, g, f = float("nan"), found.ln_g, problem.sweep.frequency_hz
    values = {
        "size": ParameterEstimate(found.wandering.of_all, nan, "1"),
        "largest": ParameterEstimate(float(np.abs(np.expm1(g)).max()), nan, "1"),
        "gain": ParameterEstimate(float(np.mean(np.expm1(g.real))), nan, "1"),
        "phase": ParameterEstimate(float(np.mean(g.imag)), nan, "rad"),
        "own": ParameterEstimate(found.wandering.of_each, nan, "1"),
        "from": ParameterEstimate(float(f.min()), nan, "Hz"),
        "to": ParameterEstimate(float(f.max()), nan, "Hz"),
    }
    return FoundEffect("fixture_transfer", values)
