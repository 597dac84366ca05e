"""Sums over points, and what is kept of them."""

import pickle

import numpy as np

from fitting.nuisances.sums import Kept, SideBySide, between


def test_adjoints_times_parts_times_motions_are_summed_as_written():
    rng = np.random.default_rng(4)
    parts = rng.standard_normal((3, 5, 5))
    q, adjoint = (rng.standard_normal((7, 5)) + 1j * rng.standard_normal((7, 5)) for _ in range(2))
    parts += parts.transpose(0, 2, 1)
    found = between(SideBySide().of(parts), q, adjoint)
    np.testing.assert_allclose(found, np.einsum("pi,kij,pj->kp", adjoint, parts, q))


def test_a_result_is_made_once_for_a_place_and_the_oldest_is_forgotten():
    kept, made = Kept(), []

    def ask(name, value):
        z = np.array([float(value)])
        return kept.get(name, z, lambda: made.append((name, value)) or z)

    assert ask("change", 0) is ask("change", 0)
    ask("load", 0)
    assert made == [("change", 0), ("load", 0)]
    for value in range(1, 65):
        ask("change", value)
    ask("change", 64)
    assert len(made) == 66
    ask("change", 0)
    assert made[-1] == ("change", 0)
    assert len(made) == 67


def test_parts_are_laid_side_by_side_once_and_not_sent_along():
    some, others = np.zeros((2, 3, 3)), np.ones((2, 3, 3))
    kept = SideBySide()
    assert kept.of(some) is kept.of(some)
    np.testing.assert_array_equal(kept.of(others), np.ones((3, 6)))
    for _ in range(20):
        np.testing.assert_array_equal(kept.of(np.full((2, 3, 3), 2.0)), np.full((3, 6), 2.0))
    np.testing.assert_array_equal(kept.of(others), np.ones((3, 6)))
    assert len(pickle.dumps(kept)) < 200
