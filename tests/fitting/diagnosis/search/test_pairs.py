"""Which two effects are tried: a wrong one may stand where the right one would begin."""

from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from pair_worlds import NOTHING, World, effect

from fitting.diagnosis.executor import ALONE
from fitting.diagnosis.search import catalogue_search as searching
from fitting.diagnosis.search.catalogue_search import ScoredFit, Search
from fitting.effects.base import Effect, EffectParameter


@pytest.mark.parametrize("wide", [False, True])
def test_a_wrong_effect_is_exchanged_beside_the_one_that_it_led_to(wide):
    world = World("wabc", w=200.0, w_a=180.0, w_c=185.0, a_b=100.0)
    assert world.found("w", wide=wide)[0] == {"a", "b"}


def test_what_an_exchange_leads_to_is_exchanged_again():
    world = World("wavbc", w=200.0, w_a=180.0, a_v=150.0, v_b=100.0)
    assert world.found("w")[0] == {"v", "b"}
    # Beside each effect others are looked for once, whichever pairs it is in.
    assert sorted(world.kept) == ["a", "b", "v", "w"]


def test_another_law_is_tried_beside_what_is_kept_of_the_best_two():
    world = World("wab", w=200.0, w_a=180.0, a_law=100.0)
    law = effect("law")
    law.replaces_law = True
    world.effects.append(law)
    assert world.found("w")[0] == {"a", "law"}
    assert {(one, goal) for one, _, goal in world.laws} == {("w", 180.0), ("a", 180.0)}


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

    def fitted(effects, law, u):
        begun.append(([e.name for e in effects], u.tolist()))

    search = SimpleNamespace(
        effects=[other, wide, Narrow()],
        executor=ALONE,
        work=SimpleNamespace(fit=fitted),
        judged=lambda found: found,
    )
    search._contained = partial(Search._contained, search)
    values = {other: np.zeros(0), wide: np.array([3.0, 0.1])}
    both = SimpleNamespace(effects=(other, wide), law=None, z=np.array([0.5]), of=values.get)
    Search.simpler(search, [ScoredFit(both, 0.0)])
    assert begun == [(["other", "narrow"], [0.5, 3.0])]


class Two(Effect):
    name, extends, twice = "two", "narrow", True


def test_two_of_a_thing_begin_where_one_was_found_and_a_look_sees_the_other(monkeypatch):
    begun, one = [], Narrow()
    monkeypatch.setattr(searching, "look", lambda *_: [(9.0, np.array([4.0])), (1.0, np.array([7.0]))])

    def fitted(effects, law, u):
        begun.append(([e.name for e in effects], u.tolist()))

    search = SimpleNamespace(
        effects=[effect("other"), one, Two()],
        problem=None,
        evidence=None,
        executor=ALONE,
        work=SimpleNamespace(fit=fitted),
        judged=lambda found: found,
        determined=lambda found: True,
    )
    search._doubled = partial(Search._doubled, search)
    alone = SimpleNamespace(effects=(one,), law=None, z=np.array([0.5]), of=lambda _: np.array([3.0]))
    other = SimpleNamespace(effects=(effect("other"),), law=None, z=np.array([0.5]), of=None)
    Search.twofold(search, [ScoredFit(other, 0.0), ScoredFit(alone, 1.0)])
    assert begun == [(["two"], [0.5, 3.0, 4.0]), (["two"], [0.5, 3.0, 7.0])]


def test_beside_what_is_near_the_best_a_second_effect_is_tried_that_may_come_as_far():
    world = World("wab", w=200.0, a=230.0, a_b=190.0)
    assert {"a", "b"} in world.found("w", "a")


def test_beside_what_is_near_the_best_none_is_that_does_not_pay_for_itself():
    world = World("wab", w=200.0, a=230.0, a_b=195.0)
    assert {"a", "b"} not in world.found("w", "a")


