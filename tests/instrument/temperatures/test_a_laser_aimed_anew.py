"""A laser that was aimed anew at each temperature, within what is stated of it, is no other material."""

from dataclasses import replace

import numpy as np
import pytest
from beam_cases import BEAM

from fitting.structures.small_modes import small_velocity
from fitting.sweep import Sweep
from fitting.temperature.shifted_law import ShiftedLaw
from instrument.files.structure_file import read_structure
from instrument.temperatures.members import AtTemperature
from instrument.temperatures.shifted import identify_shifted

AT_C = (5.0, 20.0, 35.0)
LOG_A = (1.8, 0.0, -1.5)
F_HZ = np.geomspace(25.0, 2500.0, 150)
NOISE = 1e-3


@pytest.fixture
def at_spot(tmp_path):
    """The beam, read so far from its spot in mm."""

    def read(off_mm=0.0):
        (tmp_path / "beam.toml").write_text(BEAM.replace("x_mm = 150.0", f"x_mm = {150.0 + off_mm}"))
        return read_structure(tmp_path / "beam.toml")

    return read


def swept(at_spot, every_off_mm):
    """A sweep at each temperature, each read so far from the stated spot."""
    rng, every = np.random.default_rng(0), []
    ones = np.ones(len(F_HZ), dtype=np.intp)
    for at_c, log_a, off_mm in zip(AT_C, LOG_A, every_off_mm, strict=True):
        true = at_spot(off_mm).at_temperature(at_c)
        law = ShiftedLaw(true.core.law, float(np.exp(log_a)), 1.0)
        v = small_velocity(replace(true, core=replace(true.core, law=law)), F_HZ)
        v = v * (1 + NOISE * (rng.standard_normal(len(v)) + 1j * rng.standard_normal(len(v))))
        level = np.full(len(v), true.base_acceleration_m_s2)
        every.append(AtTemperature(Sweep(F_HZ, v, level, ones, ones), at_c, f"{at_c:g}.csv"))
    return every


def test_each_sweep_has_a_spot_of_its_own_and_that_is_said(at_spot):
    found = identify_shifted(swept(at_spot, (0.4, -0.5, 0.3)), at_spot(), "free", 20.0)
    assert found.verdict.simple
    assert found.cause is None
    (said,) = [one for one in found.warnings if "the laser's spot was elsewhere" in one]
    assert "mm): each has its own" in said
    spots = [one.found - one.stated for one in found.adjusted if one.name.startswith("pickup")]
    # All of them may be off together, as the length may.
    assert np.diff(spots) == pytest.approx([-0.9, 0.8], abs=0.15)
    assert np.all(np.abs(found.fit.log_shift - LOG_A) < 3.5 * found.fit.log_shift_errors + 1e-9)


def test_a_spot_that_stayed_is_one(at_spot):
    found = identify_shifted(swept(at_spot, (0.3, 0.3, 0.3)), at_spot(), "free", 20.0)
    assert found.verdict.simple
    assert not [one for one in found.warnings if "the laser's spot" in one]
    assert [one.name for one in found.adjusted if one.name.startswith("pickup")] == ["pickup_x"]
