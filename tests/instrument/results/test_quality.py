import pytest
from sessions import point

from instrument.results.quality import quality_of
from instrument.stepped_sine.settings import LevelControl, SweepSettings


@pytest.mark.parametrize(
    ("changes", "quality"),
    [
        ({}, "good"),
        ({"remarks": ("range 5mm/s/V is not calibrated",)}, "with remarks"),
        ({"remarks": ("not settled: 0.3 % left, limit 0.1 %",)}, "out of limits"),
        ({"control_error_percent": 1.01}, "out of limits"),
        ({"control_error_percent": -1.01}, "out of limits"),
        ({"control_error_percent": 0.99}, "good"),
    ],
)
def test_a_point_is_judged_by_the_sweeps_own_tolerances(changes, quality):
    assert quality_of(point(**changes), SweepSettings(LevelControl(tolerance=0.01))) == quality
