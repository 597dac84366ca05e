"""The diagnosis as one would tell it to a colleague."""

import numpy as np

from fitting.arrays import Complex
from fitting.diagnosis.checks.structure import in_words
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.search.catalogue_search import ScoredFit
from fitting.diagnosis.several.parts_with import part_with
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.diagnosis.thresholds import KIN, VERDICT
from fitting.diagnosis.verdict.judgement import Judgement
from fitting.diagnosis.verdict.kin import UNLISTED
from fitting.diagnosis.verdict.names import NONE
from fitting.diagnosis.verdict.result import FoundEffect, Stage
from fitting.digits import all_digits, seldom, two_digits, written_out
from fitting.effects.base import Effect
from fitting.identification.quoted import quoted_hz

_ROUGHLY = 0.5
"""Standard error over a size from which the size alone says more than is known."""
_WORTH_SAYING = 0.01
"""Of the largest change of a response: less is left out of the sentence."""


def story(effect: Effect, found: FoundEffect) -> str:
    """Half a sentence on an effect as it was found; with the errors of sizes that they make worth little."""
    said = effect.story({key: p.value for key, p in found.parameters.items()})
    roughly = [
        f"{key} {two_digits(p.value)} +- {two_digits(p.standard_error)} {p.unit}".removesuffix(" 1")
        for key, p in found.parameters.items()
        if p.standard_error > _ROUGHLY * abs(p.value)
    ]
    return f"{said} (known roughly: {', '.join(roughly)})" if roughly else said


def explain(
    problem: DiagnosisProblem,
    judgement: Judgement,
    before: Stage,
    after: Stage,
    found: tuple[FoundEffect, ...],
) -> tuple[str, ...]:
    """What was left, what explains it, how sure that is, what it did to the material."""
    said = [_left(problem, before)]
    scored = judgement.accepted
    if judgement.verdict == "none":
        said += _without_effect(problem, judgement, noise_known=bool(np.isfinite(before.chi2_per_dof)))
    elif scored is None:
        said += _unexplained(problem, judgement, before)
    elif judgement.verdict == "ambiguous" and judgement.note:
        said.append(judgement.note)
    else:
        said += _what_it_is(problem, judgement, scored, found)
        said += _what_it_may_stand_for(judgement, scored)
        said += _what_it_may_be_besides(judgement)
        said += what_it_leaves(before, after, found)
    return tuple(said)


def _without_effect(problem: DiagnosisProblem, judgement: Judgement, *, noise_known: bool) -> list[str]:
    """Where no effect is called for, or none wanted."""
    if judgement.by_hand:
        return ["No effect is accepted, by your word."]
    model = "a layer-wise plate" if problem.specimen.kind == "plate" else "the model"
    said = ["How much of that is noise these points do not show: they call for no effect."]
    if noise_known:
        said = [f"That is what noise and {model}'s own error leave: no effect is called for."]
    said += _beside_none(judgement)
    if judgement.refused:
        said.append(f"The nearest, {' with '.join(judgement.refused)}, {judgement.why}.")
    return said


def _unexplained(problem: DiagnosisProblem, judgement: Judgement, before: Stage) -> list[str]:
    """Where there is something that no effect explains."""
    worst = _worst_segment(problem, before)
    said = [
        "There is structure, but nothing in the catalogue explains it. What remains is largest in "
        f"segment {worst}: {'; '.join(before.structure) or 'see the residual over frequency'}."
    ]
    if judgement.refused:
        said.append(f"What comes nearest, {' with '.join(judgement.refused)}, {judgement.why}.")
    return said


def _what_it_is(
    problem: DiagnosisProblem, judgement: Judgement, scored: ScoredFit, found: tuple[FoundEffect, ...]
) -> list[str]:
    """The accepted effects, and how far they move the response."""
    stories = [story(e, f) for e, f in zip(scored.fitted.effects, found, strict=True)]
    said = [f"{how_likely(judgement, scored.names)} {', and besides '.join(stories)}."]
    if not all(e.replaces_law for e in scored.fitted.effects):
        said.append(_moved(problem, scored.fitted))
    return said


def _what_it_may_stand_for(judgement: Judgement, scored: ScoredFit) -> list[str]:
    """What makes the accepted explanation doubtful by itself."""
    said = []
    if scored.stands_in and not judgement.by_hand:
        said.append(f"It may stand in for what is not known: {scored.stands_in}.")
    if scored.too_large and judgement.by_hand:
        said.append(f"{scored.too_large} ends at the limit of what is plausible: it would be larger still.")
    if scored.strains is not None and not judgement.by_hand:
        said.append(
            f"It has stated numbers as far off as they are {seldom(scored.strains)}, and may "
            "stand in for what is not known."
        )
    return said


