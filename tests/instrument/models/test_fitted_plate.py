"""A plate predicted is the plate that was fitted: stated numbers, bend of the law, channel and all."""

import json
from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA
from paper_law import TABLE_4

from fitting.dynamics.direct import displacement_direct
from fitting.nuisances.nuisance import Nuisance
from fitting.nuisances.nuisances import Nuisances
from instrument.errors import BadInput
from instrument.facts.identification import IdentificationResult, PosteriorFound
from instrument.files.specimen_file import read_specimen
from instrument.files.sweep_file import read_sweep
from instrument.finding.identification import identify
from instrument.models.files import File
from instrument.models.fitted_plate import FittedPlate
from instrument.models.specimen_models import Models
from instrument.paper_case import case_file
from instrument.results.fit_file import found_law
from instrument.results.fitted_response import fitted_response
from instrument.results.identification_from import identification_from

F = np.array([17.0, 19.3, 95.0, 101.0, 280.0])


@pytest.fixture(scope="module")
def identified():
    specimen = replace(read_specimen(case_file("zn1.toml")), exact=False)
    sweep = read_sweep(DATA / "practice-005.csv").sweep(9.81)
    found = identify([File(sweep, specimen)])
    return specimen, sweep, found, identification_from(found)


def test_it_predicts_what_was_fitted(identified):
    specimen, sweep, found, result = identified
    assert max(abs(one.pull) for one in result.adjusted) > 3
    f, which = np.unique(sweep.frequency_hz, return_inverse=True)
    response = fitted_response(
        specimen, found_law(IdentificationResult.model_validate_json(json.dumps(result.as_json()))), f
    )
    at = np.abs(response.velocity_m_s)[which.ravel()]
    np.testing.assert_allclose(at, found.result.predicted_m_s, rtol=1e-4)
    assert (response.amplitude_standard_error_m_s < 0.02 * np.abs(response.velocity_m_s)).all()


def test_the_stated_plate_alone_would_be_off(identified):
    specimen, _, _, result = identified
    as_stated = result.but(adjusted=())
    response = [fitted_response(specimen, found_law(one), F) for one in (result, as_stated)]
    off = np.abs(response[1].velocity_m_s / response[0].velocity_m_s - 1)
    assert off.max() > 0.02


def test_a_number_moved_far_is_said_to_be(identified):
    *_, found, _ = identified
    assert any("pickup_x by +" in w and "viscorig diagnose" in w for w in found.result.warnings)


def test_the_moved_plate_is_that_of_the_moved_specimen(coarse):
    """By the parts of the matrices as by assembling it anew."""
    names = ("substrate_young", "core_thickness", "length", "pickup_x", "damping_1")
    sigma = (0.01, 0.03, 3e-4, 3e-4, 0.1)
    each = tuple(
        Nuisance(n, n.split("_")[0] if n[0] in "pd" else n, s) for n, s in zip(names, sigma, strict=True)
    )
    moved = FittedPlate(coarse, Nuisances(coarse, each), np.array([1.5, -1.0, 2.0, -1.0, 1.0]))
    models, anew = Models.of(coarse, F), Models.of(moved.moved_specimen(), F)
    omega, G = 2 * np.pi * F, TABLE_4.modulus(2 * np.pi * F)
    x = moved.reduced(models).displacement(omega, G)
    np.testing.assert_allclose(x, displacement_direct(anew.plate, anew.damping, omega, G), rtol=2e-3)
    stated = models.reduced.displacement(omega, G)
    assert np.abs(x / stated - 1).max() > 0.02


def test_a_posterior_that_is_none_is_refused(identified):
    *_, result = identified
    with pytest.raises(ValueError, match="lower triangle"):
        found_law(result.but(posterior=PosteriorFound(names=("a", "b"), rows=((1.0,),))))
    with pytest.raises(ValueError, match="no stated number is called"):
        found_law(result.but(adjusted=(result.adjusted[0].but(name="colour"),)))
    one = result.adjusted[0].but(name="core_thickness", stated=0.5, tolerance=0.015, found=-1.0)
    with pytest.raises(BadInput, match="core_thickness: found = -1 mm, expected more than 0"):
        fitted_response(identified[0], found_law(result.but(adjusted=(one,))), F)
