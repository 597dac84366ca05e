"""What stands in the place of each effect of the best explanation, in the others of its group."""

from collections.abc import Mapping, Sequence
from itertools import permutations

from fitting.diagnosis.search.catalogue_search import ScoredFit
from fitting.diagnosis.verdict.names import NONE


def equivalents_of(best: ScoredFit, group: Sequence[tuple[ScoredFit, float]]) -> dict[str, tuple[str, ...]]:
    """For each effect of the best what stands in its place in others of the group.

    What comes beside another of the group stands in no place of its own: that other one does.
    """
    every = [set(t.names) for t, _ in group if t.names]
    shown = [one for one in every if not one <= set(best.names)]
    others = [t.names for t, _ in group if not any(one < set(t.names) for one in shown)]
    alone = {name: _instead_of(name, best.names, others) for name in best.names}
    beside = {n for t, _ in group if set(best.names) < set(t.names) for n in t.names}
    found = {}
    for name in best.names:
        names = [name]
        for other in others:
            if not other:
                names.append(NONE)
            elif name not in other:
                there = [n for n in other if n in _for(name, other, alone)]
                names += [n for n in there if n not in beside] or there
        found[name] = tuple(dict.fromkeys(names))
    return found


def _instead_of(name: str, best: Sequence[str], others: Sequence[Sequence[str]]) -> set[str]:
    """What stands in the place of one effect in explanations that keep the rest of the best."""
    rest = set(best) - {name}
    return {n for one in others if name not in one and rest <= set(one) for n in set(one) - rest}


def _for(name: str, other: Sequence[str], alone: Mapping[str, set[str]]) -> set[str]:
    """What of another explanation, which lacks an effect of the best, stands in its place.

    `alone` says of each effect of the best what stands for it beside the rest. Where both are exchanged at
    once each stands for what it stands for alone, if that is known; else for either.
    """
    best = set(alone)
    if best & set(other):
        return set(other) - best if best - {name} <= set(other) else set()
    if len(other) != len(best):
        return set(other)
    known = set[str]().union(*alone.values())
    pairings = (dict(zip(alone, order, strict=True)) for order in permutations(other))
    fitting = [p for p in pairings if all(n in alone[e] or n not in known for e, n in p.items())]
    return {p[name] for p in fitting} or set(other)
