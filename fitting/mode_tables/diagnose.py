"""What a law cannot explain of tables of modes, traced to an effect that changes the structure or the law.

Frequencies and loss factors see neither channels nor levels: gain, delay, drift and softening are not tried.
One effect at a time: a dozen numbers do not carry two.
"""

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.chances import chi2_above, normal_above
from fitting.diagnosis.candidates import promising
from fitting.diagnosis.confounded import hides
from fitting.diagnosis.evidence import Evidence
from fitting.diagnosis.marginal import cost
from fitting.diagnosis.of_files import OfFiles
from fitting.diagnosis.predictive import form_error, temper
from fitting.diagnosis.refit import ROUGH, Refitted, kept, refit
from fitting.diagnosis.search import ScoredFit
from fitting.diagnosis.thresholds import SEARCH, VERDICT
from fitting.diagnosis.verdict import NONE, Judgement, judge
from fitting.effects.base import Effect
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.mode_tables.fit import BegunModal, begin_modal
from fitting.mode_tables.problem import ModalProblem

_FOLLOWED, _FOLLOWED_PLACES = 1, 3
"""Starts of an effect that are fitted; of one with a place."""
_SPARE = 2
"""Numbers a candidate must leave over."""
Report = Callable[[float], None]


@dataclass(frozen=True)
class DiagnosedModes:
    """Fits, and what is made of them."""

    begun: BegunModal
    judgement: Judgement
    scored: tuple[ScoredFit, ...]
    """Best first, the one without effects among them."""
    temper: float


def diagnose_modes(
    problem: ModalProblem,
    effects: Sequence[Effect],
    start: CoreLaw,
    report: Report = lambda fraction: None,
) -> DiagnosedModes:
    """Try every effect that modes can see. Raises `TooFewPoints`, `OutsideModel`."""
    begun = begin_modal(problem, start, scale_known=problem.scale_known)
    none = _scored(begun, begun.none)
    seen = [e for e in effects if visible(begun.problem, e)]
    found: list[ScoredFit] = []
    for k, effect in enumerate(seen):
        fits = [f for form in _forms(begun.problem, effect) for f in _fits(begun, form)]
        scored = [_scored(begun, f) for f in fits if f.parameter_count <= begun.evidence.count - _SPARE]
        found += sorted(scored, key=lambda s: s.cost)[:1]
        report((k + 1) / len(seen))
    every = sorted([none, *found], key=lambda s: s.cost)
    t = temper(begun.none, every[0].fitted) if begun.evidence.scale_known else 1.0
    judgement = judge(none, found, temper=t, hidden=frozenset(), held_out=lambda one: float("nan"))
    return DiagnosedModes(begun, _in_light_of_the_law(begun, none, seen, judgement), tuple(every), t)


def visible(problem: ModalProblem, effect: Effect) -> bool:
    """Whether an effect changes what a table of modes holds."""
    member = problem.members[0]
    if effect.replaces_law:
        return True
    if type(effect).change is Effect.change or effect.objection(problem.points, member.wide) is not None:
        return False
    system = member.system([effect])
    made = effect.change(system, effect.starts(member.wide, problem.points)[0])
    if made is None:
        return False
    damps = len(system.d) > 0 and np.any(np.asarray(made.damping) != 1.0)
    return bool(damps or any(np.any(np.asarray(A) != 0) for A in (made.K, made.K_1, made.M)))


def _forms(problem: ModalProblem, effect: Effect) -> list[Effect]:
    files = len(problem.members)
    whole = effect if effect.replaces_law or files == 1 else OfFiles(effect, files)
    return list(whole.variants())


def _fits(begun: BegunModal, effect: Effect) -> list[Refitted]:
    """With one form of an effect, from its most promising starts."""
    problem, evidence, none = begun.problem, begun.evidence, begun.none
    response = problem.response([effect])
    if effect.replaces_law:
        laws = [law for law in effect.laws(none.law, problem.points) if _carried(evidence, law)]
        return [f for law in laws if (f := _tried(begun, effect, law, none.z)) is not None]
    with np.errstate(all="ignore"):
        starts = promising(response, problem.response(), problem.points, evidence, none)
    has_place = any(q.neutral is None and not q.fixed for q in effect.parameters)
    lost = none.chi2_per_dof > SEARCH.wrong
    begins = [(none.law, none.z), *([(begun.start, 0 * none.z)] if lost else [])]
    fits = [
        f
        for _, u in starts[: _FOLLOWED_PLACES if has_place else _FOLLOWED]
        for law, z in begins
        if (f := _tried(begun, effect, law, np.concatenate([z, u]))) is not None
    ]
    if not fits:
        return []
    best = min(fits, key=lambda f: f.chi2)
    return [refit(response, evidence, best.law, best.u)]


def _carried(evidence: Evidence, law: CoreLaw) -> bool:
    return len(law.names) <= evidence.count - _SPARE


def _tried(begun: BegunModal, effect: Effect, law: CoreLaw, u: Array) -> Refitted | None:
    """A rough fit; None where the structure it leads to has not the table's modes."""
    try:
        return refit(begun.problem.response([effect]), begun.evidence, law, u, tolerance=ROUGH)
    except (OutsideModel, np.linalg.LinAlgError):
        return None


def _scored(begun: BegunModal, fitted: Refitted) -> ScoredFit:
    plate = begun.problem.response(fitted.effects).plate
    return ScoredFit(fitted, cost(fitted, plate), _checks(begun, fitted))


def _checks(begun: BegunModal, fitted: Refitted) -> dict[str, float]:
    """Tail probabilities of what is left, and of what was asked of the stated numbers."""
    if not begun.evidence.scale_known:
        return {}
    dof = max(1, fitted.data - fitted.parameter_count)
    left = fitted.chi2_per_dof / (1 + form_error(begun.none, fitted) / dof)
    spread = np.hypot(2 * VERDICT.noise_known_to, np.sqrt(2 / dof))
    found = {"size": float(normal_above(np.log(max(left, 1e-12)) / spread))}
    if fitted.stated:
        found["tolerances"] = float(chi2_above(fitted.unexplained, fitted.stated))
    return found


def _in_light_of_the_law(
    begun: BegunModal, none: ScoredFit, effects: Collection[Effect], judgement: Judgement
) -> Judgement:
    """`ambiguous` in the place of `none` where a shear pair's mass would hide in its law."""
    if judgement.verdict != "none" or begun.problem.members[0].specimen.kind != "shear-pair":
        return judgement
    for effect in (e for e in effects if not e.replaces_law):
        (form, *_) = _forms(begun.problem, effect)
        neutral = [0.0 if q.neutral is None else q.neutral for q in form.parameters]
        u = np.concatenate([begun.none.z, neutral])
        absent = kept(begun.problem.response([form]), begun.evidence, begun.none.law, u)
        if hides(begun.none, absent, begun.problem.points.omega):
            why = (
                f"{effect.name} cannot be told from the core's modulus by these data: what one does to the "
                "modes the other does too. The law found is that of what is stated."
            )
            accepted = _scored(begun, absent)
            equivalent: dict[str, tuple[str, ...]] = {effect.name: (effect.name, NONE)}
            return Judgement(
                "ambiguous", accepted, equivalent, judgement.group, judgement.probability, why=why
            )
    return judgement
