"""A law is quoted where everybody looks, or over its own range."""

import numpy as np
import pytest

from fitting.identification.quoted import quoted_hz


@pytest.mark.parametrize(
    ("listed", "quoted"),
    [
        ([10.0, 20.0, 50.0, 100.0, 280.0, 400.0], (20.0, 100.0, 280.0)),
        ([400.0, 900.0, 1600.0, 4000.0, 4100.0], (400.0, 1600.0, 4100.0)),
        ([250.0, 280.0, 900.0, 2000.0, 3000.0], (250.0, 280.0, 900.0, 3000.0)),
        ([57.0], (57.0,)),
        ([], ()),
    ],
)
def test_fewer_than_two_references_are_joined_by_the_ends_and_the_middle(listed, quoted):
    assert quoted_hz(np.array(listed)) == quoted
