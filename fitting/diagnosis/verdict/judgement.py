"""Which explanations the data support, how probable each is, and whether any of them will do.

One rule ranks: prior times marginal likelihood (`marginal`). The group is every explanation up to 95 %. One
test refuses: such data are not what it would leave (`predictive`).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from fitting.diagnosis.inference.marginal import probabilities
from fitting.diagnosis.search.catalogue_search import ScoredFit, best_of_each
from fitting.diagnosis.thresholds import VERDICT
from fitting.diagnosis.verdict.equivalents import equivalents_of
from fitting.diagnosis.verdict.kin import UNLISTED, Kin, Unlisted
from fitting.diagnosis.verdict.refusing import HeldOut, against
from fitting.diagnosis.verdict.result import Verdict
from fitting.diagnosis.verdict.shares import group_of, shares_of
from fitting.digits import two_digits

_MOST_OF_KIN = 1 - 1e-9
"""Cap on the probability of kin, so that what is listed keeps its order in floating point."""


@dataclass(frozen=True)
class Judgement:
    """The accepted explanation (None for none) and each of its effects' equals."""

    verdict: Verdict
    accepted: ScoredFit | None
    equivalent: dict[str, tuple[str, ...]]
    """With `NONE` where that nothing is there is in the group."""
    group: tuple[tuple[ScoredFit, float], ...] = ()
    """Every explanation up to 95 %, none too where it may be; their probabilities add up to one."""
    probability: Mapping[tuple[str, ...], float] = field(default_factory=dict)
    """Of every explanation, by its effects' names."""
    confirmed: bool = True
    """False for two effects that predict what was held out no better than none does.

    Two effects have so many numbers that together they come near to a third: a fit alone is no proof.
    """
    by_hand: bool = False
    """Accepted on someone's word, not by the data's."""
    refused: tuple[str, ...] = ()
    """What comes nearest where nothing will do."""
    why: str = ""
    """What speaks against `refused`: half a sentence that it is the subject of."""
    note: str = ""
    """What is said in the place of a story of the effects: whole sentences."""
    unlisted: Unlisted | None = None
    """The combined kin of explanations that nothing refuses; None where nothing may be named, or kin is not
    computed."""

    @property
    def share_of_kin(self) -> float:
        """Probability of what is in no catalogue."""
        return self.probability.get((UNLISTED,), 0.0)

    @property
    def is_doubted(self) -> bool:
        """Whether what is in no catalogue may as well be there."""
        return _is_doubted(self.share_of_kin)

    def weighing(self, none: ScoredFit) -> list[tuple[ScoredFit, float]]:
        """Explanations whose laws are mixed into the band, and their weights.

        Where nothing explains the readings, two that are wrong say how far laws may be apart: that of no
        effect, and that of something like what comes nearest.
        """
        if self.unlisted is None:
            return list(self.group)
        if self.verdict == "unknown":
            return [(none, VERDICT.law_of_none), (self.unlisted, 1 - VERDICT.law_of_none)]
        akin = self.share_of_kin
        listed = [(t, (1 - akin) * share) for t, share in self.group]
        return [*listed, *((t, akin * share) for t, share in self.unlisted.weighing(none))]

    @property
    def weighs_wrong_laws(self) -> bool:
        """Whether the laws of `weighing` say no more than how far laws may be apart."""
        return self.verdict == "unknown"

    def of_effect(self, name: str) -> float:
        """Probability that an effect is there, alone or beside another."""
        return float(sum(p for names, p in self.probability.items() if name in names))


def _is_doubted(share_of_kin: float) -> bool:
    return share_of_kin > 1 - VERDICT.credible


def judged_by_hand(scored: ScoredFit) -> Judgement:
    """What someone has decided: each effect stands for itself."""
    names: dict[str, tuple[str, ...]] = {name: (name,) for name in scored.names}
    return Judgement(
        "effect" if names else "none",
        scored if names else None,
        names,
        group=((scored, 1.0),),
        probability={scored.names: 1.0},
        by_hand=True,
    )


def in_light_of(judgement: Judgement, p_value: float | None) -> Judgement:
    """Withdraws a name that sweeps without any effect would earn too. The band stays the group's."""
    if (
        p_value is None
        or p_value <= 1 - VERDICT.credible + 1e-9
        or judgement.verdict not in ("effect", "ambiguous")
    ):
        return judgement
    why = f"gains what up to {two_digits(100 * p_value)} % of sweeps without any effect gain"
    nearest = judgement.accepted.names if judgement.accepted is not None else ()
    return replace(judgement, verdict="none", accepted=None, equivalent={}, refused=nearest, why=why)


def beside_another_law(judgement: Judgement, names: tuple[str, ...]) -> Judgement:
    """Another law is not told from effects of these names, which the data would show as one."""
    accepted = judgement.accepted
    of_law = {e.name for e in accepted.fitted.effects if e.replaces_law} if accepted is not None else set()
    if not (names and of_law):
        return judgement
    equivalent = {n: (*group, *names) if n in of_law else group for n, group in judgement.equivalent.items()}
    return replace(judgement, verdict="ambiguous", equivalent=equivalent)


