from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA
from hypothesis import given
from hypothesis import strategies as st

from fitting.data.level import level_error
from fitting.sweep import Sweep
from instrument.files.sweep_file import read_sweep


def sweep_at(factor, *, points=90, scatter=0.003, seed=0):
    """A sweep whose reference reads `factor` (per point or one) times its command."""
    rng = np.random.default_rng(seed)
    commanded = np.repeat([2.45, 4.9, 9.81], points // 3)
    level = commanded * factor * (1 + scatter * rng.normal(size=points))
    return Sweep(
        frequency_hz=np.linspace(14, 26, points),
        velocity_m_s=np.full(points, 0.01 + 0.02j),
        commanded_m_s2=commanded,
        segment=np.tile([1, 2, 3], points // 3),
        sweep=np.ones(points, dtype=int),
        base_m_s2=level * np.exp(1j * rng.uniform(0, 6, points)),
    )


@given(st.one_of(st.floats(0.8, 0.985), st.floats(1.015, 1.25)), st.integers(0, 1000))
def test_a_reference_off_the_command_is_measured(factor, seed):
    found = level_error(sweep_at(factor, seed=seed))
    assert abs(found.factor - factor) < 5 * found.standard_error
    assert found.percent == pytest.approx(100 * (factor - 1), abs=0.3)


def test_a_base_that_the_drives_limit_kept_under_its_level_is_no_error_of_its_channel():
    sweep = sweep_at(np.where(np.arange(90) < 60, 0.86, 1.0))
    low = np.arange(90) < 60
    assert level_error(sweep).factor == pytest.approx(0.86, abs=0.01)
    assert level_error(replace(sweep, drive_limited=low)) is None
    assert level_error(replace(sweep_at(0.86), drive_limited=low)).factor == pytest.approx(0.86, abs=0.01)
    assert level_error(replace(sweep, drive_limited=np.ones(90, bool))) is None


@given(st.floats(0.992, 1.008), st.integers(0, 1000))
def test_within_one_percent_it_is_as_commanded(factor, seed):
    assert level_error(sweep_at(factor, seed=seed)) is None


def test_the_standard_error_is_that_of_the_median():
    found = [level_error(sweep_at(1.05, seed=seed)) for seed in range(400)]
    spread = np.std([f.factor for f in found])
    # 400 seeds know the spread to 4 %; the median's efficiency at 90 points is as for many.
    assert np.mean([f.standard_error for f in found]) == pytest.approx(spread, rel=0.12)


def test_a_scatter_larger_than_the_error_hides_it():
    assert level_error(sweep_at(1.02, points=9, scatter=0.1)) is None


def test_single_wild_readings_do_not_move_it():
    sweep = sweep_at(1.0)
    wild = sweep.base_m_s2.copy()
    wild[:9] *= 1.8
    assert level_error(replace(sweep, base_m_s2=wild)) is None


def test_without_a_reference_or_with_two_points_nothing_is_said():
    sweep = sweep_at(1.1)
    assert level_error(replace(sweep, base_m_s2=None)) is None
    assert level_error(sweep.take(np.arange(2))) is None


def test_a_clean_practice_sweep_is_as_commanded():
    assert level_error(read_sweep(DATA / "practice-002.csv").sweep(9.81)) is None
