"""How instruments are wrong in a segment, in a pass, and along it."""

import numpy as np
import pytest

from fitting.diagnosis.problem.channel_error import blow_rows, channel_rows
from fitting.discrepancy.model_error import AGAIN, DRIFT, GAIN, STRUCK_GAIN
from fitting.sweep import Sweep

F = np.tile(np.linspace(20.0, 30.0, 5), 2)
V = np.exp(1j * F)


def sweep_of(passes, levels):
    ones = np.ones(len(F), dtype=np.intp)
    return Sweep(F, V, 9.81 * np.repeat(levels, 5), ones, np.repeat(passes, 5))


def test_one_pass_has_a_gain_a_drift_and_their_phases():
    first = np.arange(10) < 5
    rows = np.array(channel_rows(sweep_of([1, 2], [1.0, 1.0]), first, V, has_phase=True))
    assert rows.shape == (4, 10)
    assert np.abs(rows[:, 5:]).max() == 0
    assert rows[0, :5] / V[:5] == pytest.approx(np.full(5, GAIN))
    assert rows[1, :5] / V[:5] == pytest.approx(DRIFT * np.linspace(-1, 1, 5))
    assert rows[2:] == pytest.approx(1j * rows[:2])
    assert len(channel_rows(sweep_of([1, 2], [1.0, 1.0]), first, V, has_phase=False)) == 2


def test_parts_have_gains_of_their_own_of_a_size_that_is_said():
    every, parts = np.ones(10, bool), [0.3 * V, 0.7 * V]
    rows = channel_rows(
        sweep_of([1, 1], [1.0, 1.0]), every, V, has_phase=False, parts=parts, gain=STRUCK_GAIN
    )
    assert np.array(rows[:2]) == pytest.approx(STRUCK_GAIN * np.array(parts))
    assert len(rows) == 3


@pytest.mark.parametrize(("passes", "levels"), [([1, 2], [1.0, 1.0]), ([1, 1], [0.5, 1.0])])
def test_passes_and_levels_are_read_by_instruments_that_have_drifted_apart(passes, levels):
    rows = np.array(channel_rows(sweep_of(passes, levels), np.ones(10, bool), V, has_phase=False))
    assert rows.shape == (5, 10)
    # What sets both passes apart at every frequency, as softening would: in size as far as they drift.
    apart = np.real(rows / V) @ np.repeat([1, -1], 5) / 10
    assert np.sqrt(np.sum(apart**2)) == pytest.approx(DRIFT / np.sqrt(2))


def test_a_second_blow_that_nobody_saw_is_among_what_blows_read_wrongly():
    f = np.linspace(100.0, 900.0, 400)
    rows = blow_rows(f, 2 * np.ones(400, complex))
    assert len(rows) == 2 * 20
    size = np.sqrt(np.sum(np.abs(rows / 2) ** 2, axis=0))
    assert size == pytest.approx(np.full(400, AGAIN * np.sqrt(2)))
    second = 2 * 4e-3 * np.exp(-2j * np.pi * f * 0.0113)
    parts = np.concatenate([rows.real, rows.imag], axis=1)
    data = np.concatenate([second.real, second.imag])
    left = data - parts.T @ np.linalg.lstsq(parts.T, data, rcond=None)[0]
    assert np.linalg.norm(left) < 0.25 * np.linalg.norm(data)
    assert blow_rows(np.array([100.0, 120.0]), np.ones(2, complex)).shape == (0, 2)
