"""Which candidates the data support, which they cannot tell apart, and whether any of them will do.

Differences in BIC. The thresholds are calibrated on sweeps of a 3D solid (docs/diagnosis.md).
"""

from collections.abc import Sequence
from dataclasses import dataclass

from fitting.diagnosis.result import Verdict
from fitting.diagnosis.search import Trial

WITHIN = 15.0
"""Candidates this near to the best are not told from it."""
FIRST = 7.0
"""A first effect must gain this much over none."""
SECOND = 20.0
"""A second effect must gain this much: less can be feigned by the plate model's own error."""
EXTENSION = 9.0
"""Chi-square that a candidate must gain over a simpler one it contains: three standard errors."""
WITHIN_UNKNOWN_NOISE, FIRST_UNKNOWN_NOISE = 10.0, 6.0
"""The same where noise is estimated from the residual itself."""
GOOD = 1.15
"""Chi-square per degree of freedom of an explanation that needs nothing more."""
TOO_MUCH = 2.2
"""Chi-square per degree of freedom that no candidate may leave."""


@dataclass(frozen=True)
class Judgement:
    """The accepted candidate (None for none) and each of its effects' equals."""

    verdict: Verdict
    accepted: Trial | None
    equivalent: dict[str, tuple[str, ...]]
    by_hand: bool = False
    """Accepted on someone's word, not by the data's."""


def told(trial: Trial) -> Judgement:
    """What someone has decided: each effect stands for itself."""
    names: dict[str, tuple[str, ...]] = {name: (name,) for name in trial.names}
    return Judgement("effect" if names else "none", trial if names else None, names, by_hand=True)


def without_idle_extensions(trials: Sequence[Trial]) -> list[Trial]:
    """Trials best first, those left out that contain a simpler one and gain too little over it."""
    by_names = {frozenset(t.names): t for t in trials}
    kept = []
    for trial in trials:
        simpler = [
            by_names.get(frozenset(trial.names) - {e.name} | {e.extends})
            for e in trial.fitted.effects
            if e.extends is not None
        ]
        if all(s is None or trial.fitted.chi2 < s.fitted.chi2 - EXTENSION for s in simpler):
            kept.append(trial)
    return kept


def judge(
    none: Trial, singles: Sequence[Trial], pairs: Sequence[Trial], *, noise_known: bool, structured: bool
) -> Judgement:
    """`structured`: whether the fit without any effect leaves more than chance."""
    first = FIRST if noise_known else FIRST_UNKNOWN_NOISE
    within = WITHIN if noise_known else WITHIN_UNKNOWN_NOISE
    if not singles or none.bic - singles[0].bic < first:
        much = noise_known and structured and none.fitted.chi2_per_dof > TOO_MUCH
        return Judgement("unknown" if much else "none", None, {})
    best, pairs = singles[0], _without_flexible(singles, pairs)
    if pairs and best.bic - pairs[0].bic > SECOND:
        best = pairs[0]
    if noise_known and best.fitted.chi2_per_dof > TOO_MUCH:
        return Judgement("unknown", None, {})
    near = [t for t in (singles if len(best.names) == 1 else pairs) if t.bic - best.bic < within]
    equivalent = {}
    for name in best.names:
        rest = set(best.names) - {name}
        others = (
            [set(t.names) - rest for t in near if rest < set(t.names)]
            if rest
            else [set(t.names) for t in near]
        )
        names = [name, *(n for o in others for n in o if n != name)]
        equivalent[name] = tuple(dict.fromkeys(names))
    alone = all(len(group) == 1 for group in equivalent.values())
    return Judgement("effect" if alone else "ambiguous", best, equivalent)


def _without_flexible(singles: Sequence[Trial], pairs: Sequence[Trial]) -> list[Trial]:
    """Pairs, those with another law left out where an explanation without one is good enough.

    A law free to bend takes up half of any effect: with a second one beside it it explains too much.
    """
    plain = [p for p in pairs if not any(e.replaces_law for e in p.fitted.effects)]
    candidates = [t for t in (*singles[:1], *plain[:1]) if not any(e.replaces_law for e in t.fitted.effects)]
    return plain if any(t.fitted.chi2_per_dof < GOOD for t in candidates) else list(pairs)