def judge(
    none: ScoredFit,
    scored_fits: Sequence[ScoredFit],
    *,
    held_out: HeldOut,
    kin: Callable[[ScoredFit], Kin | None] = lambda scored: None,
) -> Judgement:
    """Weigh explanations.

    `held_out`: error of an explanation over noise on data it has not seen, NaN where there are none. `kin`:
    of one, what is in no catalogue.
    """
    every = best_of_each([none, *scored_fits])
    p = shares_of(every)
    order = np.argsort(-p, kind="stable")
    ranked = [(every[k], float(p[k])) for k in order]
    named = [t for t, _ in group_of(ranked) if t.names]
    if not named or _may_be_none(ranked, named[0]):
        weighed = _Weighed(ranked)
        if none.fails:
            return _unknown(weighed, none)
        return weighed.judgement("none", None)
    standing = [t for t in named if not against(none, t, held_out)]
    weighed = _beside_kin(ranked, {t: kin(t) for t in standing or named})
    if not standing:
        return _unknown(weighed, named[0], against(none, named[0], held_out))
    best = standing[0]
    if weighed.share_of_kin > VERDICT.kin_favoured * (1 - weighed.share_of_kin):
        share = two_digits(100 * weighed.share_of_kin)
        why = f"is less likely than something of its kind that is in no catalogue, which has {share} %"
        return _unknown(weighed, best, why)
    alone = all(set(best.names) <= set(t.names) for t, _ in weighed.group)
    sure = len(best.names) < 2 or held_out(best) < held_out(none)
    certain = alone and sure and _is_firm(best) and not _is_doubted(weighed.share_of_kin)
    return weighed.judgement("effect" if certain else "ambiguous", best, confirmed=sure)


def _may_be_none(ranked: Sequence[tuple[ScoredFit, float]], best: ScoredFit) -> bool:
    """Whether that nothing is there is likely enough beside the best that may be named."""
    nothing = next(share for t, share in ranked if not t.names)
    of_best = next(share for t, share in ranked if t is best)
    return nothing > max(VERDICT.least_doubted, VERDICT.favoured * of_best)


def _is_firm(best: ScoredFit) -> bool:
    """Whether nothing about an explanation itself keeps it from being certain."""
    # Beside another, what stands in for something leaves room for anything, refused or not.
    leaves_room = len(best.names) > 1 and (best.stands_in or best.unsized)
    return not leaves_room and best.strains is None and not best.too_large


@dataclass(frozen=True)
class _Weighed:
    """Every explanation with its probability, the likeliest first."""

    ranked: Sequence[tuple[ScoredFit, float]]
    unlisted: Unlisted | None = None
    share_of_kin: float = 0.0

    @property
    def probability(self) -> dict[tuple[str, ...], float]:
        found = {t.names: share * (1 - self.share_of_kin) for t, share in self.ranked}
        return found if self.unlisted is None else found | {self.unlisted.names: self.share_of_kin}

    @property
    def group(self) -> tuple[tuple[ScoredFit, float], ...]:
        return group_of(self.ranked)

    def judgement(
        self,
        verdict: Verdict,
        accepted: ScoredFit | None,
        *,
        confirmed: bool = True,
        refused: tuple[str, ...] = (),
        why: str = "",
    ) -> Judgement:
        equivalent = equivalents_of(accepted, self.group) if accepted is not None else {}
        if _is_doubted(self.share_of_kin):
            equivalent = {name: (*group, UNLISTED) for name, group in equivalent.items()}
        return Judgement(
            verdict,
            accepted,
            equivalent,
            self.group,
            self.probability,
            confirmed,
            refused=refused,
            why=why,
            unlisted=self.unlisted,
        )


def _beside_kin(
    ranked: Sequence[tuple[ScoredFit, float]],
    kin: Mapping[ScoredFit, Kin | None],
) -> _Weighed:
    """Explanations with the kin of some of them as one more.

    Kin is weighted by the costs of their fits alone, without the correction that `shares_of` makes for
    explanations that may stand in for something else.
    """
    asked = [t for t, _ in ranked if t in kin]
    shares = probabilities(np.array([t.cost for t in asked])).tolist()
    each = [(t, kin[t], share) for t, share in zip(asked, shares, strict=True)]
    akin = [(t, own, share * own.odds, share) for t, own, share in each if own is not None]
    akin.sort(key=lambda one: -one[2])
    beside = sum(share for *_, share, _ in akin)
    if not beside > 0:
        return _Weighed(ranked)
    first, _, _, share_of_first = akin[0]
    of = tuple((t, own, share / beside) for t, own, share, _ in akin)
    cost = first.cost - 2 * float(np.log(beside) - np.log(share_of_first))
    return _Weighed(ranked, Unlisted(first.fitted, cost, of=of), min(beside / (1 + beside), _MOST_OF_KIN))


def _unknown(weighed: _Weighed, nearest: ScoredFit, why: str = "") -> Judgement:
    best = nearest if nearest.names else next((t for t, _ in weighed.ranked if t.names), nearest)
    return weighed.judgement("unknown", None, refused=best.names if why else (), why=why)
