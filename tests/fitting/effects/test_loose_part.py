"""A part that swings on the plate: one motion more, beside a mass that depends on frequency."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp
from driven_plate import OMEGA as DRIVEN_AT
from driven_plate import Driven
from solved_in_full import OMEGA

from fitting.effects import CATALOGUE
from fitting.effects.loose_part import LoosePartEffect

PART = LoosePartEffect()
PLACE = (0.27, 0.06)
OFTEN = [(2e-3, 63.0, 0.08), (6e-3, 90.0, 0.02), (2e-6, 63.0, 0.08)]


def felt_kg(m, f_0, loss):
    k = (2 * np.pi * f_0) ** 2 * (1 + 1j * loss)
    return m * k / (k - OMEGA**2)


@pytest.mark.parametrize("part", OFTEN)
def test_it_is_felt_as_the_mass_that_frequency_makes_of_it(full, part):
    w = full.loose.observe(*PLACE)
    W = sp.csc_array(np.outer(w, w))
    expected = [full.direct(M=m * W, load=-m * w)[k] for k, m in enumerate(felt_kg(*part))]
    found = full.reduced(PART, (*part, *PLACE))
    # At 90 Hz and a loss of 0.02 it weighs thirty times as much as the mass whose motions are spanned.
    np.testing.assert_allclose(found, expected, rtol=2e-2 if part[2] == 0.02 else 1e-3)
    if part[0] > 1e-3:
        assert np.abs(full.direct() / expected - 1).max() > 0.3


@pytest.mark.parametrize("n", range(5))
def test_a_loose_parts_derivatives_are_those_of_differences(full, n):
    by, difference = full.slope(PART, (*OFTEN[0], *PLACE), n)
    np.testing.assert_allclose(by, difference, rtol=1e-4, atol=1e-4 * np.abs(by).max())


@pytest.mark.parametrize("force_m", [None, (0.27, 0.03)])
def test_a_loose_part_is_solved_at_every_point(zn1, force_m):
    driven = Driven(replace(zn1, elements=(8, 6), force_m=force_m))
    response, bare = driven.response([PART]), driven.response([])
    u = np.array([2e-3, 104.0, 0.05, 0.12, 0.16])
    v, without = response.velocity(driven.law, u), bare.velocity(driven.law, np.empty(0))
    k = (2 * np.pi * u[1]) ** 2 * (1 + 1j * u[2])
    felt = u[0] * k / (k - DRIVEN_AT**2)
    full = [driven.full(m, u[3:])[n] for n, m in enumerate(felt)]
    # At its own frequency it weighs twenty times as much as the masses that are spanned do.
    np.testing.assert_allclose(v, 1j * DRIVEN_AT * full, rtol=5e-3)
    assert np.abs(v / without - 1).max() > 0.05
    # To first order in its mass, all from one adjoint.
    few = u * [1e-3, 1, 1, 1, 1]
    (signature,) = response.signatures(driven.law, np.empty(0), [few])
    moved = response.velocity(driven.law, few) - without
    np.testing.assert_allclose(signature, moved, atol=5e-3 * np.abs(moved).max())
    _, by = response.with_derivatives(driven.law, u)
    for n in range(1, 5):
        h = 1e-5 * u[n] * np.eye(5)[n]
        slope = (response.velocity(driven.law, u + h) - response.velocity(driven.law, u - h)) / (2 * h[n])
        np.testing.assert_allclose(by[len(by) - 5 + n], slope, atol=1e-4 * np.abs(slope).max())


def test_far_below_its_frequency_it_is_a_mass(full):
    found = full.reduced(PART, (3e-3, 4e3, 0.01, *PLACE))
    np.testing.assert_allclose(found, full.reduced(CATALOGUE["added_mass"], (3e-3, *PLACE)), rtol=3e-3)


def test_what_it_contains_is_the_mass_that_it_is_far_below_its_frequency(full):
    stiff = np.array([3e-3, 4e3, 0.01, *PLACE])
    ((mass, u),) = PART.within(stiff)
    np.testing.assert_allclose(full.reduced(PART, stiff), full.reduced(mass, u), rtol=3e-3)


def test_a_plate_with_a_part_that_nothing_couples_is_the_same(full):
    plate = full.spanned.take(PART.spans)
    more = plate.with_part
    assert len(more.load) == len(plate.load) + 1
    part = more.vector("part")
    for matrix, bare in ((more.M, plate.M), (more.K_1, plate.K_1), (more.viscous(), plate.viscous())):
        np.testing.assert_array_equal(matrix @ part, 0)
        # A product of one row and column more may be summed in another order.
        np.testing.assert_allclose(matrix[:-1, :-1], bare, rtol=1e-12)
    np.testing.assert_array_equal(more.K_0 @ part, part)
    assert more.load @ part == more.observe @ part == more.row(*PLACE) @ part == 0
    assert plate.with_part is more


def test_starts_are_within_what_is_read_and_within_its_limits(full):
    class Points:
        omega = 2 * np.pi * np.concatenate([np.linspace(18, 22, 40), np.linspace(100, 130, 40)])

    starts = PART.starts(full.spanned, Points)
    lower, upper = PART.limits(full.spanned)
    assert all((lower <= u).all() and (u <= upper).all() for u in starts)
    f = np.array([u[1] for u in starts])
    assert not np.any((f > 23) & (f < 95))
    each = np.unique(f)
    assert np.diff(np.log(each)).min() > 0.029
    assert len(starts) == 9 * len(each)


def test_it_shows_where_three_readings_lie_in_its_peak():
    class Points:
        omega = 2 * np.pi * np.linspace(100, 130, 31)

    u = np.array([1e-3, 115.0, 0.04, *PLACE])
    assert PART.shows(Points, None, u)
    assert not PART.shows(Points, None, u * [1, 1, 0.3, 1, 1])
    assert not PART.shows(Points, None, u * [1, 2, 1, 1, 1])


def test_it_stands_on_a_beam_without_a_place_across():
    on_beam = PART.on("beam")
    assert [q.key for q in on_beam.parameters] == ["mass", "frequency", "loss_factor", "x"]
    assert PART.on("shear-pair") is None


def test_elsewhere_it_swings_as_it_does(full):
    u = np.array([*OFTEN[0], *PLACE])
    found = np.array(PART.elsewhere(full.spanned, u))
    lower, upper = PART.limits(full.spanned)
    np.testing.assert_array_equal(found[:, :3], np.tile(u[:3], (len(found), 1)))
    assert ((lower <= found) & (found <= upper)).all()
    assert len(np.unique(found[:, 3:], axis=0)) == len(found) == 9