@pytest.mark.parametrize(("alone", "tried"), [(NOTHING - 1, True), (NOTHING, False)])
def test_beside_what_alone_is_no_better_than_nothing_none_is(alone, tried):
    world = World("wab", w=NOTHING - 10, a=alone, a_b=100.0)
    assert ({"a", "b"} in world.found("w", "a")) == tried


def test_beside_what_is_like_the_best_nothing_is_looked_at_that_promises_little_beside_the_best():
    world = World("wab", w=200.0, a=200.5, w_b=199.0, a_b=100.0)
    like = np.full(world.data, np.sqrt(2.0))
    of_all = world.fit

    def fit(*effects):
        fitted = of_all(*effects)
        fitted.residuals = like
        return fitted

    world.fit = fit
    assert {"a", "b"} not in world.found("w", "a")
    world.fit = of_all
    assert {"a", "b"} in world.found("w", "a")


def test_where_no_single_effect_was_fitted_none_leads():
    assert World("wab").leading([]) == []


def test_beside_what_is_far_from_the_best_none_is():
    world = World("wab", w=200.0, a=300.0, a_b=100.0)
    assert {"a", "b"} not in world.found("w", "a")


def test_where_one_of_two_suffices_alone_nothing_is_exchanged():
    world = World("wabc", w=200.0, w_a=180.0, a=170.0, w_c=185.0, a_b=100.0)
    assert {"a", "b"} not in world.found("w")
    assert not world.kept


def test_where_one_of_two_is_better_alone_but_will_not_do_the_other_is_exchanged(monkeypatch):
    world = World("wabc", w=200.0, w_a=180.0, a=170.0, w_c=185.0, a_b=100.0)
    monkeypatch.setattr(World, "allowed", lambda _, scored: 0.5)
    assert world.found("w")[0] == {"a", "b"}


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


def test_a_form_that_only_says_more_of_what_another_finds_stands_beside_no_effect():
    world = World("wab", w=200.0, w_a=150.0, w_b=160.0)
    world.candidates["a"][0].effect.beside_others = False
    assert world.found("w") == [{"w", "b"}]


@pytest.mark.parametrize(("refused", "followed"), [(1e-9, ["a", "b"]), (1e-40, [])])
def test_nobody_follows_to_its_very_end_what_is_past_help_however_it_ends(refused, followed):
    fits = {name: SimpleNamespace(effects=(effect(name),)) for name in "abc"}
    scored = [
        ScoredFit(fits["a"], 200.0, {"memory": 1e-20}),
        ScoredFit(fits["b"], 203.0, {"memory": refused}),
        ScoredFit(fits["c"], 300.0, {"memory": 0.5}),
    ]
    search = SimpleNamespace(reach=lambda best: best.cost + 12.0, _ends=[])
    moving = Search.moving(search, scored, scored[0])
    assert moving == [fits[name] for name in followed]


@pytest.mark.parametrize("wide", [False, True])
def test_where_one_may_suffice_it_is_followed_to_its_very_end_while_others_are_looked_at(wide):
    world = World("wab", w=200.0, a_b=500.0)
    world.moves = True
    world.found("w", wide=wide)
    assert list(world.ends.values()) == ([] if wide else ["its end"])


@pytest.mark.parametrize(
    ("wide", "data", "goal"), [(False, 100, np.inf), (True, 70, 150.0), (True, 100, 200.0)]
)
def test_where_one_leaves_much_pairs_are_followed_that_may_be_the_best_or_not_be_refused(wide, data, goal):
    world = World("wab", w=200.0, w_a=180.0, w_b=150.0)
    world.data = data
    world.found("w", wide=wide)
    assert world.goals[:2] == [goal, goal]


def test_what_is_far_behind_the_best_pair_when_fitted_roughly_is_not_followed():
    world = World("wab", w=900.0, w_a=100.0, w_b=390.0)
    world.found("w", wide=True)
    assert len(world.goals) == 2
    world = World("wab", w=900.0, w_a=100.0, w_b=410.0)
    world.found("w", wide=True)
    assert len(world.goals) == 1
