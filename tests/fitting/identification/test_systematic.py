from dataclasses import replace

import numpy as np
import pytest
from conftest import DATA

from fitting.identification.result import law_band
from fitting.identification.systematic import systematic_of
from fitting.identification.uncertainty import uncertainty_of
from fitting.laws.fractional_zener import FractionalZener
from fitting.noise import noise_of
from instrument.files.sweep_file import read_sweep
from instrument.identification import _Direct, identify

# The core behind practice-002.csv, a 3D solid model's clean sweep.
TRUTH = FractionalZener(200279.795979838, 5134151.076189923, 8.9994e-05, 0.73160059)
OMEGA = 2 * np.pi * np.array([20.0, 100.0, 280.0])


@pytest.fixture(scope="module")
def practice():
    return read_sweep(DATA / "practice-002.csv").sweep(9.81)


@pytest.fixture(scope="module")
def found(practice, zn1):
    return identify(practice, zn1)


def test_clean_sweep_of_a_solid_plate_gives_back_its_core(found):
    G, eta = found.result.law.storage_and_loss(OMEGA)
    G_true, eta_true = TRUTH.storage_and_loss(OMEGA)
    assert found.result.uncertainty.chi2_per_dof < 1.2
    np.testing.assert_allclose(G, G_true, rtol=1e-2)
    np.testing.assert_allclose(eta, eta_true, rtol=2e-2)


def test_band_covers_the_core_although_the_model_is_not_the_plate(found):
    r = found.result
    G, eta = r.law.storage_and_loss(OMEGA)
    dG, deta = r.uncertainty.law_band(r.law, OMEGA)
    G_true, eta_true = TRUTH.storage_and_loss(OMEGA)
    assert np.all(np.abs(G - G_true) < 1.96 * dG)
    assert np.all(np.abs(eta - eta_true) < 1.96 * deta)
    # and it is no band that covers anything: 1 % and 1 %
    assert np.all(1.96 * dG < 0.02 * G_true)
    assert np.all(1.96 * deta < 0.02 * eta_true)


def test_held_out_segments_are_predicted_to_their_noise(found):
    for segment in found.result.validation.held_out:
        assert segment.rms_percent < 1.5 * segment.noise_percent


def test_tolerances_widen_the_band_by_what_they_move(practice, zn1, zn1_models, found):
    stated = replace(zn1, tolerances={"substrate_young": 0.02})
    wide = identify(practice, stated).result
    # Refit with a substrate 2 % stiffer: the shift the tolerance stands for.
    stiffer = replace(zn1, substrate=replace(zn1.substrate, young_pa=1.02 * zn1.substrate.young_pa))
    moved = identify(practice, stiffer).result.law.storage_and_loss(OMEGA)[0]
    G = found.result.law.storage_and_loss(OMEGA)[0]
    before = found.result.uncertainty.law_band(found.result.law, OMEGA)[0]
    after = wide.uncertainty.law_band(wide.law, OMEGA)[0]
    np.testing.assert_allclose(np.sqrt(after**2 - before**2), np.abs(moved - G), rtol=0.15)


def test_without_systematic_terms_the_band_is_the_noise_alone(practice, zn1, zn1_models, found):
    task = _Direct(practice, noise_of(practice), zn1_models)
    systematic = systematic_of(task.residuals, practice.segment, zn1_models.reduced, zn1, found.result.law)
    assert systematic.B.shape == (2 * len(practice), 9)
    noise_alone = law_band(
        practice, found.result.law, uncertainty_of(found.result.fit, None, noise_is_known=True)
    )
    assert np.all(
        noise_alone.storage_modulus_standard_error_pa < found.result.band.storage_modulus_standard_error_pa
    )
