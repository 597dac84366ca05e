"""What a struck plate's theory gets wrong: asked where its numbers are found, alike at all its spots."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.data.noise import Noise
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.problem.model_error import COMMON, own_errors
from fitting.sweep import Sweep
from instrument.models.set_up import set_up

F = np.linspace(40.0, 260.0, 90)
ONE = np.ones(len(F), dtype=int)


@pytest.fixture(scope="module")
def struck(zn1, mesh_is_right):
    loose = {"substrate_thickness": 0.02}
    return replace(
        zn1,
        elements=(8, 6),
        boundary="free",
        force_m=(0.27, 0.03),
        exact=False,
        tolerances=loose,
        modal_ratios=(),
    )


def ready(specimen, v=None):
    sweep = Sweep(F, np.ones(len(F), complex) if v is None else v, np.ones(len(F)), ONE, ONE)
    return set_up(sweep, specimen, None, with_effects=False)


def rows(problem, reduced, law):
    found = own_errors(problem, reduced, law, np.ones(len(F), complex))
    return found.of_plate


@pytest.mark.long
def test_rows_are_those_of_the_plate_as_it_was_found(struck):
    law = struck.core.law
    thicker = replace(
        struck, substrate=replace(struck.substrate, thickness_m=1.02 * struck.substrate.thickness_m)
    )
    one, other = ready(struck), ready(thicker)
    problem = one.problem.condensed(law)
    z = np.zeros(len(problem.nuisances))
    z[[n.name for n in problem.nuisances.each].index("substrate_thickness")] = np.log(1.02) / 0.02
    stated, moved = (rows(p, one.reduced, law) for p in (problem, problem.as_found(z)))
    expected = rows(other.problem.condensed(law), other.reduced, law)
    assert problem.errs_as_found
    # Resonances are a percent elsewhere, and half as wide as that is nothing left alike.
    assert np.linalg.norm(moved - expected) < 0.05 * np.linalg.norm(stated - expected)


def test_a_shaken_plate_and_one_that_is_exact_are_asked_as_stated(struck, zn1):
    assert not ready(replace(struck, exact=True, tolerances={})).problem.errs_as_found
    assert not ready(replace(zn1, elements=(8, 6), exact=False)).problem.errs_as_found


def test_one_cause_puts_all_resonances_off_in_the_sense_of_exact_elasticity(struck):
    one, law = ready(struck), struck.core.law
    found = own_errors(one.problem, one.reduced, law, np.ones(len(F), complex))
    common = [k for k, (_, what) in enumerate(found.keys) if what == COMMON]
    assert common == [0]
    # It is made of what the resonances have by themselves, each at most as large.
    coefficients = np.linalg.lstsq(found.of_plate[1:].T, found.of_plate[0], rcond=None)[0]
    np.testing.assert_allclose(found.of_plate[1:].T @ coefficients, found.of_plate[0], atol=1e-9)
    assert np.abs(coefficients).max() <= 1 + 1e-9


def test_the_fit_takes_a_second_round_with_its_numbers_found(struck):
    heavier = replace(
        struck, substrate=replace(struck.substrate, thickness_m=1.03 * struck.substrate.thickness_m)
    )
    truth = ready(heavier)
    omega = 2 * np.pi * F
    v = 1j * omega * truth.problem.rational.displacement(struck.core.law.modulus(omega))
    given = ready(struck, v)
    begun = begin(given.problem, given.reduced, Noise(1e-3 * np.abs(v), "stated"), None, struck.core.law)
    assert begun.problem.found is not None
    assert begun.problem.found == pytest.approx(begun.none.z, abs=0.3)
