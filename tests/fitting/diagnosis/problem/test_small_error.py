from dataclasses import replace

import numpy as np
import pytest

from fitting.diagnosis.problem.small_error import octaves, theory_rows
from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core, Face
from fitting.structures import Beam, ShearPair
from fitting.structures.small import displacement, system_of, widened_system_of

LAW = ConstantModulus(1e6, 0.5)
ALUMINIUM, FOIL = Face(2e-3, 70e9, 0.3, 2700.0), Face(0.5e-3, 70e9, 0.3, 2700.0)
BEAM = Beam(
    0.2,
    0.02,
    "clamped-free",
    ALUMINIUM,
    constraining=FOIL,
    core=Core(0.3e-3, 0.49, 1000.0, LAW),
    pickup_m=0.15,
)
OMEGA = 2 * np.pi * np.geomspace(20, 1000, 60)


def test_hats_over_the_octaves_add_up_to_one():
    hats = octaves(OMEGA)
    assert hats.sum(axis=0) == pytest.approx(np.ones(60))
    assert np.all(hats >= 0)
    assert octaves(np.full(3, 5.0)) == pytest.approx(np.ones((1, 3)))


def test_resonances_losses_and_the_width_each_have_their_size():
    drive = np.full(60, 9.81)
    rows = np.array(theory_rows(BEAM, widened_system_of(BEAM, BEAM.parts()), OMEGA, LAW, drive))
    hats = len(octaves(OMEGA))
    assert len(rows) == 2 * hats + 3
    # All octaves together: every resonance higher by its share is a beam of a stiffness twice that.
    error = BEAM.theory_error(OMEGA / (2 * np.pi), LAW.modulus(OMEGA))
    own, G = system_of(BEAM, BEAM.parts()), LAW.modulus(OMEGA)
    h = 1e-5
    stiffer = displacement(replace(own, K_0=(1 + 2 * h) * own.K_0), OMEGA, (1 + 2 * h) * G)
    dv = 1j * OMEGA * drive * (stiffer - displacement(own, OMEGA, G)) / h
    assert rows[:hats].sum(axis=0) == pytest.approx(error.frequency * dv, rel=1e-2, abs=1e-9)
    # Which face is read: they hardly part where waves are long.
    by = rows[-2:] / (1j * OMEGA * drive * displacement(own, OMEGA, G))
    of_side, of_middle = np.abs(by)
    assert of_side[0] < 1e-4 < of_side[-1] < 1e-2
    # Where a beam bends hardly at its spot the middle of its width is as high as the edges.
    assert of_middle[0] < 1e-4 < of_middle[-1] < 1e-2


def test_a_free_beam_s_theory_fails_as_a_clamped_one_s_and_a_pair_has_none_that_does():
    free = replace(BEAM, boundary="free-free", force_m=0.02)
    rows = theory_rows(free, widened_system_of(free, free.parts()), OMEGA, LAW, np.ones(60))
    # It is driven on one of two faces, too, and in the middle of its width.
    assert len(rows) == 2 * len(octaves(OMEGA)) + 5
    pair = ShearPair(0.5, 2, 7e-4, Core(6e-3, 0.4999, 1100.0, LAW))
    assert theory_rows(pair, widened_system_of(pair, pair.parts()), OMEGA, LAW, np.ones(60)) == []
