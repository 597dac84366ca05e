"""A second effect beside a first one in a wide valley, on a shear pair: each step on the way to a fit."""

import numpy as np
import pytest
from shear_pair_problem import GAIN, HIGH, MASS, ShearPairProblem

from fitting.diagnosis.search.wide_fits import WideFits

FORM = ("added_mass", 0)


@pytest.fixture(scope="module")
def wide():
    begun = ShearPairProblem(HIGH).begun
    return WideFits(begun.problem, begun.evidence, begun.none, [GAIN, MASS])


@pytest.fixture(scope="module")
def first():
    """The gain by itself, in a wide valley."""
    work = ShearPairProblem(HIGH).fits(GAIN)
    (state,) = work.fit_plain("gain_error", work.state("gain_error"))
    return state.plain[0]


def test_a_pair_goes_from_its_wide_valley_on_as_the_readings_are_and_finds_the_gain(wide, first):
    ((start, *_),) = wide.look_wide(first, [FORM])
    begun, *_ = wide.begin_wide(first, FORM, [start])
    assert [e.name for e in begun.effects] == ["gain_error", "added_mass"]
    there = wide.follow_wide(begun)
    assert begun.chi2 < wide.noise_in_wide_valleys < 0.1 * wide.left_in_wide_valley(wide.none)
    brief = wide.follow_briefly(there)
    # The same readings say more where they are not taken for a few percent.
    assert brief.chi2 > there.chi2
    rough = wide.follow_roughly(brief)
    assert rough.chi2 <= brief.chi2 * (1 + 1e-9)
    assert abs(rough.of(GAIN)[0] - HIGH) < 0.05


def test_of_some_starts_the_one_that_leads_furthest_comes_first(wide, first):
    starts = [np.array([kg]) for kg in (1e-4, 1e-2, 1e-3)]
    fits = wide.begin_wide(first, FORM, starts)
    assert [f.chi2 for f in fits] == sorted(f.chi2 for f in fits)
    assert len(fits) == len(starts)


def test_without_a_start_an_effect_begins_from_its_own_first_one(wide, first):
    own = MASS.starts(wide.problem.plate, wide.problem.points)[0]
    (found,), (expected,) = (wide.begin_wide(first, FORM, some) for some in ([], [own]))
    assert found.chi2 == expected.chi2


def test_noise_leaves_far_less_than_one_a_reading_where_readings_are_taken_for_a_few_percent(wide):
    assert 0 < wide.noise_in_wide_valleys < 0.5 * wide.evidence.count
