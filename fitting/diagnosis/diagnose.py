"""From a sweep to a verdict: structure, the catalogue, the group that fits as well, held-out data."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from fitting.diagnosis import words
from fitting.diagnosis.evidence import BareModes, Evidence
from fitting.diagnosis.hands import ALONE, Hands
from fitting.diagnosis.model_error import model_error
from fitting.diagnosis.pairs import Pairs
from fitting.diagnosis.prediction import over_noise
from fitting.diagnosis.refit import Fitted, refit
from fitting.diagnosis.response import Response
from fitting.diagnosis.result import Candidate, Diagnosis, Estimate, FoundEffect
from fitting.diagnosis.search import Search, Trial
from fitting.diagnosis.stage import found_effects, stage_of
from fitting.diagnosis.structure import roughness, structure
from fitting.diagnosis.task import Task
from fitting.diagnosis.verdict import (
    FIRST,
    Judgement,
    foremost,
    judge,
    standing_for,
    told,
    without_idle_extensions,
)
from fitting.effects import CATALOGUE
from fitting.effects.base import Effect
from fitting.identification.direct import fit_direct
from fitting.identification.model import SweepModel
from fitting.identification.residuals import Residuals
from fitting.laws import CoreLaw
from fitting.noise import Noise, noise_of
from fitting.reduced import ReducedPlate
from fitting.sweep import Sweep

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Report = Callable[[float], None]

NOTHING_LEFT = 0.97
"""Chi-square per degree of freedom below which no second effect is looked for."""
CLEAN_ENOUGH = 1.08
"""Chi-square per degree of freedom above which a second effect is looked for beside all leading ones."""
OVERSTATED = 0.75
"""Times the noise's variance: where the best fit leaves less, local scatter was more than noise."""
_NUMBERS_A_PARAMETER = 10
"""Data per parameter below which no second effect is looked for."""


def seen_in_channels(sweep: Sweep, effects: Sequence[Effect]) -> tuple[Mask, tuple[FoundEffect, ...], Noise]:
    """Points fit for use, what the channels show by themselves, and the noise of the points in use."""
    used, found = np.ones(len(sweep), bool), []
    noise = noise_of(sweep)
    for effect in effects:
        seen = effect.seen(sweep, noise)
        if seen is not None:
            used &= ~seen.aside
            found.append(FoundEffect(effect.name, {k: Estimate(*v) for k, v in seen.values.items()}))
    return used, tuple(found), noise if used.all() else noise_of(sweep.take(used))


def begin(
    task: Task, reduced: ReducedPlate, noise: Noise, bare: BareModes | None, start: CoreLaw
) -> tuple[Task, Evidence, Fitted]:
    """The fit without any effect, and the evidence all candidates are judged by."""
    sweep = task.sweep
    model = SweepModel(task.rational, np.arange(len(sweep)), sweep.commanded_m_s2, task.specimen.reads)
    law = fit_direct(Residuals.of(sweep, noise, model), start).law
    task = task.condensed(law).around(law)
    v = model.velocity(law)
    evidence = Evidence.of(sweep, noise, model_error(task, reduced, law, v), v, bare)
    none = refit(Response(task, ()), evidence, law, np.empty(0))
    return task, evidence, none


def diagnose_task(
    task: Task,
    reduced: ReducedPlate,
    effects: Sequence[Effect],
    noise: Noise,
    bare: BareModes | None,
    start: CoreLaw,
    channels: tuple[FoundEffect, ...] = (),
    used: Mask | None = None,
    report: Report = lambda fraction: None,
    accepted_by_hand: Sequence[str] | None = None,
    hands: Hands = ALONE,
) -> Diagnosis:
    """Everything that can be said of a sweep's residual; `task` holds the points in use.

    With `accepted_by_hand` these effects are fitted and nothing is searched for.
    """
    task, evidence, none = begin(task, reduced, noise, bare, start)
    known_names = {e.name for e in effects}
    bases = [CATALOGUE[e.extends] for e in effects if e.extends and e.extends not in known_names]
    search = Search(task, evidence, none, effects, hands, bases)
    catalogue = {e.name: e for e in effects}
    if accepted_by_hand is None:
        search, trials, judgement = _searched(search, noise, report)
        evidence = search.evidence
    else:
        judgement = told(search.told([catalogue[name] for name in accepted_by_hand]))
        trials = [judgement.accepted] if judgement.accepted is not None else []
    known = evidence.scale_known
    report(0.8)
    before = stage_of(task, evidence, search.none.fitted, search.validation(search.none))
    report(0.9)
    accepted = judgement.accepted
    after, found = before, tuple[FoundEffect, ...]()
    if accepted is not None:
        after = stage_of(task, evidence, accepted.fitted, search.validation(accepted))
        found = found_effects(accepted.fitted, task.plate)
    trials = sorted([search.none, *trials], key=lambda t: t.bic)
    seen = tuple(words.story(catalogue[c.name], c) for c in channels)
    return Diagnosis(
        verdict=judgement.verdict,
        effects=found,
        channels=channels,
        equivalent=judgement.equivalent,
        candidates=tuple(_candidate(task, t, trials[0].bic, noise_known=known) for t in trials),
        before=before,
        after=after,
        next_measurement=words.next_measurement(judgement, catalogue, with_hammer=bare is not None),
        explanation=(
            *(f"{s[0].upper()}{s[1:]}." for s in seen),
            *words.explain(task, judgement, before, after, found, catalogue),
        ),
        used=np.ones(len(task.sweep), bool) if used is None else used,
        warnings=_warnings(task, judgement),
        by_hand=judgement.by_hand,
    )


