"""Which candidates the data support, which they cannot tell apart, and whether any of them will do.

Differences in BIC. The thresholds are calibrated on sweeps of a 3D solid (docs/diagnosis.md).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from fitting.diagnosis.result import Verdict
from fitting.diagnosis.search import Trial
from fitting.effects.base import Effect

WITHIN = 15.0
"""Candidates this near to the best are not told from it."""
FIRST = 7.0
"""A first effect must gain this much over none."""
SECOND = 12.0
"""A second effect must gain this much, and more where the first one's model `misses` something."""
PREDICTED = 2.0
"""Times the noise on data held out: as good as can be asked of anything."""
NO_WORSE = 1.25
"""Times the error of the first effect alone, that a pair may make on data held out."""
POOR, HARDLY_BETTER = 3.0, 0.5
"""Times the noise, and times the error without any effect: what predicts no better explains nothing."""
EXTENSION, HINTED = 9.0, 3.0
"""Chi-square to be gained over a simpler effect that is contained: to be named, and to be held possible."""
WITHIN_UNKNOWN_NOISE, FIRST_UNKNOWN_NOISE = 10.0, 6.0
"""The same where noise is estimated from the residual itself."""
GOOD = 1.15
"""Chi-square per degree of freedom of an explanation that needs nothing more."""
TOO_MUCH = 1.25
"""Chi-square per degree of freedom that no candidate may leave, but for what its own model misses."""


@dataclass(frozen=True)
class Judgement:
    """The accepted candidate (None for none) and each of its effects' equals."""

    verdict: Verdict
    accepted: Trial | None
    equivalent: dict[str, tuple[str, ...]]
    by_hand: bool = False
    """Accepted on someone's word, not by the data's."""
    refused: tuple[str, ...] = ()
    """What comes nearest where nothing will do."""
    why: str = ""
    """What speaks against it: half a sentence."""


def told(trial: Trial) -> Judgement:
    """What someone has decided: each effect stands for itself."""
    names: dict[str, tuple[str, ...]] = {name: (name,) for name in trial.names}
    return Judgement("effect" if names else "none", trial if names else None, names, by_hand=True)


def idle_over(trial: Trial, trials: Sequence[Trial]) -> tuple[str, ...]:
    """Simpler effects that one of a trial's contains and gains too little over."""
    by_names = {frozenset(t.names): t for t in trials}
    found = []
    for effect in trial.fitted.effects:
        if effect.extends is None:
            continue
        simpler = by_names.get(frozenset(trial.names) - {effect.name} | {effect.extends})
        if simpler is None or (simpler.leans and not trial.leans):
            continue
        if not trial.fitted.chi2 < simpler.fitted.chi2 - EXTENSION:
            found.append(effect.extends)
    return tuple(found)


def standing_for(trial: Trial, trials: Sequence[Trial]) -> dict[str, tuple[str, ...]]:
    """Of each of a trial's effects, what may be meant by it: a simpler one, or a wider one hinted at."""
    idle, found = idle_over(trial, trials), {}
    for effect in trial.fitted.effects:
        rest = set(trial.names) - {effect.name}
        names = [effect.extends] if effect.extends in idle else []
        for other in trials:
            wider = [e for e in other.fitted.effects if e.extends == effect.name]
            if wider and set(other.names) == rest | {wider[0].name}:
                names += [wider[0].name] * (other.fitted.chi2 < trial.fitted.chi2 - HINTED)
        found[effect.name] = tuple(name for name in dict.fromkeys(names) if name is not None)
    return found


def without_idle_extensions(trials: Sequence[Trial], unnamed: Sequence[Effect] = ()) -> list[Trial]:
    """Trials best first, those left out that contain a simpler one and gain too little over it.

    Where the simpler one may not be named, the other stays and stands for it.
    """
    hidden = {e.name for e in unnamed}
    return [t for t in trials if not hidden & set(t.names) and hidden >= set(idle_over(t, trials))]


def foremost(none: Trial, singles: Sequence[Trial]) -> Trial:
    """The best of those near the top that does not lean; the best where all do."""
    limit = min(singles[0].bic + WITHIN, none.bic - FIRST)
    return next((t for t in singles if t.bic < limit and not t.leans), singles[0])


