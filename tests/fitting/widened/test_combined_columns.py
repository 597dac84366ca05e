import numpy as np

from fitting.widened.combined_columns import AllCombined, OwnCombined, own_and_beside


def test_own_columns_stay_and_what_the_others_add_is_orthonormal():
    random = np.random.default_rng(1)
    own, other = np.linalg.qr(random.normal(size=(9, 3)))[0], random.normal(size=(9, 2))
    # The last is one of those before it, but for a column of the own ones.
    X = np.hstack([other, own, other[:, :1] + own[:, :1]])
    is_own = np.array([False, False, True, True, True, False])
    T = own_and_beside(X.T @ X, is_own)
    assert T.shape == (6, 5)
    np.testing.assert_allclose(X @ T[:, :3], own)
    np.testing.assert_allclose((X @ T).T @ (X @ T), np.eye(5), atol=1e-9)
    # Nothing that was spanned is lost.
    np.testing.assert_allclose(X @ T @ (X @ T).T @ X, X, atol=1e-9)


def test_columns_well_apart_are_left_as_they_are():
    assert own_and_beside(np.eye(3), np.array([True, False, False])) is None


def test_combining_some_columns_is_combining_all_with_the_rest_kept():
    random = np.random.default_rng(2)
    A, rows, V = random.normal(size=(4, 4)), random.normal(size=(3, 4)), random.normal(size=(2, 1))
    T = np.zeros((4, 3))
    T[:2, :1], T[2:, 1:] = V, np.eye(2)
    some, every = OwnCombined(V, slice(0, 2), slice(2, 4)), AllCombined(T)
    np.testing.assert_allclose(some.square(A), every.square(A))
    np.testing.assert_allclose(some.along(rows), every.along(rows))
