import pytest
from sessions import point

from instrument.results.quality import how_long, quality_of
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


def test_what_a_sweep_took_counts_its_sentinels_and_no_calibration():
    every = [point(1, settle_s=1.0, dwell_s=2.0), point(2, settle_s=1.0, dwell_s=2.0)]
    assert how_long(every) == "2 steps, 6 s of settling and reading"
    beside = [point(3, purpose=p, settle_s=0.5, dwell_s=2.5) for p in ("sentinel", "calibration")]
    assert how_long([*every, *beside]) == "2 steps and 1 sentinel, 9 s of settling and reading"
