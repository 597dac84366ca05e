"""Sums over points, and what is kept of them."""

import numpy as np

from fitting.nuisance_sums import Kept, between


def test_adjoints_times_parts_times_motions_are_summed_as_written():
    rng = np.random.default_rng(4)
    parts = rng.standard_normal((3, 5, 5))
    q, adjoint = (rng.standard_normal((7, 5)) + 1j * rng.standard_normal((7, 5)) for _ in range(2))
    parts += parts.transpose(0, 2, 1)
    np.testing.assert_allclose(between(parts, q, adjoint), np.einsum("pi,kij,pj->kp", adjoint, parts, q))


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
