"""Levels that are stated far from the base that was measured."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fitting.gravity import PUBLISHED_G_M_S2
from fitting.sweep import Sweep
from instrument.interchange.given import read_given
from instrument.interchange.level_remark import level_remark
from instrument.paper_case import case_file

ONES = np.ones(5)
SWEEP = Sweep(np.arange(20.0, 25.0), ONES + 0j, ONES, ONES.astype(int), ONES.astype(int), 9.81 * ONES + 0j)
PATH = Path("a.csv")


def remark(times, *, has_levels=True, reference=PUBLISHED_G_M_S2):
    """Of levels that are so many times the base."""
    sweep = replace(SWEEP, commanded_m_s2=times * np.abs(SWEEP.base_m_s2))
    return level_remark(PATH, sweep, reference, has_levels=has_levels)


@pytest.mark.parametrize(
    ("times", "said"),
    [
        (9.81, "9.8 times base_accel (median): is level_g in m/s^2?"),
        (1000.0, "is level_g in mg?"),
        (1 / 9.81, "is [base] acceleration_m_s2 in g?"),
        (20.0, "is one of them in another unit?"),
    ],
)
def test_a_level_far_from_the_base_is_said_with_its_unit(times, said):
    found = remark(times)
    assert found.startswith("a.csv: level_g times [base] acceleration_m_s2 is ")
    assert said in found


def test_a_base_that_is_stated_alone_is_named_alone():
    found = remark(1 / 9.81, has_levels=False, reference=1.0)
    assert found.startswith("a.csv: [base] acceleration_m_s2 is 0.1 times base_accel (median): is [base] ")


def test_rms_and_what_nobody_stated_are_no_remark():
    assert remark(2.9) == remark(1 / 2.9) == ""
    assert remark(20.0, has_levels=False) == ""
    assert level_remark(PATH, replace(SWEEP, base_m_s2=None), 9.81, has_levels=True) == ""


def test_a_file_that_is_read_says_it(tmp_path):
    path = tmp_path / "a.csv"
    head = "frequency_hz,velocity_re_m_s,velocity_im_m_s,base_accel_re_m_s2,base_accel_im_m_s2,level_g"
    for level, said in ((9.81, "is level_g in m/s^2?"), (1.0, "")):
        path.write_text(f"{head}\n20,0.1,0.2,9.8,0,{level}\n21,0.1,0.3,9.8,0,{level}\n")
        assert said in read_given(path, case_file("zn1.toml"), None).level_remark
    assert read_given(path, case_file("zn1.toml"), None).level_remark == ""
