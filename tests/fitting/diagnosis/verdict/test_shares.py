"""Shares of explanations, and how many of them hold 95 %."""

import pytest
from verdict_cases import scored

from fitting.diagnosis.verdict.shares import group_of, holding, shares_of


def test_the_likeliest_that_hold_95_percent_are_the_group():
    assert holding([0.94, 0.04, 0.02]) == 2
    assert holding([0.96, 0.03, 0.01]) == 1
    ranked = list(zip("abc", (0.9, 0.06, 0.04), strict=True))
    assert group_of(ranked) == (("a", pytest.approx(0.9 / 0.96)), ("b", pytest.approx(0.06 / 0.96)))


def test_shares_go_by_cost_and_add_up_to_one():
    p = shares_of([scored(cost=10.0), scored("gain_error", cost=0.0), scored("tether", cost=2.0)])
    assert p.sum() == pytest.approx(1)
    assert p[1] / p[2] == pytest.approx(2.718281828)


def test_what_stands_in_keeps_its_part_where_it_is_less_than_it_may_have():
    unseen, seen = scored("tether", cost=3.0, stands_in="not seen"), scored("gain_error", cost=0.0)
    plain = shares_of([scored("tether", cost=3.0), seen])
    assert shares_of([unseen, seen]) == pytest.approx(plain)
