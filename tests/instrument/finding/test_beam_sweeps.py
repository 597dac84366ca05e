"""Sweeps of beams: what they are named for, and what cannot be fitted."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.effects import CATALOGUE
from fitting.errors import OutsideModel
from fitting.laws import LAWS
from fitting.stated.layers import Core, Face
from fitting.structures.beam import Beam
from fitting.structures.small import system_of
from fitting.structures.small_sum import rational_of
from fitting.sweep import Sweep
from instrument.finding.diagnosis import diagnose
from instrument.finding.identification import identify
from instrument.models.files import File

ALUMINIUM = Face(2e-3, 70e9, 0.3, 2700.0)
TRUTH = LAWS["fractional-zener"](1.2e8, 9e8, 6e-5, 0.5)
STATED = LAWS["fractional-zener"](1e8, 1.5e9, 1e-4, 0.5)
OBERST = Beam(0.2, 0.01, "clamped-free", ALUMINIUM, core=Core(2.5e-3, 0.49, 1000.0, STATED), pickup_m=0.15)
FREQUENCY_HZ = np.geomspace(15, 1500, 120)


def absolute(frequency_hz=FREQUENCY_HZ):
    """The true beam read by a laser that stands still, 0.3 % noise."""
    w, count = 2 * np.pi * frequency_hz, len(frequency_hz)
    rational = rational_of(system_of(OBERST, OBERST.parts()), w, 3e8)
    relative = 1j * w * rational.with_derivative(TRUTH.modulus(w))[0] * 9.81
    rng = np.random.default_rng(3)
    noise = 1 + 0.003 / np.sqrt(2) * (rng.normal(size=count) + 1j * rng.normal(size=count))
    ones = np.ones(count, dtype=int)
    v = (relative + 9.81 / (1j * w)) * noise
    return Sweep(frequency_hz, v, 9.81 * ones, ones, ones, base_m_s2=9.81 * ones + 0j)


def test_stated_numbers_that_a_lost_fit_had_moved_do_not_stay_where_the_cause_is_found():
    others = [name for name in CATALOGUE if name != "absolute_velocity"]
    found = diagnose([File(absolute(), OBERST)], others).result
    assert found.verdict == "effect"
    assert [e.name for e in found.effects] == ["absolute_velocity"]
    w = 2 * np.pi * np.array([30.0, 100.0, 300.0, 1000.0])
    law = found.after.law
    np.testing.assert_allclose(law.modulus(w), TRUTH.modulus(w), rtol=0.05)
    assert all(abs(one.pull) < 1 for one in found.after.adjusted)


@pytest.mark.parametrize("command", [identify, diagnose])
def test_a_bare_beam_has_no_core_to_find(command):
    with pytest.raises(OutsideModel, match="no core"):
        command([File(absolute(), replace(OBERST, core=None))])
