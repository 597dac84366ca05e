"""The drive of a step, corrected or given up."""

from itertools import pairwise

import pytest
from station import began

from instrument.stepped_sine.guard import Guard
from instrument.stepped_sine.level_control import LevelControl
from instrument.stepped_sine.settings import SweepSettings

SETTINGS = SweepSettings()
LEVEL = 9.81


@pytest.fixture
def remarks():
    return []


@pytest.fixture
def control(remarks):
    step = began(level_m_s2=LEVEL)
    return LevelControl(step, SETTINGS, Guard(step, SETTINGS), remarks.append)


def test_the_drive_asked_for_is_the_level_over_the_gain_seen(control, remarks):
    (asked,) = control.correct(0.8 * LEVEL, -0.2, 1.0)
    assert asked.drive_v == pytest.approx(1.25)
    assert "-20 % off" in asked.why
    assert remarks == []


def test_a_drive_at_its_limit_is_the_last_correction_and_said(control, remarks):
    limit_v = SETTINGS.limits.drive_v
    (asked,) = control.correct(0.8 * LEVEL, -0.2, limit_v)
    assert asked.drive_v == limit_v
    assert not control.may_correct
    assert remarks == [f"drive held at its limit of {limit_v:.3g} V"]


def test_corrections_are_counted(control):
    for _ in range(SETTINGS.control.most_corrections):
        assert control.may_correct
        control.correct(LEVEL, 0.0, 1.0)
    assert not control.may_correct


def test_a_dwell_whose_base_fell_away_raises_the_drive_less_than_twofold(control):
    (asked,) = control.correct_in_dwell(0.01 * LEVEL, -0.99, 1.0)
    assert 1.0 < asked.drive_v < 2.0


def test_a_base_far_under_its_level_for_three_blocks_is_lost(control):
    assert [bool(control.lost(0.1 * LEVEL, 0.1 * LEVEL, 1.0)) for _ in range(3)] == [False, False, True]
    assert control.far_under


def test_a_base_that_rises_from_block_to_block_is_not_lost(control):
    sizes = [0.1 * 1.2**k * LEVEL for k in range(6)]
    assert not any(control.lost(now, before, 1.0) for before, now in pairwise(sizes))
    assert control.far_under


def test_at_the_limit_of_the_drive_nothing_counts_as_lost(control):
    for _ in range(5):
        assert control.lost(0.1 * LEVEL, 0.1 * LEVEL, SETTINGS.limits.drive_v) == []
    assert not control.far_under


def test_a_new_command_forgets_the_blocks_before(control):
    control.lost(0.1 * LEVEL, None, 1.0)
    control.restart()
    assert not control.far_under
