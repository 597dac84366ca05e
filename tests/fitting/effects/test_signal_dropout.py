"""Readings that are none are said to be so, and set aside."""

from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA

from fitting.diagnosis.diagnose import seen_in_channels
from fitting.effects import CATALOGUE
from fitting.effects.signal_dropout import SignalDropoutEffect
from instrument.files.sweep_file import read_sweep


def spoilt(at, factor):
    sweep = read_sweep(DATA / "practice-002.csv").sweep(9.81)
    v = sweep.velocity_m_s.copy()
    v[at] *= factor
    return replace(sweep, velocity_m_s=v)


def test_lost_readings_are_counted_and_set_aside():
    at = np.array([40, 41, 42, 200])
    lost = np.abs(spoilt(at, 0.02).velocity_m_s - spoilt(at, 1.0).velocity_m_s)[at]
    why, (found,), noise = seen_in_channels(spoilt(at, 0.02), [SignalDropoutEffect()])
    assert (np.flatnonzero(why == "signal_dropout") == at).all()
    assert found.parameters["readings"].value == 4
    assert found.parameters["size"].value == pytest.approx(lost.max(), rel=0.05)
    assert len(noise.std_m_s) == np.sum(why == "")
    said = SignalDropoutEffect().story({"readings": 4.0, "size": 0.02})
    assert said.startswith("4 readings leave the curve")


def test_a_clean_sweep_has_none():
    sweep = spoilt(np.array([], dtype=int), 1.0)
    why, found, _ = seen_in_channels(sweep, [SignalDropoutEffect()])
    assert np.all(why == "")
    assert not found


def test_one_of_several_lost_readings_near_a_multiple_is_no_hum():
    sweep = spoilt(np.array([], dtype=int), 1.0)
    near = int(np.argmin(np.abs(sweep.frequency_hz - 100)))
    at = np.array([20, near, 300])
    both = [CATALOGUE["mains_hum"], CATALOGUE["signal_dropout"]]
    why, found, _ = seen_in_channels(spoilt(at, 0.02), both)
    assert [one.name for one in found] == ["signal_dropout"]
    assert (np.flatnonzero(why == "signal_dropout") == at).all()


def test_what_hums_is_not_said_twice():
    sweep = read_sweep(DATA / "practice-002.csv").sweep(9.81)
    v = sweep.velocity_m_s.copy()
    near = np.argsort(np.abs(sweep.frequency_hz - 100))[:2]
    v[near] *= 1.5, 0.6
    both = [CATALOGUE["mains_hum"], CATALOGUE["signal_dropout"]]
    why, found, _ = seen_in_channels(replace(sweep, velocity_m_s=v), both)
    assert [one.name for one in found] == ["mains_hum"]
    assert (why[near] == "mains_hum").all()