def _what_it_may_be_besides(judgement: Judgement) -> list[str]:
    """What the data cannot exclude in its place: another effect, an unknown one, none, or its kin."""
    said = []
    for name, group in judgement.equivalent.items():
        others = [n for n in group if n not in (name, NONE, UNLISTED)]
        if others:
            said.append(f"These data cannot tell {name} from {', '.join(others)}.")
    if not judgement.confirmed:
        said.append(
            "Two effects may stand in for one that is not known: segments that were held out are predicted "
            "no better than without them."
        )
    if any(NONE in group for group in judgement.equivalent.values()):
        said.append(f"That there is no effect at all keeps {_percent(judgement.probability[()])}.")
    return said + beside_kin(judgement)


def what_it_leaves(before: Stage, after: Stage, found: tuple[FoundEffect, ...]) -> list[str]:
    """The fit and the core's law without and with it."""
    said = [
        f"With it the fit leaves {two_digits(after.rms_percent)} % rms instead of "
        f"{two_digits(before.rms_percent)} %" + _chi2(before, after) + _held_out(before, after, found)
    ]
    if after.chi2_per_dof >= before.chi2_per_dof:
        said.append("What speaks for it is not what is left, but how near it leaves stated numbers and law.")
    return [*said, _law(before, after)]


def how_likely(judgement: Judgement, names: tuple[str, ...]) -> str:
    """How a sentence on an accepted explanation begins: none may be likelier, up to twice."""
    if judgement.by_hand:
        return "By your word"
    nothing = judgement.probability.get((), 0.0)
    return "If anything," if nothing > judgement.probability[names] else "Most likely"


def beside_kin(judgement: Judgement) -> list[str]:
    """That the accepted explanation may be something like it, where that is in the group."""
    if not any(UNLISTED in group for group in judgement.equivalent.values()):
        return []
    share = _percent(judgement.share_of_kin)
    why = "the readings show too little of it to test its own formula"
    if judgement.share_of_kin > KIN.chance:
        why = "what is left of the readings is more like that than what its own formula leaves"
    return [f"That it is something of its kind, in no catalogue, has {share}: {why}."]


def _beside_none(judgement: Judgement) -> list[str]:
    """What is not excluded though nothing is named."""
    others = {names: p for names, p in judgement.probability.items() if names and p > VERDICT.worth_saying}
    if not others:
        return []
    best = max(others, key=lambda names: others[names])
    none, share = _percent(judgement.probability[()]), _percent(others[best])
    return [f"Of what was tried, no effect has {none}, {' with '.join(best)} {share}: too little to name it."]


def _percent(probability: float) -> str:
    return f"{two_digits(100 * probability)} %"


def next_measurement(
    judgement: Judgement, catalogue: dict[str, Effect], *, with_hammer: bool, unknown: str = ""
) -> str:
    """What would tell equivalent effects apart, or confirm a single one; `unknown` where there is none.

    Empty where none of the effects says what would show it.
    """
    if judgement.verdict == "none":
        return ""
    if judgement.accepted is None:
        return unknown
    names = [n for group in judgement.equivalent.values() if len(group) > 1 for n in group]
    names = names or list(judgement.equivalent)
    ways = {
        catalogue[n].discriminating_test: n
        for n in names
        if n in catalogue and catalogue[n].discriminating_test
    }
    if with_hammer:
        ways = {w: n for w, n in ways.items() if "hammer" not in w} or ways
    if not ways:
        return ""
    if all(len(group) == 1 for group in judgement.equivalent.values()):
        return "To confirm: " + "; ".join(ways) + "."
    return "To tell them apart: " + "; ".join(f"{way} ({name})" for way, name in ways.items()) + "."


def where_nothing_explains(kind: str, levels: int) -> str:
    """What to measure next on a kind of specimen that was driven at so many levels."""
    level = "a second level" if levels == 1 else "its lowest level by itself"
    if kind == "shear-pair":
        what, whose = "Another mass", "the rig or to the strain"
    else:
        what, whose = "A second spot", "the place or the drive"
    asked = f"{what} and {level}: they show whether the rest belongs to {whose}."
    return f"{asked} The same once more: it shows whether the instruments wander."


