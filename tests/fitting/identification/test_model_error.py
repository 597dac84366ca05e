"""A 3D solid plate's sweep: what a layer-wise plate gets wrong and what is stated, both in the band."""

from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA

from fitting.data.noise import noise_of
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.problem.model_error import model_error
from fitting.discrepancy.model_error import FREQUENCY, GAIN, LOSS, model_error_at
from fitting.identification.result import law_band
from fitting.identification.uncertainty import uncertainty_of
from fitting.laws.fractional_zener import FractionalZener
from fitting.plate.plate_numbers import moved
from fitting.stated.tolerances import STATED
from instrument.files.sweep_file import read_sweep
from instrument.finding.identification import identify
from instrument.models.files import File
from instrument.models.set_up import set_up

# The core behind practice-002.csv, a 3D solid model's clean sweep.
TRUTH = FractionalZener(200279.795979838, 5134151.076189923, 8.9994e-05, 0.73160059)
OMEGA = 2 * np.pi * np.array([20.0, 100.0, 280.0])
YOUNG = 0.02


@pytest.fixture(scope="module")
def practice():
    return read_sweep(DATA / "practice-002.csv").sweep(9.81)


@pytest.fixture(scope="module")
def found(practice, zn1):
    """The solid is of exactly the stated plate: model error alone."""
    return identify([File(practice, zn1)])


def only(zn1, **tolerances):
    """Everything exact but what is named."""
    return replace(zn1, exact=False, tolerances={**dict.fromkeys(STATED, 0.0), **tolerances})


def test_clean_sweep_of_a_solid_plate_gives_back_its_core(found):
    G, eta = found.result.law.storage_and_loss(OMEGA)
    G_true, eta_true = TRUTH.storage_and_loss(OMEGA)
    assert found.result.uncertainty.chi2_per_dof < 1.2
    np.testing.assert_allclose(G, G_true, rtol=1e-2)
    np.testing.assert_allclose(eta, eta_true, rtol=2e-2)


def assert_covered(r):
    (G, eta), (dG, deta) = r.fit.law.storage_and_loss(OMEGA), band_of(r)
    G_true, eta_true = TRUTH.storage_and_loss(OMEGA)
    assert np.all(np.abs(G - G_true) < 1.96 * dG)
    assert np.all(np.abs(eta - eta_true) < 1.96 * deta)


def band_of(r):
    """Standard errors of G' and eta at three frequencies, as results state them."""
    at = [int(np.argmin(np.abs(r.band.frequency_hz - w / (2 * np.pi)))) for w in OMEGA]
    return r.band.storage_modulus_standard_error_pa[at], r.band.loss_factor_standard_error[at]


def test_band_covers_the_core_although_the_model_is_not_the_plate(found):
    assert_covered(found.result)
    # and it is no band that covers anything: 1 % and 1 %
    dG, deta = band_of(found.result)
    G_true, eta_true = TRUTH.storage_and_loss(OMEGA)
    assert np.all(1.96 * dG < 0.02 * G_true)
    assert np.all(1.96 * deta < 0.02 * eta_true)


def test_held_out_segments_are_predicted_to_their_noise(found):
    segments = found.result.validation.held_out
    assert segments
    for segment in segments:
        assert segment.rms_percent < 1.5 * segment.noise_percent


def test_each_segment_has_errors_of_its_own(practice, zn1, found):
    ready = set_up(practice, zn1, with_effects=False)
    rows = model_error(ready.problem, ready.reduced, found.result.law, found.result.fit.velocity_m_s)
    # Of each resonance a shift, a loss, a gain, a phase, and how the last two drift along the segment. The
    # third has two, at 253 and 278 Hz, and what it has from all others. And what all have by one cause.
    assert rows.shape == (1 + 6 + 6 + 3 * 4 + 2, len(practice))
    assert (np.abs(rows[0]) > 0).all()
    for row in rows[1:]:
        assert len(np.unique(practice.segment[np.abs(row) > 0])) == 1