def _searched(search: Search, noise: Noise, report: Report) -> tuple[Search, list[Trial], Judgement]:
    """The whole catalogue, and the verdict; the search as it ended."""
    every = search.singles(lambda x: report(0.5 * x))
    share = _noise_left(search, every) if noise.source == "local scatter" else 1.0
    if share < OVERSTATED:
        # What scatters from point to point need not be noise: a drift does, in a sweep that jumps about.
        search = search.with_evidence(search.evidence.scaled(float(np.sqrt(share))))
        every = search.singles(lambda x: report(0.5))
    singles = without_idle_extensions(every, search.unnamed)
    all_pairs = _pairs(search, singles, lambda x: report(0.5 + 0.3 * x))
    pairs = without_idle_extensions(all_pairs)
    for trial in [one for pair in pairs[:1] for one in search.alone(pair)]:
        # A pair may have found a better place for one effect than it found alone.
        every = sorted([*(t for t in every if t.names != trial.names or t.bic < trial.bic), trial], key=_bic)
    singles = without_idle_extensions(every, search.unnamed)
    none, evidence = search.none.fitted, search.evidence
    left = structure(search.task.sweep, evidence, none.residuals[: none.data], none.chi2_per_dof)
    judgement = judge(
        search.none,
        singles,
        pairs,
        noise_known=evidence.scale_known,
        structured=bool(left),
        held_out=lambda trial: over_noise(search.validation(trial)),
        meant=lambda trial: standing_for(trial, [*every, *all_pairs]),
    )
    return search, [*singles, *pairs], judgement


def _noise_left(search: Search, trials: Sequence[Trial]) -> float:
    """Variance of what the best fit leaves, or of what of it jumps from point to point, over the noise's."""
    if not trials:
        return 1.0
    best = trials[0].fitted
    parts = 2 if search.evidence.has_phase else 1
    rough = roughness(search.task.sweep, best.residuals[: best.data], parts)
    return float(np.nanmin([best.chi2_per_dof, rough]))


def _bic(trial: Trial) -> float:
    return trial.bic


def _pairs(search: Search, singles: Sequence[Trial], report: Report) -> list[Trial]:
    """Two effects, where one leaves something or only another law explains it all."""
    if not singles or not search.evidence.scale_known:
        return []
    best = foremost(search.none, singles)
    if search.evidence.count < _NUMBERS_A_PARAMETER * (best.fitted.parameters + 2):
        return []
    flexible = any(e.replaces_law for e in best.fitted.effects)
    if search.none.bic - best.bic < FIRST:
        return []
    doubtful = flexible or best.leans
    if best.fitted.chi2_per_dof < NOTHING_LEFT and not doubtful:
        return []
    wide = best.fitted.chi2_per_dof > CLEAN_ENOUGH or doubtful
    return Pairs(search).best(singles, report, wide=wide)


def _candidate(task: Task, trial: Trial, best: float, *, noise_known: bool) -> Candidate:
    chi2 = trial.fitted.chi2_per_dof if noise_known else float("nan")
    return Candidate(found_effects(trial.fitted, task.plate), trial.bic - best, chi2)


def _warnings(task: Task, judgement: Judgement) -> tuple[str, ...]:
    said = []
    names = {n for group in judgement.equivalent.values() for n in group}
    if "temperature_drift" in names and not task.points.timed:
        said.append("the points carry no time: the drift assumes an even sweep upwards in frequency")
    return tuple(said)