WHERE_NOTHING_EXPLAINS_MODES = (
    "A second specimen, and the sweeps that the modes were read from: they show whether the rest belongs to "
    "the specimen or to the reading."
)
"""The same of tables of modes."""


def _left(problem: DiagnosisProblem, before: Stage) -> str:
    kind = in_words(problem.specimen.kind)
    text = f"The stated {kind} with its best law leaves {two_digits(before.rms_percent)} % rms in amplitude"
    if np.isfinite(before.chi2_per_dof):
        chi2 = written_out(before.chi2_per_dof, 3)
        text += f", chi-square per degree of freedom {chi2} where noise and model error leave 1"
    return text + "."


def _worst_segment(problem: DiagnosisProblem, before: Stage) -> int:
    numbers = np.unique(problem.sweep.segment)
    size = [np.mean(np.abs(before.difference_percent[problem.sweep.segment == n])) for n in numbers]
    return int(numbers[int(np.argmax(size))])


def _moved(problem: DiagnosisProblem, fitted: Refitted) -> str:
    """How much the effect changes the response, the law kept."""
    plain = response_of(problem, ()).velocity(fitted.law, fitted.z)
    return moved_words(problem, plain, fitted.velocity_m_s)


def moved_words(problem: DiagnosisProblem, plain: Complex, velocity_m_s: Complex) -> str:
    """How much a response differs from a plain one: by segment, of several files or spots the most.

    Shape (points,) each.
    """
    changed = 100 * np.abs(velocity_m_s / plain - 1)
    parts = []
    for number in np.unique(problem.sweep.segment):
        inside = problem.sweep.segment == number
        at = int(np.flatnonzero(inside)[np.argmax(changed[inside])])
        most = f"{two_digits(changed[at])} % near {problem.sweep.frequency_hz[at]:.0f} Hz"
        parts.append((float(changed[at]), f"{most}{_whose(problem, at)}"))
    if isinstance(problem, SeveralProblem) and len(problem.members) > 1:
        parts = [max(parts)]
    # Beside what it changes elsewhere nobody wants the rest.
    largest = max(parts)[0]
    parts = [part for part in parts if part[0] > _WORTH_SAYING * largest] or parts
    most = ", ".join(words for _, words in parts)
    return f"With the same law, this effect alone changes the response by up to {most}."


def _whose(problem: DiagnosisProblem, point: int) -> str:
    """The file and the spot of a point, where there are several."""
    if not isinstance(problem, SeveralProblem):
        return ""
    every = zip(problem.starts_at, problem.belongs, strict=True)
    place = next(place for part, place in every if part.start <= point < part.stop)
    said = "" if len({p.file for p in problem.belongs}) < 2 else f" in file {place.file}"
    return said if place.pickup is None else f"{said} at pickup {place.pickup}"


def _chi2(before: Stage, after: Stage) -> str:
    if not np.isfinite(after.chi2_per_dof):
        return ""
    chi2 = [written_out(stage.chi2_per_dof, 3) for stage in (after, before)]
    return f", chi-square per degree of freedom {chi2[0]} instead of {chi2[1]}"


def _held_out(before: Stage, after: Stage, found: tuple[FoundEffect, ...]) -> str:
    values = [(one.name, {key: p.value for key, p in one.parameters.items()}) for one in found]
    if not all(part_with(*one).is_all for one in values):
        return "; what is in one part of the data alone, the others cannot foretell."
    pairs = [(s.validation.leave_one_out_rms_percent, "left out one by one") for s in (before, after)]
    if pairs[0][0] is None:
        pairs = [(s.validation.held_out_rms_percent, "on segments held out") for s in (before, after)]
    (b, what), (a, _) = pairs
    if a is None or b is None:
        return "."
    return f"; {what} {two_digits(a)} % instead of {two_digits(b)} %."


def _law(before: Stage, after: Stage) -> str:
    parts = []
    for f in quoted_hz(before.band.frequency_hz):
        k = np.flatnonzero(before.band.frequency_hz == f)
        G = [b.storage_modulus_pa[k[0]] / 1e6 for b in (before.band, after.band)]
        eta = [b.loss_factor[k[0]] for b in (before.band, after.band)]
        stiff, lossy = (" -> ".join(all_digits(v, n) for v in pair) for pair, n in ((G, 4), (eta, 3)))
        parts.append(f"at {f:.4g} Hz G' {stiff} MPa, eta {lossy}")
    return f"The core without and with it: {'; '.join(parts)}."