def test_each_resonance_of_one_piece_has_errors_of_its_own(practice, zn1, found):
    """Together they are what one number for the whole piece would move."""
    one = np.ones_like(practice.segment)
    whole = replace(practice, segment=one, sweep=one)
    ready = set_up(whole, zn1, with_effects=False)
    law = found.result.law
    v = ready.problem.rational.displacement(law.modulus(whole.omega)) * 1j * whole.omega
    v = v * whole.commanded_m_s2
    rows = model_error(ready.problem, ready.reduced, law, v)
    # What all have by one cause, then four resonances and the rest.
    assert rows.shape == (1 + 5 * 4 + 2, len(practice))
    rows = rows[1:]
    peaks = whole.frequency_hz[np.argmax(np.abs(rows[0:8:2]), axis=1)]
    np.testing.assert_allclose(peaks, [18.7, 98.9, 252.6, 278.1], rtol=0.05)
    np.testing.assert_allclose(rows[10:15].sum(axis=0), GAIN * v, rtol=1e-9)


def test_noise_alone_makes_a_narrower_band(practice, zn1, found):
    ready = set_up(practice, zn1, with_effects=False)
    begun = begin(ready.problem, ready.reduced, noise_of(practice), None, zn1.core.law)
    noise = law_band(practice, begun.first.law, uncertainty_of(begun.first, noise_is_known=True))
    whole = found.result.band
    assert np.all(noise.storage_modulus_standard_error_pa < whole.storage_modulus_standard_error_pa)
    assert np.all(noise.loss_factor_standard_error < whole.loss_factor_standard_error)


def test_sizes_of_the_models_error_are_the_specimens_own(zn1):
    f = OMEGA / (2 * np.pi)
    own = model_error_at(zn1, f, TRUTH.modulus(OMEGA))
    assert np.all(own.frequency >= FREQUENCY)
    assert np.all(own.loss >= LOSS)
    thick = replace(zn1, core=replace(zn1.core, thickness_m=10 * zn1.core.thickness_m))
    more = model_error_at(thick, f, TRUTH.modulus(OMEGA))
    assert np.all(more.frequency > 2 * own.frequency)


@pytest.fixture(scope="module")
def tolerant(practice, zn1):
    return {k: identify([File(practice, only(zn1, substrate_young=k))]).result for k in (1e-9, YOUNG)}


def test_a_tolerance_widens_the_band_by_what_it_moves(practice, zn1, tolerant):
    """Var(G) is that with the number fixed, and what its own remaining error moves."""
    step = 0.005
    stiffer = moved(only(zn1, substrate_young=1e-9), ["substrate_young"], [step])
    G_fixed, G_stiffer, G = (
        r.fit.law.storage_and_loss(OMEGA)[0]
        for r in (tolerant[1e-9], identify([File(practice, stiffer)]).result, tolerant[YOUNG])
    )
    (young,) = tolerant[YOUNG].fit.adjusted
    expected = np.abs(np.log(G_stiffer / G_fixed)) / step * young.standard_error / young.found
    before, after = band_of(tolerant[1e-9])[0] / G_fixed, band_of(tolerant[YOUNG])[0] / G
    np.testing.assert_allclose(np.sqrt(after**2 - before**2), expected, rtol=0.05)


def test_the_sweep_itself_says_something_of_a_stated_number(tolerant):
    (young,) = tolerant[YOUNG].fit.adjusted
    assert young.name == "substrate_young"
    assert young.tolerance == pytest.approx(YOUNG * young.stated)
    assert young.standard_error < 0.9 * young.tolerance
    # The solid's plate is as stated.
    assert abs(young.found - young.stated) < 2 * young.standard_error


def test_with_a_laboratorys_tolerances_the_core_is_still_covered(practice, zn1, found):
    r = identify([File(practice, replace(zn1, exact=False))]).result
    assert_covered(r)
    assert np.all(band_of(r)[0] > 3 * band_of(found.result)[0])
    assert all(abs(a.pull) < 2 for a in r.fit.adjusted)
