"""Elements applied to motions one by one, beside their assembled matrix."""

import numpy as np

from fitting.plate.assembly import Assembly
from fitting.plate.element import DOFS


def test_elements_answer_as_their_assembled_matrix_does(coarse_plate):
    rng = np.random.default_rng(1)
    A = rng.standard_normal((4 * DOFS, 4 * DOFS))
    X = rng.standard_normal((coarse_plate.size, 3)) + 1j * rng.standard_normal((coarse_plate.size, 3))
    expected = coarse_plate.scatter(A) @ X
    np.testing.assert_allclose(Assembly(coarse_plate).forces(A, X), expected, atol=1e-11)
    np.testing.assert_allclose(Assembly(coarse_plate).forces(A[None], X), expected, atol=1e-11)
