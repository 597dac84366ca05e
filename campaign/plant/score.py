"""How often the diagnosis was right, and what that did to the material."""

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import permutations

import numpy as np

from campaign.plant.cases import KINDS, NONE, PAIR
from campaign.plant.outcome import Outcome, Said, StageFacts
from campaign.plant.severities import OF_THE_CHANNELS_ALONE, PLACES

MOST_IN_GROUP = 3
"""A larger group names nothing."""
UNKNOWN = "unknown"


@dataclass(frozen=True)
class LawErrors:
    """Of G' and eta together over cases and frequencies, sizes in percent."""

    median: float
    worst: float


@dataclass(frozen=True)
class Score:
    """How diagnoses of some cases did. Counts are out of `cases`, those of `taken_out` out of that."""

    name: str
    cases: int
    failed: int
    """No answer at all."""
    right: int
    """Single: the effect named first. Pair: both named and nothing else. Clean: nothing named."""
    in_group: int
    """The same, or within declared groups of at most three."""
    of_hidden: int
    """Of the explanations by effects that the campaign can hide the likeliest is what was hidden."""
    part: int
    """Of pairs: at least one named."""
    too_many: int
    """More effects accepted than there are."""
    taken_out: int
    """Diagnosed again with the true effect out of the catalogue."""
    refused: int
    """Then: unknown."""
    misnamed: int
    """Then: some effect named, and no group declared."""
    law_before: LawErrors
    law_after: LawErrors
    chi2_after: float
    """Median of chi-square per degree of freedom."""
    held_out_before_percent: float
    """Median."""
    held_out_after_percent: float
    seconds: float
    """Median."""
    setup_seconds: float


def scores(outcomes: Sequence[Outcome]) -> list[Score]:
    """One for each kind present, then all single effects together."""
    kinds = [kind for kind in KINDS if any(o.kind == kind for o in outcomes)]
    found = [score(kind, [o for o in outcomes if o.kind == kind]) for kind in kinds]
    single = [o for o in outcomes if o.kind not in (NONE, PAIR)]
    return [*found, score("all single effects", single)] if single else found


def score(name: str, outcomes: Sequence[Outcome]) -> Score:
    """The score of some cases together."""
    said = [o.said for o in outcomes if o.said is not None]
    again = [o.without for o in outcomes if o.without is not None]
    return Score(
        name=name,
        cases=len(outcomes),
        failed=len(outcomes) - len(said),
        right=_count(outcomes, right),
        in_group=_count(outcomes, in_group),
        of_hidden=_count(outcomes, of_hidden),
        part=_count(outcomes, part),
        too_many=_count(outcomes, lambda o, s: len(s.effects) > len(wanted(o))),
        taken_out=len(again),
        refused=sum(s.verdict == UNKNOWN for s in again),
        misnamed=sum(s.verdict == "effect" for s in again),
        law_before=law_errors(s.before for s in said),
        law_after=law_errors(s.after for s in said),
        chi2_after=_median(s.after.chi2_per_dof for s in said),
        held_out_before_percent=_median(s.before.held_out_percent for s in said),
        held_out_after_percent=_median(s.after.held_out_percent for s in said),
        seconds=_median(s.seconds for s in said),
        setup_seconds=_median(s.setup_seconds for s in said),
    )


def right(outcome: Outcome, said: Said) -> bool:
    """Whether what was hidden was named: a single effect first, a pair whole, nothing where nothing is."""
    if outcome.kind == PAIR:
        return set(said.effects) == set(outcome.truth)
    if not wanted(outcome):
        return said.verdict == NONE and set(said.channels) == set(outcome.truth)
    return said.effects[:1] == outcome.truth


def in_group(outcome: Outcome, said: Said) -> bool:
    """Whether it was named, as by `right`, a group of at most three standing for each of its names."""
    if right(outcome, said):
        return True
    groups = [said.group_of(name) for name in said.effects]
    groups = [g if len(g) <= MOST_IN_GROUP else () for g in groups]
    if outcome.kind == PAIR:
        orders = permutations(outcome.truth) if len(groups) == len(outcome.truth) else ()
        return any(all(n in g for n, g in zip(names, groups, strict=True)) for names in orders)
    return bool(wanted(outcome)) and bool(groups) and outcome.truth[0] in groups[0]


def of_hidden(outcome: Outcome, said: Said) -> bool:
    """Whether what was hidden is likelier than all else by effects that the campaign can hide.

    What is in the catalogue beside them, an uneven clamp or a low-pass, may be as likely and is never true.
    """
    likeliest = [set(names.split(" + ")) - {NONE} for names, *_ in sorted(said.candidates, key=_cost_above)]
    return next((e for e in likeliest if e <= set(PLACES)), None) == set(wanted(outcome))


def _cost_above(candidate: tuple[str, float, float]) -> float:
    return candidate[1]


def part(outcome: Outcome, said: Said) -> bool:
    """Whether at least one of what was hidden was named."""
    return bool({*said.effects, *said.channels} & set(outcome.truth))


def wanted(outcome: Outcome) -> tuple[str, ...]:
    """The effects that leave a residual, and so belong into the verdict."""
    return tuple(name for name in outcome.truth if name not in OF_THE_CHANNELS_ALONE)


def answer(said: Said) -> str:
    """What was said in one word: the first effect, `unknown`, or what the channels show, or `none`."""
    if said.verdict == UNKNOWN:
        return UNKNOWN
    return next(iter((*said.effects, *said.channels)), NONE)


def confusion(outcomes: Sequence[Outcome]) -> dict[str, Counter[str]]:
    """Of clean cases and single effects: kind, to how often each answer was given."""
    table: dict[str, Counter[str]] = {}
    for o in outcomes:
        if o.said is not None and o.kind != PAIR:
            table.setdefault(o.kind, Counter())[answer(o.said)] += 1
    return {kind: table[kind] for kind in KINDS if kind in table}


def law_errors(stages: Iterable[StageFacts]) -> LawErrors:
    """Over all stages and frequencies; NaN where there is none."""
    sizes = [abs(e) for s in stages for e in (*s.storage_error_percent, *s.loss_error_percent)]
    return LawErrors(float(np.median(sizes)), float(np.max(sizes))) if sizes else LawErrors(np.nan, np.nan)


def _count(outcomes: Sequence[Outcome], holds: Callable[[Outcome, Said], bool]) -> int:
    return sum(o.said is not None and holds(o, o.said) for o in outcomes)


def _median(values: Iterable[float]) -> float:
    known = [v for v in values if not np.isnan(v)]
    return float(np.median(known)) if known else float("nan")
