"""Which two effects are tried: a wrong one may stand where the right one would begin."""

from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from fitting.diagnosis.executor import ALONE
from fitting.diagnosis.pairs import Pairs
from fitting.diagnosis.search import ScoredFit, Search
from fitting.effects.base import Effect, EffectParameter

NOTHING = 1000.0
"""Chi-square of two effects that are not in a world's list."""


def effect(name):
    return type(name, (Effect,), {"name": name})()


class World:
    """A search in which chi-square is known of every two effects and a look sees it; costs are the same."""

    executor = ALONE

    def __init__(self, names, **chi2):
        self.effects = [effect(n) for n in names]
        self.chi2 = {frozenset(two.split("_")): value for two, value in chi2.items()}
        self.work, self.kept = self, []

    def fit(self, *effects):
        chi2 = self.chi2.get(frozenset(e.name for e in effects), NOTHING)
        return SimpleNamespace(effects=effects, chi2=chi2, chi2_per_dof=1.0)

    def judged(self, fitted):
        return ScoredFit(fitted, fitted.chi2)

    def alone(self, one):
        self.kept.append(one[1].name)
        return self.fit(one[1])

    def second(self, one):
        before, (name, _), _, _ = one
        return self.fit(*before.effects, *(e for e in self.effects if e.name == name))

    def look(self, one):
        before, forms = one
        after = [self.second((before, form, None, None)) for form in forms]
        return [[(before.chi2 - f.chi2, np.zeros(0))] for f in after]

    def at_rest(self, scored_fits, best):
        return list(scored_fits)

    def simpler(self, scored):
        return []

    def temper(self, best):
        return 1.0

    def allowed(self, scored):
        return 1.0

    def has_places(self, name):
        return False

    def goal(self, best):
        return best.chi2

    def found(self, *singles, wide=False):
        alone = [self.judged(self.fit(e)) for n in singles for e in self.effects if e.name == n]
        return [set(t.names) for t in Pairs(self).best(alone, lambda fraction: None, wide=wide)]


@pytest.mark.parametrize("wide", [False, True])
def test_a_wrong_effect_is_exchanged_beside_the_one_that_it_led_to(wide):
    world = World("wabc", w=200.0, w_a=180.0, w_c=185.0, a_b=100.0)
    assert world.found("w", wide=wide)[0] == {"a", "b"}


def test_what_an_exchange_leads_to_is_exchanged_again():
    world = World("wavbc", w=200.0, w_a=180.0, a_v=150.0, v_b=100.0)
    assert world.found("w")[0] == {"v", "b"}
    # Beside each effect others are looked for once, whichever pairs it is in.
    assert sorted(world.kept) == ["a", "b", "v", "w"]


def test_where_no_two_effects_do_better_than_one_nothing_is_exchanged():
    world = World("wab", w=200.0, w_a=210.0, a_b=100.0)
    assert {"a", "b"} not in world.found("w", wide=True)
    assert not world.kept


class Wide(Effect):
    """It contains `Narrow`."""

    name, parameters = (
        "wide",
        (EffectParameter("k", "1", 0.0, 9.0, 1.0), EffectParameter("loss", "1", 0.0, 9.0, 1.0)),
    )

    def within(self, u):
        return ((Narrow(), u[:1]),)


class Narrow(Effect):
    name, parameters = "narrow", (EffectParameter("k", "1", 0.0, 9.0, 1.0),)


def test_what_an_effect_of_two_contains_is_fitted_in_its_place():
    begun = []
    other, wide = effect("other"), Wide()

    def fitted(one):
        effects, _, u = one
        begun.append(([e.name for e in effects], u.tolist()))

    search = SimpleNamespace(
        effects=[other, wide, Narrow()],
        executor=ALONE,
        work=SimpleNamespace(fitted=fitted),
        judged=lambda found: found,
    )
    search._contained = partial(Search._contained, search)
    values = {other: np.zeros(0), wide: np.array([3.0, 0.1])}
    both = SimpleNamespace(effects=(other, wide), law=None, z=np.array([0.5]), of=values.get)
    Search.simpler(search, [ScoredFit(both, 0.0)])
    assert begun == [(["other", "narrow"], [0.5, 3.0])]


def test_beside_what_is_near_the_best_a_second_effect_is_tried_that_may_come_as_far():
    world = World("wab", w=200.0, a=230.0, a_b=195.0)
    assert {"a", "b"} in world.found("w", "a")


def test_beside_what_is_far_from_the_best_none_is():
    world = World("wab", w=200.0, a=300.0, a_b=100.0)
    assert {"a", "b"} not in world.found("w", "a")


def test_of_pairs_as_good_as_the_best_each_has_its_say():
    world = World("wabc", w=200.0, w_c=180.0, w_a=185.0, a_b=100.0)
    assert world.found("w")[0] == {"a", "b"}


def test_what_is_far_behind_the_best_pair_is_not_exchanged():
    world = World("wabc", w=200.0, w_c=150.0, w_a=185.0, a_b=100.0)
    assert {"a", "b"} not in world.found("w")


def test_beside_a_best_pair_that_fails_those_as_bad_are_not_exchanged(monkeypatch):
    world = World("wabc", w=200.0, w_c=180.0, w_a=185.0, a_b=100.0)
    monkeypatch.setattr(World, "judged", lambda _, fitted: ScoredFit(fitted, fitted.chi2, {"size": 0.0}))
    assert {"a", "b"} not in world.found("w")
    assert sorted(world.kept) == ["c", "w"]
