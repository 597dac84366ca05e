"""Where a point was read, in words."""

from dataclasses import replace

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


def test_the_level_is_what_the_base_reached_where_the_drive_was_at_its_limit():
    held = point(2, 21.0, base_accel_re_m_s2=0.8, base_accel_im_m_s2=0.6, level_m_s2=1.06)
    sweep = sweep_of([held, replace(held, remarks=("drive held at its limit of 5 V", "level -6 % off"))])
    np.testing.assert_allclose(sweep.level_m_s2, [1.06, 1.0])
    # Whatever kept it, a base a tenth off and more was at another level.
    np.testing.assert_allclose(sweep_of([replace(held, level_m_s2=1.25)]).level_m_s2, [1.0])
    assert sweep_of([held]).drive_limited is None
