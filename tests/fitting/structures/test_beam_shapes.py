from itertools import pairwise

import numpy as np
import pytest

from fitting.structures.beam_shapes import ORDER, gauss, matrices_of, shapes_of

ENDS = ("clamped-free", "free-free", "clamped-clamped")


@pytest.mark.parametrize("ends", ENDS)
def test_what_meets_the_conditions_is_at_rest_at_held_ends_and_does_not_turn(ends):
    s = shapes_of(ends)
    held = np.array(s.held_ends)
    for which, derivative in (("w", 0), ("w", 1), ("b", 0), ("c", 0), ("p_b", 0), ("p_c", 0)):
        rows = s.rows(which, held, derivative)[s.is_held]
        assert np.abs(rows).max(initial=0.0) < 1e-9


def test_a_held_end_lets_go_what_a_rigid_motion_needs():
    s, x = shapes_of("clamped-free"), np.linspace(0, 1, 7)
    assert s.rows("w", x)[s.rising] == pytest.approx(x)
    for ends in ("clamped-free", "clamped-clamped"):
        one = shapes_of(ends)
        assert one.rows("c", x)[one.level("c")].sum(axis=0) == pytest.approx(np.ones(7))
        assert one.rows("w", x)[one.rising] == pytest.approx(x)


def test_a_free_beam_lets_go_nothing_more():
    s = shapes_of("free-free")
    assert s.is_held.all()
    assert s.size == 7 * ORDER


@pytest.mark.parametrize("ends", ENDS)
def test_pieces_of_the_shear_add_up_to_all_of_it(ends):
    s = shapes_of(ends)
    edges = np.linspace(0, 1, 6)
    arms = (0.3, 0.1)
    pieces = sum(s.slip(*gauss(ORDER, a, b), arms) for a, b in pairwise(edges))
    assert np.allclose(pieces, matrices_of(ends, 0.0, arms).K_1[:3], rtol=0, atol=1e-9 * np.abs(pieces).max())


def test_a_lifting_base_loads_every_piece_alike():
    s, x = shapes_of("clamped-free"), np.linspace(0, 1, 4001)
    w = s.rows("w", x)
    by_trapezes = np.trapezoid(w, x, axis=1)
    assert matrices_of("clamped-free").load == pytest.approx(-by_trapezes, abs=1e-5)
