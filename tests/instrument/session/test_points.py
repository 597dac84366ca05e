"""Where a point was read, in words."""

import numpy as np
import pytest
from sessions import point

from instrument.session.points import elsewhere, place_of, sweep_of

SPOT = {"pickup": 1, "spot_mm": (150.10000000000002, 23.988)}
MASS = {"mass_kg": 0.012, "mass_at_mm": (280.0, 100.25)}


@pytest.mark.parametrize(
    ("changes", "said", "with_clamping"),
    [
        ({}, "", ""),
        (SPOT, "spot 150.1, 24 mm", "spot 150.1, 24 mm"),
        (MASS | {"mounting": 2}, "12 g at 280, 100.2 mm", "12 g at 280, 100.2 mm, clamped anew 2 times"),
        ({"mounting": 1}, "", "clamped anew"),
    ],
)
def test_what_differs_from_the_specimen_file_is_said(changes, said, with_clamping):
    assert elsewhere(point(**changes)) == said
    assert place_of(point(**changes)) == with_clamping


def test_the_noise_of_recorded_points_was_seen_within_their_dwells():
    sweep = sweep_of([point(1, 20.0), point(2, 21.0)])
    assert sweep.std_of_dwells
    assert sweep.take(np.array([0])).std_of_dwells
