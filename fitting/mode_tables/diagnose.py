"""What a law cannot explain of tables of modes, traced to an effect that changes the structure or the law.

Frequencies and loss factors see neither channels nor levels: gain, delay, drift and softening are not tried.
Two effects at once are looked for where there is one (`pairs`).
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np

from fitting.diagnosis.checks.predictive import temper
from fitting.diagnosis.search.catalogue_search import ScoredFit, best_of_each, by_cost
from fitting.diagnosis.thresholds import PAIRS
from fitting.diagnosis.verdict.confounded import absent_fit, hides, note_of_imitated
from fitting.diagnosis.verdict.judgement import Judgement, judge
from fitting.diagnosis.verdict.names import NONE
from fitting.effects.base import Effect
from fitting.laws import CoreLaw
from fitting.mode_tables.explaining import Explaining
from fitting.mode_tables.fit import BegunModal, begin_modal
from fitting.mode_tables.kin import kin_of_modes
from fitting.mode_tables.misread import Misread, misread
from fitting.mode_tables.pairs import best_pairs, called_for
from fitting.mode_tables.problem import ModalProblem
from fitting.progress import Report, unheard

_SINGLES = 0.6
"""Share of the time that single effects take, where pairs are looked for too."""
_NEAR = 6.0
"""In -2 ln of a probability, a ratio of twenty: a misread row so near what is named is said beside it."""


@dataclass(frozen=True)
class DiagnosedModes:
    """Fits, and what is made of them."""

    begun: BegunModal
    judgement: Judgement
    scored: tuple[ScoredFit, ...]
    """Best first, the one without effects among them, and what is in no catalogue where that was weighed."""
    temper: float
    none: ScoredFit
    odd: Misread | None = None
    """The mode that does not go with the others, where that says more than any effect."""
    rival: Misread | None = None
    """The same where it says about as much as what is named."""


def diagnose_modes(
    problem: ModalProblem,
    effects: Sequence[Effect],
    start: CoreLaw,
    report: Report = unheard,
) -> DiagnosedModes:
    """Try every effect that modes can see. Raises `TooFewPoints`, `OutsideModel`."""
    begun = begin_modal(problem, start, scale_known=problem.scale_known)
    work = Explaining(begun)
    none = work.scored(begun.none)
    seen = [e for e in effects if visible(begun.problem, e)]
    found: list[ScoredFit] = []
    for k, effect in enumerate(seen):
        fits = [f for form in work.forms(effect) for f in work.fits(form, begun.none)]
        scored = [work.scored(f) for f in fits if work.determined(f)]
        found += sorted(scored, key=by_cost)[:1]
        report(_SINGLES * (k + 1) / len(seen))
    found.sort(key=by_cost)
    if called_for(work, none, found):
        found = best_of_each(
            [*found, *best_pairs(work, found, seen, lambda x: report(_SINGLES + (1 - _SINGLES) * x))]
        )
    best = min([none, *found], key=by_cost)
    alone = {name: one.fitted.chi2 for one in found for name in one.names if len(one.names) == 1}
    t = temper(begun.none, best.fitted, alone) if begun.evidence.scale_known else 1.0
    none, *found = (work.scored(one.fitted, t) for one in (none, *found))
    judgement = judge(
        none,
        found,
        held_out=work.held_out,
        kin=lambda scored: kin_of_modes(begun, scored.fitted, t),
    )
    report(1.0)
    if _too_few(work, judgement):
        judgement = replace(judgement, verdict="ambiguous")
    every = sorted([none, *found], key=by_cost)
    odd = misread(begun)
    beyond = np.inf if odd is None else odd.beyond(every[0], begun.problem.response().plate)
    # What one row explains an effect may have done: then the row has to be plainly likelier.
    if beyond < (-_NEAR if every[0].names else 0.0):
        unknown = replace(judgement, verdict="unknown", accepted=None, equivalent={}, unlisted=None)
        return DiagnosedModes(begun, unknown, tuple(every), t, none, odd)
    if judgement.unlisted is not None:
        every = sorted([*every, judgement.unlisted], key=by_cost)
    rival = odd if beyond < _NEAR or not every[0].names else None
    if rival is not None and judgement.verdict == "effect":
        judgement = replace(judgement, verdict="ambiguous")
    judgement = _in_light_of_the_law(work, seen, judgement)
    return DiagnosedModes(begun, judgement, tuple(every), t, none, rival=rival)


def _too_few(work: Explaining, judgement: Judgement) -> bool:
    """Whether two effects are named for certain by fewer numbers than a sweep would look for them with."""
    if judgement.verdict != "effect" or judgement.accepted is None or len(judgement.accepted.names) < 2:
        return False
    needed = PAIRS.data_per_parameter * judgement.accepted.fitted.parameter_count
    return work.begun.evidence.count < needed


def visible(problem: ModalProblem, effect: Effect) -> bool:
    """Whether an effect changes what a table of modes holds, and has as many modes."""
    member = problem.members[0]
    if effect.replaces_law:
        return True
    if effect.sharp:
        # It brings a mode of its own, and no table says whether it has that one.
        return False
    if type(effect).change is Effect.change or effect.objection(problem.points, member.wide) is not None:
        return False
    system = member.system([effect])
    made = effect.change(system, effect.starts(member.wide, problem.points)[0])
    if made is None:
        return False
    damps = len(system.d) > 0 and np.any(np.asarray(made.damping) != 1.0)
    return bool(damps or any(np.any(np.asarray(A) != 0) for A in (made.K, made.K_1, made.M)))


def _in_light_of_the_law(work: Explaining, effects: Collection[Effect], judgement: Judgement) -> Judgement:
    """`ambiguous` in the place of `none` where a shear pair's mass would hide in its law."""
    begun = work.begun
    if judgement.verdict != "none" or begun.problem.members[0].specimen.kind != "shear-pair":
        return judgement
    for effect in (e for e in effects if not e.replaces_law):
        (form, *_) = work.forms(effect)
        absent = absent_fit(begun.problem.response([form]), begun.evidence, begun.none, form)
        if hides(begun.none, absent, begun.problem.points.omega, begun.problem.each):
            note = note_of_imitated([effect.name], "the modes")
            accepted = work.scored(absent)
            equivalent: dict[str, tuple[str, ...]] = {effect.name: (effect.name, NONE)}
            return Judgement(
                "ambiguous", accepted, equivalent, judgement.group, judgement.probability, note=note
            )
    return judgement
