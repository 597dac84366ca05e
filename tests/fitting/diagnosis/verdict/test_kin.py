"""What is akin to an explanation, and in no catalogue."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from fitting.diagnosis.thresholds import KIN
from fitting.diagnosis.verdict.kin import weighed

ODDS = KIN.chance / (1 - KIN.chance)
DATA, COLUMNS, DIRECTIONS = 30, 3, 5


def drawn(seed):
    """A linear fit: what was fitted, what is akin to it, priors and readings."""
    rng = np.random.default_rng(seed)
    J, d = rng.standard_normal((DATA, COLUMNS)), rng.standard_normal((DATA, DIRECTIONS))
    return J, d, np.diag(rng.uniform(0.1, 2.0, COLUMNS)), rng.standard_normal(DATA)


def at_its_end(J, d, prior, y):
    """As `weighed` is asked at the end of the fit."""
    C = np.linalg.inv(J.T @ J + prior)
    # Predicted less measured.
    left = J @ (C @ (J.T @ y)) - y
    return C, J.T @ d, d.T @ d, d.T @ left


def size_of(C, by, dd, share, explained):
    return share**2 * explained / np.trace(dd - by.T @ C @ by)


@given(st.integers(0, 10**6), st.floats(0.01, 2.0), st.floats(0.1, 1e3))
def test_odds_and_law_are_those_of_the_joint_gaussian(seed, share, explained):
    J, d, prior, y = drawn(seed)
    asked = at_its_end(J, d, prior, y)
    s2 = size_of(*asked[:3], share, explained)
    found = weighed(*asked, explained, [share])

    def ln(V):
        return -(np.linalg.slogdet(V)[1] + y @ np.linalg.solve(V, y)) / 2

    alone = np.eye(DATA) + J @ np.linalg.solve(prior, J.T)
    with_kin = alone + s2 * d @ d.T
    assert found.odds == pytest.approx(ODDS * np.exp(ln(with_kin) - ln(alone)), rel=1e-6)
    # What was fitted, beside all that kin may do.
    noise = np.eye(DATA) + s2 * d @ d.T
    C = np.linalg.inv(J.T @ np.linalg.solve(noise, J) + prior)
    np.testing.assert_allclose(asked[0] + found.wider, C, rtol=1e-6, atol=1e-10)
    moved = C @ (J.T @ np.linalg.solve(noise, y)) - asked[0] @ (J.T @ y)
    np.testing.assert_allclose(found.moved, moved, rtol=1e-6, atol=1e-9)
    # How far it goes, beside everything else at once.
    known = np.sqrt([*np.diag(prior), *np.ones(DIRECTIONS)])
    whole = np.vstack([np.hstack([J, np.sqrt(s2) * d]), np.diag(known)])
    x = np.linalg.lstsq(whole, np.append(y, np.zeros(COLUMNS + DIRECTIONS)), rcond=None)[0]
    np.testing.assert_allclose(found.along, np.sqrt(s2) * x[COLUMNS:], rtol=1e-6, atol=1e-9)


@given(st.integers(0, 10**6))
def test_what_hardly_shows_has_kin_as_likely_as_its_chance_and_what_fits_at_a_thousand_has_none(seed):
    J, d, prior, _ = drawn(seed)
    # An explanation that fits to the last digit.
    C, by, dd, b = at_its_end(J, d, prior, np.zeros(DATA))
    odds = [weighed(C, by, dd, b, S, KIN.shares).odds / ODDS for S in (0.01, 1.0, 30.0, 1e3, 1e5)]
    assert odds == sorted(odds, reverse=True)
    assert odds[0] == pytest.approx(1, abs=0.02)
    assert odds[-1] < 0.05


@given(st.integers(0, 10**6), hnp.arrays(float, DIRECTIONS, elements=st.floats(-1, 1)))
def test_what_an_explanation_leaves_in_the_directions_of_its_kin_speaks_for_them(seed, along):
    J, d, prior, _ = drawn(seed)
    y = d @ along
    asked = at_its_end(J, d, prior, y)
    fits = at_its_end(J, d, prior, np.zeros(DATA))
    assert weighed(*asked, 100.0, KIN.shares).odds >= weighed(*fits, 100.0, KIN.shares).odds * (1 - 1e-9)


def test_the_law_of_several_shares_is_their_mixture():
    asked = at_its_end(*drawn(3))
    each = [weighed(*asked, 50.0, [share]) for share in (0.1, 1.0)]
    both = weighed(*asked, 50.0, [0.1, 1.0])
    p = np.array([one.odds for one in each])
    assert both.odds == pytest.approx(p.mean())
    p /= p.sum()
    mean = p @ [one.moved for one in each]
    np.testing.assert_allclose(both.moved, mean)
    # A tenth is the same by another formula, all of it another thing.
    assert [one.another_cause for one in each] == [0.0, 1.0]
    assert both.another_cause == pytest.approx(p[1])
    apart = sum(
        w * (one.wider + np.outer(one.moved - mean, one.moved - mean)) for w, one in zip(p, each, strict=True)
    )
    np.testing.assert_allclose(both.wider, apart, atol=1e-12)