def judge(
    none: Trial,
    singles: Sequence[Trial],
    pairs: Sequence[Trial],
    *,
    noise_known: bool,
    structured: bool,
    held_out: Callable[[Trial], float],
    meant: Callable[[Trial], Mapping[str, tuple[str, ...]]],
) -> Judgement:
    """Weigh trials, best first.

    `structured`: whether the fit without any effect leaves more than chance. `held_out`: error of a trial
    over noise on data it has not seen, NaN where there are none. `meant`: what else may be meant by each
    effect of a trial.
    """
    first = FIRST if noise_known else FIRST_UNKNOWN_NOISE
    if not singles or none.bic - singles[0].bic < first:
        much = noise_known and structured and _leaves_too_much(none, none)
        return Judgement("unknown" if much else "none", None, {})
    pairs = _without_flexible(singles, pairs)
    alone = foremost(none, singles)
    second = _second(none, alone, pairs, held_out)
    best = second or alone
    why = _against(none, best, held_out, structured=structured) if noise_known else ""
    if why:
        nearest = min([best, *pairs[:1]], key=lambda t: t.bic)
        also = _against(none, nearest, held_out, structured=structured)
        refused = nearest if also else best
        return Judgement("unknown", None, {}, refused=refused.names, why=also or why)
    within = WITHIN if noise_known else WITHIN_UNKNOWN_NOISE
    near = [t for t in (pairs if second else singles) if t.bic - best.bic < within and not t.leans]
    equivalent, others_meant = {}, meant(best)
    for name in best.names:
        rest = set(best.names) - {name}
        others = (
            [set(t.names) - rest for t in near if rest < set(t.names)]
            if rest
            else [set(t.names) for t in near]
        )
        names = [name, *(n for o in others for n in o if n != name), *others_meant.get(name, ())]
        equivalent[name] = tuple(dict.fromkeys(names))
    apart = all(len(group) == 1 for group in equivalent.values())
    return Judgement("effect" if apart else "ambiguous", best, equivalent)


def _against(none: Trial, best: Trial, held_out: Callable[[Trial], float], *, structured: bool) -> str:
    """Why the best explanation is none; empty where nothing speaks against it."""
    if _leaves_too_much(none, best):
        return f"leaves {best.fitted.chi2_per_dof:.3g} times what noise and model error explain"
    if best.leans:
        return "fits only if the plate were off by more than a layer-wise plate is"
    # What is too weak to show as structure is too weak to be refuted by what it predicts.
    if structured and _predicts_nothing(none, best, held_out):
        return "does not predict the segments it has not seen"
    return ""


def _second(
    none: Trial, best: Trial, pairs: Sequence[Trial], held_out: Callable[[Trial], float]
) -> Trial | None:
    """The pair that explains more than an error of the first effect's own model could, and predicts it."""
    # What the first one's own model misses looks like another effect; where it leans, it is more than that.
    wanted = FIRST if best.leans else SECOND + _missed(none, best)
    poor = best.leans or _leaves_too_much(none, best)
    suffices = not poor and not _predicts_nothing(none, best, held_out)
    for pair in pairs:
        if not best.bic - pair.bic > wanted or pair.bic > pairs[0].bic + WITHIN:
            return None
        if pair.leans:
            continue
        off = held_out(pair)
        worse = off > POOR or off > max(PREDICTED, NO_WORSE * held_out(best))
        if not (worse if suffices else _predicts_nothing(none, pair, held_out)):
            return pair
    return None


def _missed(none: Trial, trial: Trial) -> float:
    """Chi-square that the models of a trial's effects may leave themselves."""
    return max((e.misses for e in trial.fitted.effects), default=0.0) * (none.bic - trial.bic)


def _leaves_too_much(none: Trial, trial: Trial) -> bool:
    """More than noise, and more than its effects' own models miss."""
    share = trial.fitted.chi2_per_dof / TOO_MUCH
    return share > 1 and trial.fitted.chi2 * (1 - 1 / share) > _missed(none, trial)


def _predicts_nothing(none: Trial, best: Trial, held_out: Callable[[Trial], float]) -> bool:
    """Whether data that were held out speak against an explanation that fits by another law's freedom."""
    if not any(e.replaces_law for e in best.fitted.effects):
        return False
    off = held_out(best)
    return off > POOR and off > HARDLY_BETTER * held_out(none)


def _without_flexible(singles: Sequence[Trial], pairs: Sequence[Trial]) -> list[Trial]:
    """Pairs, those with another law left out where an explanation without one is good enough.

    A law free to bend takes up half of any effect: with a second one beside it it explains too much.
    """
    plain = [p for p in pairs if not any(e.replaces_law for e in p.fitted.effects)]
    candidates = [t for t in (*singles[:1], *plain[:1]) if not any(e.replaces_law for e in t.fitted.effects)]
    return plain if any(t.fitted.chi2_per_dof < GOOD for t in candidates) else list(pairs)
