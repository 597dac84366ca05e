"""From a sweep to a verdict: structure, the catalogue, the group that fits as well, held-out data."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from fitting.data.aside import Reasons, reasons
from fitting.data.noise import Noise, noise_of
from fitting.diagnosis.checks.overstated_noise import is_overstated, with_noise_of_left
from fitting.diagnosis.executor import ALONE, Executor
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.search.catalogue_search import ScoredFit, Search, best_of_each, by_cost
from fitting.diagnosis.search.singles import Singles
from fitting.diagnosis.search.with_pairs import with_pairs
from fitting.diagnosis.verdict import text
from fitting.diagnosis.verdict.case import DiagnosisCase
from fitting.diagnosis.verdict.cautions import moved_beside, warnings_of
from fitting.diagnosis.verdict.judgement import (
    Judgement,
    beside_another_law,
    in_light_of,
    judge,
    judged_by_hand,
)
from fitting.diagnosis.verdict.kin import UNLISTED, Unlisted, kin_of
from fitting.diagnosis.verdict.resampling import Again, Resampled, gain, repeats_of, resampled_of
from fitting.diagnosis.verdict.result import Candidate, Diagnosis, FoundEffect, ParameterEstimate, Rivals
from fitting.diagnosis.verdict.stage import few_of_law, found_effects, mixed_band, stage_of
from fitting.effects import CATALOGUE
from fitting.effects.base import Effect
from fitting.errors import OutsideModel
from fitting.progress import Report, unheard
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.sweep import Sweep

_BEYOND = 0.005
"""Of what the group holds: what is less likely does not decide what to measure next. A choice."""

_OF_SEARCH, _OF_REPEATED = 0.8, 0.15
"""Share of a diagnosis that its search is, and of that the first one where it is repeated."""
_OF_SINGLES, _OF_PAIRS = 0.5, 0.3
"""What single effects and pairs are of it, where the search is not repeated: together `_OF_SEARCH`."""
_BEFORE_KNOWN = 0.9
"""Of a diagnosis, where the fit before it has been judged and the one after it has not."""

Settle = Callable[[Search, Judgement], Judgement]


@dataclass(frozen=True)
class ChannelsSeen:
    """What the channels show by themselves, before anything is fitted."""

    effects: tuple[FoundEffect, ...]
    why_aside: Reasons
    """Of every point given why the problem does not hold it; shape (points,)."""


@dataclass(frozen=True)
class DiagnosisOptions:
    """How a case is diagnosed."""

    report: Report = unheard
    executor: Executor = ALONE
    accepted_by_hand: Sequence[str] | None = None
    """Effects that are fitted, and nothing is searched for; None for a search."""
    resamples: int | None = None
    """Sweeps without effects on which the search is repeated; None repeats it where points are few."""
    settle: Settle | None = None
    """Has the last word on the judgement."""


Trace = Callable[[DiagnosisCase, ChannelsSeen, DiagnosisOptions], Diagnosis]
"""What `diagnose_problem` does."""


def seen_in_channels(
    sweep: Sweep, effects: Sequence[Effect]
) -> tuple[Reasons, tuple[FoundEffect, ...], Noise]:
    """Why points are set aside, what the channels show by themselves, and the noise of the points in use.

    The first of shape (points,).
    """
    why, found = reasons(np.zeros(len(sweep), bool), ""), []
    noise = noise_of(sweep)
    for effect in effects:
        # What one has set aside is not asked of again.
        used = why == ""
        left, noise_left = (sweep, noise) if used.all() else (sweep.take(used), noise_of(sweep.take(used)))
        seen = effect.seen(left, noise_left)
        if seen is not None:
            why[np.flatnonzero(used)[seen.aside]] = effect.name
            found.append(FoundEffect(effect.name, {k: ParameterEstimate(*v) for k, v in seen.values.items()}))
    used = why == ""
    return why, tuple(found), noise if used.all() else noise_of(sweep.take(used))


def diagnose_problem(
    case: DiagnosisCase,
    channels: ChannelsSeen | None = None,
    options: DiagnosisOptions = DiagnosisOptions(),
) -> Diagnosis:
    """Everything that can be said of a sweep's residual; without `channels` all its points are in use.

    Where the case can be remade the search is repeated on sweeps without effects and with points held out.

    Raises `OutsideModel` where the data cannot carry what is accepted by hand, before anything is fitted.
    """
    problem, effects, by_hand = case.problem, case.effects, options.accepted_by_hand
    catalogue = {e.name: e for e in effects}
    trusted = [catalogue[name] for name in by_hand or ()]
    _refuse_what_is_objected_to(problem, trusted)
    # Only a search follows it further.
    begun = begin(
        problem,
        case.reduced,
        case.noise,
        case.bare,
        case.start,
        options.executor,
        to_its_end=by_hand is not None,
    )
    search = Search(begun.problem, begun.evidence, begun.none, effects, options.executor)
    decided = _decided(search, case, options) if by_hand is None else _taken_on_trust(search, trusted)
    if channels is None:
        channels = ChannelsSeen((), reasons(np.zeros(len(problem.sweep), bool), ""))
    return _diagnosis(decided, case, channels, options.report)


def _on(kind: str, name: str) -> Effect:
    """An effect that channels show by themselves, whether it was asked for or not."""
    return CATALOGUE[name].on(kind) or CATALOGUE[name]


def _refuse_what_is_objected_to(problem: DiagnosisProblem, effects: Sequence[Effect]) -> None:
    """Before anything is fitted. Raises `OutsideModel` where the data cannot carry one."""
    for effect in effects:
        objection = effect.objection(problem.points, problem.plate)
        if objection is not None:
            raise OutsideModel(f"{effect.name}: {objection}")


@dataclass(frozen=True)
class _Decided:
    """The search at its end, one fit of every explanation, and what is made of them."""

    search: Search
    scored_fits: list[ScoredFit]
    judgement: Judgement
    resampled: Resampled


def _taken_on_trust(search: Search, effects: Sequence[Effect]) -> _Decided:
    judgement = judged_by_hand(search.fitted_by_hand(effects))
    return _Decided(
        search, [judgement.accepted] if judgement.accepted is not None else [], judgement, Resampled()
    )


def _decided(search: Search, case: DiagnosisCase, options: DiagnosisOptions) -> _Decided:
    """The whole catalogue searched, the search repeated where it can be, and the last word heard."""
    report = options.report
    repeats = 0 if case.remade is None else repeats_of(len(case.problem.sweep), options.resamples)
    # Repeated often, the search is the least of the work.
    own = _OF_REPEATED if repeats else 1.0
    search, scored_fits, judgement = _searched(search, case.noise, lambda x: report(own * x))
    resampled = Resampled()
    if case.remade is not None:
        again = Again(case, case.remade, search.none.fitted)
        most = gain(search.none, scored_fits)
        rest = _OF_SEARCH * (1 - own)
        resampled = resampled_of(
            again, most, repeats, search.executor, lambda x: report(_OF_SEARCH * own + rest * x)
        )
        judgement = in_light_of(judgement, resampled.p_value)
    if options.settle is not None:
        judgement = options.settle(search, judgement)
    return _Decided(search, scored_fits, judgement, resampled)


def _diagnosis(decided: _Decided, case: DiagnosisCase, channels: ChannelsSeen, report: Report) -> Diagnosis:
    """Everything that is said of it."""
    catalogue = {e.name: e for e in case.effects}
    search, judgement = decided.search, decided.judgement
    problem, evidence = search.problem, search.evidence
    report(_OF_SEARCH)
    none, accepted = search.none.fitted, judgement.accepted
    search.validate([search.none, *([accepted] if accepted is not None else [])])
    before = stage_of(problem, evidence, none, search.validation(search.none), 1.0)
    report(_BEFORE_KNOWN)
    after, found = before, tuple[FoundEffect, ...]()
    if accepted is not None:
        temper = search.temper(accepted)
        after = stage_of(problem, evidence, accepted.fitted, search.validation(accepted), temper)
        found = found_effects(accepted.fitted, problem.plate, temper)
    if judgement.unlisted is not None or judgement.verdict != "unknown":
        laws, wrong = judgement.weighing(search.none), judgement.weighs_wrong_laws
        after = replace(after, band=mixed_band(problem, search, laws, all_wrong=wrong))
    absent, scored_fits = search.tempered(decided.scored_fits)
    if judgement.unlisted is not None:
        scored_fits.append(judgement.unlisted)
    scored_fits = sorted([absent, *scored_fits], key=by_cost)
    seen = tuple(
        text.story(catalogue.get(c.name) or _on(problem.specimen.kind, c.name), c) for c in channels.effects
    )
    return Diagnosis(
        verdict=judgement.verdict,
        effects=tuple(replace(e, probability=judgement.of_effect(e.name)) for e in found),
        channels=channels.effects,
        equivalent=judgement.equivalent,
        candidates=tuple(
            _candidate(problem, t, search, judgement, scored_fits[0].cost, noise_known=evidence.scale_known)
            for t in scored_fits
        ),
        before=before,
        after=after,
        next_measurement=text.next_measurement(
            judgement,
            catalogue,
            with_hammer=case.bare is not None,
            unknown=text.where_nothing_explains(problem.specimen.kind, problem.points.levels),
        ),
        explanation=(
            *(f"{s[0].upper()}{s[1:]}." for s in seen),
            *text.explain(problem, judgement, before, after, found),
        ),
        why_aside=channels.why_aside,
        warnings=(*warnings_of(search, judgement), *moved_beside(judgement.verdict, after.adjusted)),
        by_hand=judgement.by_hand,
        p_value=decided.resampled.p_value,
        resamples=decided.resampled.repeats,
        nested_held_out_rms_percent=decided.resampled.nested_rms_percent,
        rivals=_rivals(problem, case.reduced, search, judgement, scored_fits),
    )


def _searched(search: Search, noise: Noise, report: Report) -> tuple[Search, list[ScoredFit], Judgement]:
    """The whole catalogue, and the verdict; the search as it ended."""
    singles = Singles(search, lambda x: report(_OF_SINGLES * x)).best()
    sweep = search.problem.sweep
    if singles and is_overstated(sweep, noise, search.evidence, singles[0].fitted):
        search = search.with_evidence(with_noise_of_left(sweep, search.evidence, singles[0].fitted))
        singles = Singles(search, lambda x: report(_OF_SINGLES)).best()
    singles = best_of_each([*singles, *(one for best in singles[:1] for one in search.elsewhere(best))])
    leading = search.leading(singles)
    # Two masses may have found a better place for one than it found alone, a pair for one of its effects.
    singles = best_of_each([*singles, *search.simpler(leading)])
    leading = search.leading(singles)
    singles = best_of_each([*singles, *search.twofold(leading)])
    singles, pairs = with_pairs(search, singles, lambda x: report(_OF_SINGLES + _OF_PAIRS * x))
    found = [*singles, *pairs]
    best = min([search.none, *found], key=by_cost)
    scored_fits = sorted(search.converged_group(found, best, [search.none]), key=by_cost)
    judgement = _judged(search, scored_fits)
    if judgement.is_doubted and search.none.cost > search.reach(scored_fits[0]):
        # A core that is off its formula bends its law far, as a cause in no catalogue does: both are weighed.
        scored_fits = best_of_each([*scored_fits, *search.freer(scored_fits, scored_fits[0])])
        judgement = _judged(search, scored_fits)
    return search, [t for t in scored_fits if t.names in judgement.probability], judgement


def _judged(search: Search, scored_fits: Sequence[ScoredFit]) -> Judgement:
    t = search.temper_of(scored_fits)
    judgement = judge(
        *search.tempered(scored_fits),
        held_out=search.off_unseen,
        kin=lambda scored: kin_of(search, scored.fitted, t),
    )
    return beside_another_law(judgement, search.passing_for_a_law)


def _rivals(
    problem: DiagnosisProblem,
    reduced: ReducedPlate | None,
    search: Search,
    judgement: Judgement,
    scored_fits: Sequence[ScoredFit],
) -> Rivals | None:
    """`scored_fits`: one of every explanation."""
    if not judgement.group or judgement.by_hand:
        return None
    each = tuple((scored.fitted, share) for scored, share in judgement.group)
    inside = {scored.names for scored, _ in judgement.group}
    whole = sum(judgement.probability[names] for names in inside)
    others = {t.names: t for t in scored_fits if t.names not in inside and UNLISTED not in t.names}
    shares = [(t.fitted, judgement.probability.get(names, 0.0) / whole) for names, t in others.items()]
    beyond = tuple(sorted((one for one in shares if one[1] > _BEYOND), key=lambda one: -one[1]))
    return Rivals(problem, search.evidence, each, reduced, search.temper(judgement.group[0][0]), beyond)


def _candidate(
    problem: DiagnosisProblem,
    scored: ScoredFit,
    search: Search,
    judgement: Judgement,
    best: float,
    *,
    noise_known: bool,
) -> Candidate:
    if isinstance(scored, Unlisted):
        law = mixed_band(problem, search, scored.weighing(search.none), few=True)
        share = judgement.probability[scored.names]
        cost, left = scored.cost - best, scored.chi2_per_dof
        return Candidate((FoundEffect(UNLISTED, {}),), cost, left, share, law)
    chi2 = scored.fitted.chi2_per_dof if noise_known else float("nan")
    temper = search.temper(scored)
    accepted = judgement.accepted
    if accepted is not None and accepted.names == scored.names:
        # Its sizes are those of the verdict, which may have the last word on them.
        sized, temper = accepted.fitted, search.temper(accepted)
    else:
        sized = scored.fitted
    return Candidate(
        found_effects(sized, problem.plate, temper),
        scored.cost - best,
        chi2,
        judgement.probability.get(scored.names, 0.0),
        few_of_law(problem, sized, temper),
        dict(scored.checks),
    )
