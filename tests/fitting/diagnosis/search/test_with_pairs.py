"""When pairs are looked for, and how often."""

from types import SimpleNamespace

import pytest

from fitting.diagnosis.search import with_pairs as module
from fitting.diagnosis.search.catalogue_search import ScoredFit
from fitting.diagnosis.search.with_pairs import with_pairs


def scored(cost, *names):
    effects = tuple(SimpleNamespace(name=name) for name in names)
    return ScoredFit(SimpleNamespace(effects=effects, parameter_count=5), cost)


def search(*, suffices=True, left=1.0, count=1000, known=True):
    return SimpleNamespace(
        evidence=SimpleNamespace(scale_known=known, count=count),
        none=scored(500.0),
        suffices=lambda one: suffices,
        left_by=lambda one: left,
    )


@pytest.fixture
def asked(monkeypatch):
    """What pairs were looked for about, and whether widely; `answers` are given in turn."""

    class Pairs:
        answers, calls = [], []

        def __init__(self, of):
            pass

        def best(self, singles, report, *, wide):
            self.calls.append((singles[0].names, wide))
            report(1.0)
            return self.answers.pop(0)

    Pairs.answers, Pairs.calls = [], []
    monkeypatch.setattr(module, "Pairs", Pairs)
    return Pairs


def quiet(fraction):
    pass


def test_pairs_are_looked_for_once_more_about_what_one_has_led_to(asked):
    a, ab, b = scored(100.0, "a"), scored(90.0, "a", "b"), scored(80.0, "b")
    asked.answers, told = [[ab, b], []], []
    assert with_pairs(search(), [a], told.append) == ([b, a], [ab])
    assert asked.calls == [(("a",), False), (("b",), False)]
    assert told == [0.5, 1.0]


@pytest.mark.parametrize(
    ("of", "alone"),
    [(search(), 95.0), (search(suffices=False), 80.0)],
    ids=["the pair is worth more", "it does not suffice"],
)
def test_not_where_the_pair_or_nothing_will_do(asked, of, alone):
    asked.answers = [[scored(90.0, "a", "b"), scored(alone, "b")]]
    with_pairs(of, [scored(100.0, "a")], quiet)
    assert len(asked.calls) == 1


def test_one_that_is_found_cheaper_takes_its_own_place(asked):
    a, again = scored(100.0, "a"), scored(98.0, "a")
    asked.answers = [[scored(97.0, "a", "b"), again]]
    assert with_pairs(search(), [a], quiet)[0] == [again]


@pytest.mark.parametrize(
    ("of", "cost"),
    [
        (search(known=False), 100.0),
        (search(count=69), 100.0),
        (search(), 501.0),
        (search(left=0.4), 100.0),
    ],
    ids=["the noise is unknown", "too few data", "nothing gains", "nothing is left"],
)
def test_no_pairs_are_looked_for(asked, of, cost):
    one = scored(cost, "a")
    assert with_pairs(of, [one], quiet) == ([one], [])
    assert not asked.calls


def test_what_will_not_do_is_looked_beside_widely(asked):
    asked.answers = [[]]
    with_pairs(search(suffices=False, left=0.4), [scored(100.0, "a")], quiet)
    assert asked.calls == [(("a",), True)]


def test_without_any_single_effect_there_is_nothing_to_do(asked):
    assert with_pairs(search(), [], quiet) == ([], [])
