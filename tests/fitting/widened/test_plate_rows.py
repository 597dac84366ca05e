"""Rows that read the deflection of a plate's columns at a point."""

import numpy as np
import pytest

from fitting.widened.plate_rows import RowReader

SIZE = np.array([0.3, 0.2, 6.0, 4.0])


@pytest.fixture
def reader():
    """Of two columns: the plate moved up, and turned about the y axis, w = x."""
    x = np.repeat(np.linspace(0, SIZE[0], 7), 5)
    up, turned = np.zeros((35, 3)), np.zeros((35, 3))
    up[:, 0], turned[:, 0], turned[:, 2] = 1.0, x, -1.0
    return RowReader(np.stack([up, turned], axis=-1), SIZE)


@pytest.mark.parametrize(("x", "y"), [(0.0, 0.0), (0.13, 0.07), (0.3, 0.2)])
def test_a_point_reads_rigid_motions_exactly(reader, x, y):
    assert reader.row(x, y) == pytest.approx([1.0, x])
    assert reader.row(x, y, 1, 0) == pytest.approx([0.0, 1.0], abs=1e-12)


def test_beyond_an_edge_the_nearest_point_is_read(reader):
    np.testing.assert_array_equal(reader.row(0.5, -0.1), reader.row(0.3, 0.0))


def test_the_latest_rows_are_kept_and_nobody_may_change_them(reader):
    row = reader.row(0.1, 0.1)
    assert reader.row(0.1, 0.1) is row
    with pytest.raises(ValueError, match="read-only"):
        row[0] = 2.0
    for k in range(300):
        reader.row(1e-4 * k, 0.0)
    assert reader.row(0.1, 0.1) is not row
