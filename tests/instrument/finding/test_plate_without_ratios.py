"""A first sweep: nobody has struck the bare plate, and its file says nothing of how that rings."""

from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA
from rig_plate import plate_of_the_rig

from fitting.diagnosis.response.sweep_response import SweepResponse
from instrument.files.sweep_file import read_sweep
from instrument.finding.identification import identify
from instrument.models.files import File
from instrument.models.set_up import set_up
from instrument.remarks.as_given import remarks_on_damping

RATIO = 0.0025
NOISE = 2e-3


@pytest.fixture(scope="module")
def unstated():
    return replace(plate_of_the_rig(), exact=False, modal_ratios=())


@pytest.fixture(scope="module")
def sweep(unstated):
    """Of the plate with its law and a quarter of a percent in every mode."""
    like = read_sweep(DATA / "practice-005.csv").sweep(9.81).take(np.arange(0, 240, 4))
    problem = set_up(like, replace(unstated, modal_ratios=(RATIO,) * 8)).problem
    v = SweepResponse(problem, ()).velocity(problem.stated_law, problem.as_stated)
    rng = np.random.default_rng(3)
    std = NOISE * np.abs(v).max() / 3
    noise = std * (rng.normal(size=len(v)) + 1j * rng.normal(size=len(v)))
    # Velocity over the base that was measured is what the fit reads.
    turned = like.commanded_m_s2 if like.base_m_s2 is None else like.base_m_s2
    return replace(like, velocity_m_s=(v + noise) / like.commanded_m_s2 * turned, std_m_s=None)


def off(sweep, plate):
    """How far the loss factor is off at each frequency of the band, in standard errors; and the notes."""
    found = identify([File(sweep, plate)]).result
    band = found.band
    true = plate.core.law.modulus(2 * np.pi * band.frequency_hz)
    return (band.loss_factor - true.imag / true.real) / band.loss_factor_standard_error, found.warnings


def test_the_band_holds_the_loss_factor_though_nobody_stated_what_the_plate_loses(sweep, unstated):
    z, notes = off(sweep, unstated)
    assert np.abs(z).max() < 2.5
    assert any("no [damping] and no hammer test" in note for note in notes)
    as_if_none, silent = off(sweep, replace(unstated, modal_ratios=(0.0,)))
    assert np.abs(as_if_none).max() > 4
    assert not any("[damping]" in note for note in silent)


def test_a_hammer_test_or_what_is_stated_says_it(unstated):
    assert remarks_on_damping(unstated, tested=True) == ()
    assert remarks_on_damping(replace(unstated, modal_ratios=(0.001,)), tested=False) == ()
    assert remarks_on_damping(replace(unstated, exact=True), tested=False) == ()
