"""Searches for two effects in which all that fits would find is known beforehand."""

from types import SimpleNamespace

import numpy as np

from fitting.diagnosis.executor import ALONE
from fitting.diagnosis.search.catalogue_search import ScoredFit, Search
from fitting.diagnosis.search.pairs import Pairs
from fitting.effects.base import Effect

NOTHING = 1000.0
"""Chi-square of two effects that are not in a world's list."""


def effect(name):
    return type(name, (Effect,), {"name": name})()


class World:
    """A search in which chi-square is known of every two effects and a look sees it; costs are the same."""

    executor, data = ALONE, 100

    def __init__(self, names, **chi2):
        self.effects = [effect(n) for n in names]
        self.chi2 = {frozenset(two.split("_")): value for two, value in chi2.items()}
        self.work, self.kept, self.goals, self.laws, self.ends = self, [], [], [], {}
        self.candidates = {e.name: [SimpleNamespace(effect=e)] for e in self.effects}

    def fit(self, *effects):
        chi2 = self.chi2.get(frozenset(e.name for e in effects), NOTHING)
        # What is left of two is not alike.
        left = np.random.default_rng([ord(c) for e in effects for c in e.name]).normal(size=self.data)
        return SimpleNamespace(
            effects=effects,
            chi2=chi2,
            residuals=left * np.sqrt(chi2 / np.sum(left**2)),
            chi2_per_dof=1.0,
            data=self.data,
            converged=True,
        )

    def judged(self, fitted):
        return ScoredFit(fitted, fitted.chi2)

    leading, left_by, suffices = Search.leading, Search.left_by, Search.suffices

    @property
    def none(self):
        return self.judged(self.fit())

    def alone(self, scored):
        return [self.judged(self.fit(e)) for e in scored.fitted.effects]

    def evaluate_alone(self, pair, effect):
        self.kept.append(effect.name)
        return self.fit(effect)

    def fit_second(self, before, form, starts, goal):
        return self.both(before, form)

    fit_second_roughly = fit_second

    def both(self, before, form):
        return self.fit(*before.effects, *(e for e in self.effects if e.name == form[0]))

    def follow_to_end(self, rough, goal):
        self.goals.append(goal)
        return rough

    def fit_other_laws_beside(self, before, name, goal):
        self.laws.append((before.effects[0].name, name, goal))
        return [self.both(before, (name, 0))]

    def look(self, before, forms):
        after = [self.both(before, form) for form in forms]
        return [[(before.chi2 - f.chi2, np.zeros(0))] for f in after]

    def follow_to_convergence(self, fitted):
        return "its end"

    def converged_group(self, scored_fits, best):
        return list(scored_fits)

    moves = False

    def moving(self, scored_fits, best):
        return [t.fitted for t in scored_fits] if self.moves else []

    def keep_converged(self, fits, ends):
        self.ends |= dict(zip([f.effects for f in fits], ends, strict=True))

    def simpler(self, scored):
        return []

    def temper(self, best):
        return 1.0

    def allowed(self, scored):
        return 1.0

    def unrefused(self, effects):
        return 2.0 * self.data

    def has_places(self, name):
        return False

    def goal(self, best):
        return best.chi2

    def found(self, *singles, wide=False):
        alone = [self.judged(self.fit(e)) for n in singles for e in self.effects if e.name == n]
        found = Pairs(self).best(alone, lambda fraction: None, wide=wide)
        return [set(t.names) for t in found if len(t.names) == 2]
