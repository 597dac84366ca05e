"""The leading motions of responses, beside numpy's singular values."""

import numpy as np
import pytest

from fitting.widened.leading import Motions


@pytest.fixture(scope="module")
def motions(full):
    return Motions(full.full, "even")


@pytest.fixture(scope="module")
def responses(full):
    """Twenty responses made of three motions of decreasing size."""
    rng = np.random.default_rng(3)
    three = np.asarray(full.loose.even @ rng.standard_normal((full.loose.even.shape[1], 3)))
    return three * [1.0, 1e-2, 1e-7] @ rng.standard_normal((3, 20)) + 0j


def of_size_one(motions, responses):
    (one,) = motions.stirred([responses])
    size = np.sqrt(np.trace(one[0].T @ one[1]))
    return one[0] / size, one[1] / size


def scaled(motions, V):
    return motions.half.chain.times(motions.scale, V)


def test_only_motions_above_the_tolerance_lead_and_they_are_orthonormal(motions, responses):
    one = of_size_one(motions, responses)
    V = motions.leading([one], None, 1e-4, 10)
    assert V.shape[1] == 2
    np.testing.assert_allclose(V.T @ scaled(motions, V), np.eye(2), atol=1e-9)
    assert motions.leading([one], None, 1e-4, 1).shape[1] == 1


def test_what_is_known_does_not_lead_again(motions, responses):
    one = of_size_one(motions, responses)
    known = motions.leading([one], None, 1e-4, 1)
    beside = motions.leading([one], known, 1e-4, 10)
    assert beside.shape[1] == 1
    np.testing.assert_allclose(known.T @ scaled(motions, beside), 0, atol=1e-9)


def test_alike_responses_are_condensed_with_their_products(motions, responses):
    ((few, by_scale),) = motions.stirred([responses])
    assert few.shape[1] < 2 * responses.shape[1]
    X = motions.of(responses.real)
    np.testing.assert_allclose(
        np.linalg.norm(by_scale.T @ X), np.linalg.norm(few.T @ scaled(motions, X)), rtol=1e-9
    )
    assert np.trace(few.T @ by_scale) == pytest.approx(np.trace(X.T @ scaled(motions, X)), rel=1e-9)


def test_groups_stand_side_by_side_by_name(motions, responses):
    V = motions.leading([of_size_one(motions, responses)], None, 1e-4, 2)
    motions.groups |= {"plate": V[:, :1], "other": V[:, 1:]}
    assert motions.names == ["plate", "other"]
    np.testing.assert_array_equal(motions.columns, V)
    np.testing.assert_allclose(motions.gram, np.eye(2), atol=1e-9)
