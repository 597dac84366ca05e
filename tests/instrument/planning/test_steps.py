"""Resonances that an even load does not excite, and the steps about them."""

from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA
from rig_plate import plate_of_the_rig

from fitting.dynamics.real_modes import real_modes
from fitting.laws.constant import ConstantModulus
from fitting.plate.plate import Plate
from instrument.files.sweep_file import read_sweep
from instrument.models.set_up import set_up
from instrument.planning.steps import about, twists_hz, where
from instrument.stepped_sine.settings import SweepSettings

STIFF = ConstantModulus(0.5e6, 0.01)


@pytest.fixture(scope="module")
def twists():
    sweep = read_sweep(DATA / "practice-005.csv").sweep(9.81).take(np.arange(0, 240, 8))
    specimen = replace(plate_of_the_rig(), exact=False)
    plate = set_up(sweep, specimen).problem.plate
    return specimen, twists_hz(plate, STIFF, 15.0, 300.0)


def test_they_are_the_modes_odd_across_the_width(twists):
    specimen, found = twists
    modes = real_modes(Plate(specimen), STIFF.g_pa, 6)
    hz = modes.omega / (2 * np.pi)
    pushed = np.abs(modes.shapes.T @ Plate(specimen).load)
    odd = hz[pushed < 1e-6 * pushed.max()]
    assert found.real == pytest.approx(odd[:2], rel=3e-3)


def test_steps_reach_past_each_resonance_and_are_a_segment_of_their_own(twists):
    _, poles = twists
    steps = about(poles, 7, poles, SweepSettings())
    assert set(steps.segment) == {7, 8}
    for number, p in zip((7, 8), poles, strict=True):
        f = steps.frequency_hz[steps.segment == number]
        assert len(f) == 20
        assert f[0] < 0.975 * p.real
        assert f[-1] > 1.025 * p.real
    both = steps.then(steps)
    assert len(both.frequency_hz) == len(both.segment) == len(both.seconds) == 80
    assert where(poles) == f"{poles[0].real:.4g} and {poles[1].real:.4g}"


def test_without_any_there_are_no_steps():
    none = np.zeros(0, dtype=complex)
    assert not len(about(none, 1, none, SweepSettings()).frequency_hz)
    assert not where(none)
