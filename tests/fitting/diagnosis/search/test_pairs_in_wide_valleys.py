"""Which two effects are begun in wide valleys, where no other two will do."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
from pair_worlds import World

from fitting.diagnosis.search.catalogue_search import ScoredFit
from fitting.diagnosis.thresholds import PAIRS, SEARCH, WIDE_VALLEYS


class Wanting(World):
    """None will do, and beside a fit alone a look shows nothing; in a wide valley it shows what there is."""

    evidence = None

    def __init__(self, names, **chi2):
        super().__init__(names, **chi2)
        self.candidates = {
            e.name: [SimpleNamespace(effect=e, fit_plain=lambda e=e: [self.fit(e)])] for e in self.effects
        }
        self.followed, self.went_on = [], []

    def judged(self, fitted):
        return ScoredFit(fitted, fitted.chi2, {"size": 1e-9})

    def look(self, before, forms):
        return [[(0.0, np.zeros(0))] for _ in forms]

    def look_wide(self, before, forms):
        return [[np.zeros(0)] for _ in forms]

    def begin_wide(self, before, form, starts):
        return [self.both(before, form) for _ in starts]

    def follow_wide(self, begun):
        self.followed.append(tuple(e.name for e in begun.effects))
        return begun

    noise_in_wide_valleys = 300.0

    def left_in_wide_valley(self, fitted):
        return fitted.chi2

    def follow_briefly(self, wide):
        self.went_on.append(tuple(e.name for e in wide.effects))
        return wide

    def follow_roughly(self, brief):
        return brief

    def fit_plainly(self, names):
        pass

    def order_of_plain(self):
        return [e.name for e in self.effects]


def wanting(monkeypatch, wide, names, **chi2):
    few = {
        "SEARCH": replace(SEARCH, leaders=1),
        "PAIRS": replace(PAIRS, fitted=1, fitted_a_leader=1),
        "WIDE_VALLEYS": replace(WIDE_VALLEYS, followed=wide, leaders=3),
    }
    for name, thresholds in few.items():
        monkeypatch.setattr(f"fitting.diagnosis.search.pairs.{name}", thresholds)
    return Wanting(names, **chi2)


def test_where_none_will_do_a_pair_is_found_from_where_the_wide_valley_led(monkeypatch):
    world = wanting(monkeypatch, 4, "wabc", w=200.0, w_c=150.0)
    assert world.found("w", wide=True)[0] == {"w", "c"}


def test_of_what_begins_in_wide_valleys_the_best_go_on_and_the_best_of_every_leader(monkeypatch):
    world = wanting(monkeypatch, 4, "wabc", w=200.0, w_c=150.0, w_b=160.0, b_c=300.0)
    world.found("w", wide=True)
    # Three lead; what is left goes to the best of all.
    assert [two[0] for two in world.followed] == ["w", "b", "a", "w"]
    assert world.followed[:2] == [("w", "c"), ("b", "w")]
    assert world.followed[3] == ("w", "b")


def test_what_leaves_far_more_in_its_wide_valley_than_is_known_goes_no_further(monkeypatch):
    world = wanting(monkeypatch, 4, "wabc", w=200.0, w_c=150.0, w_b=610.0, b_c=300.0)
    world.found("w", wide=True)
    assert sorted(world.went_on) == [("b", "c"), ("w", "c")]


def test_in_wide_valleys_none_begins_beside_two_of_a_kind_but_beside_the_one(monkeypatch):
    world = wanting(monkeypatch, 9, "wabc", w=200.0, w_c=150.0)
    twice = world.effects[0]
    type(twice).twice, type(twice).extends = True, "a"
    world.found("w", wide=True)
    assert {two[0] for two in world.followed} == {"a", "b"}
