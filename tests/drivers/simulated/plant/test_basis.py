"""The basis of few motions: what it encloses and what it keeps."""

import numpy as np
import scipy.sparse as sp

from drivers.simulated.plant.basis import basis_of, moduli, motions
from drivers.simulated.plant.law import MaxwellLaw


def chain(n: int = 30) -> tuple[sp.csr_array, sp.csr_array]:
    K = sp.diags_array([-np.ones(n - 1), 2 * np.ones(n), -np.ones(n - 1)], offsets=[-1, 0, 1])
    return K.tocsr(), sp.eye_array(n).tocsr()


def test_moduli_enclose_the_law_with_room():
    law = MaxwellLaw(1e6, (9e6,), (1e-3,))
    found = moduli(law)
    assert found[0] < 0.5e6
    assert found[-1] > 20e6


def test_motions_are_modes_and_what_forces_move():
    K, M = chain()
    force = np.zeros((30, 1))
    force[7] = 1.0
    X = motions(K, M, force, 3, stirred=[M])
    assert X.shape == (30, 7)
    np.testing.assert_allclose(np.einsum("ij,ij->j", X, X), 1.0)
    still = np.linalg.solve(K.toarray(), force[:, 0])
    np.testing.assert_allclose(X[:, 3], still / np.linalg.norm(still))


def test_a_motion_that_moves_next_to_no_mass_is_kept():
    _, M = chain()
    first, second = np.eye(30)[:, :2].T
    V = basis_of(np.column_stack([first, first + 1e-5 * second]), M)
    assert V.shape[1] == 2
    np.testing.assert_allclose(V.T @ V, np.eye(2), atol=1e-12)
