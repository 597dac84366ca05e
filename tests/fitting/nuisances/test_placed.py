"""Where points are on a plate that is longer than stated: from the clamp, or from the free end."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.nuisances.placed import PlacedPoints


@pytest.fixture
def points(zn1):
    sigma = np.array([3e-4, 5e-4])
    return PlacedPoints(zn1, zn1, {"length": 0, "place_1_x": 1}, sigma)


@pytest.mark.parametrize(("from_tip", "expected"), [(False, 0.2), (True, 0.203)])
def test_it_is_so_far_from_the_clamp_or_from_the_free_end(points, zn1, from_tip, expected):
    z = np.array([10.0, 0.0])
    (x, _), (y, _) = points.at((0.2, 0.05), "place_1", z, from_tip=from_tip)
    # The mesh is that of the plate as stated, stretched.
    assert x * (zn1.length_m + 3e-3) / zn1.length_m == pytest.approx(expected)
    assert y == pytest.approx(0.05)


@pytest.mark.parametrize("from_tip", [False, True])
def test_its_derivatives_are_those_of_its_place(points, zn1, from_tip):
    points = replace(points, specimen=replace(zn1, length_m=1.01 * zn1.length_m))
    z, h = np.array([0.7, -0.3]), 1e-4
    (_, by), (_, across) = points.at((0.2, 0.05), "place_1", z, from_tip=from_tip)
    assert not across
    for k in (0, 1):
        step = h * np.eye(2)[k]
        up, down = (points.at((0.2, 0.05), "place_1", z + s, from_tip=from_tip)[0][0] for s in (step, -step))
        assert by[k] == pytest.approx((up - down) / (2 * h), rel=1e-6)
