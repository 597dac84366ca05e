"""The joint posterior of law, bend, stated numbers and model error: calibration on what the model itself
says."""

from dataclasses import replace

import numpy as np
import pytest
from paper_law import TABLE_4
from threadpoolctl import threadpool_limits

from fitting.data.noise import noise_of
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.inference.posterior import posterior
from fitting.diagnosis.inference.usual_law import within_search
from fitting.diagnosis.inference.whitening import SHARE
from fitting.diagnosis.joint import fit_of
from fitting.diagnosis.problem.model_error import model_error
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.identification.direct import fit_direct
from fitting.identification.uncertainty import uncertainty_of
from fitting.laws.bent_law import BentLaw
from fitting.laws.fractional_zener import FractionalZener
from instrument.bench.sweeps import GRID_HZ, synthetic_sweep
from instrument.models.set_up import set_up

OMEGA = 2 * np.pi * np.array([20.0, 100.0, 280.0])
SEEDS = 60
FEW = 6
NOISE = 0.005


@pytest.fixture(scope="module")
def ready(zn1):
    """The published plate with typical tolerances, every seventh point of a sweep."""
    sweep = synthetic_sweep(zn1).take(np.arange(0, len(GRID_HZ), 7))
    return set_up(sweep, replace(zn1, exact=False), with_effects=False)


class Drawn:
    """Law, bend, stated numbers, model error and noise, each from its prior; and the fit of that sweep."""

    def __init__(self, ready, seed):
        rng, problem = np.random.default_rng(seed), ready.problem
        plain = TABLE_4.with_logs(
            np.log(TABLE_4.values) + np.array([0.1, 0.1, 0.1, 0.03]) * rng.normal(size=4)
        )
        straight = BentLaw.over(plain, problem.sweep.frequency_hz)
        bend = np.exp(rng.normal(size=straight.bend_count))
        self.law = straight.with_values(np.concatenate([plain.values, bend]))
        self.z = rng.normal(size=len(problem.nuisances))
        v = SweepResponse(problem.around(self.law), ()).velocity(self.law, self.z)
        off = model_error(problem, ready.reduced, self.law, v)
        white = rng.normal(size=(2, len(v))) + 1j * rng.normal(size=(2, len(v)))
        read = v + rng.normal(size=len(off)) @ off + np.array([SHARE, NOISE]) @ white * np.abs(v)
        sweep = replace(problem.sweep, velocity_m_s=read, std_m_s=NOISE * np.abs(v))
        self.begun = begin(replace(problem, sweep=sweep), ready.reduced, noise_of(sweep), None, TABLE_4)
        self.fit = fit_of(self.begun)

    @property
    def pulls(self):
        """Of G' and of eta at three frequencies, in standard errors."""
        u = uncertainty_of(self.fit, noise_is_known=True)
        (G, eta), (G_true, eta_true) = (law.storage_and_loss(OMEGA) for law in (self.fit.law, self.law))
        dG, deta = u.law_band(self.fit.law, OMEGA)
        return [(G - G_true) / dG, (eta - eta_true) / deta]

    @property
    def stated_pulls(self):
        """Of every stated number, in standard errors: both in tolerances, as they were drawn."""
        found = self.begun.none
        C = posterior(SweepResponse(self.begun.problem, ()), self.begun.evidence, found)
        n = len(found.law.names)
        return (found.z - self.z) / np.sqrt(np.diag(C)[n : n + found.stated])


@pytest.fixture(scope="module")
def drawn(ready):
    with threadpool_limits(1, "blas"):
        return [Drawn(ready, seed) for seed in range(SEEDS)]


@pytest.fixture(scope="module")
def few(ready):
    """For what each sweep shows by itself."""
    with threadpool_limits(1, "blas"):
        return [Drawn(ready, seed) for seed in range(FEW)]


@pytest.mark.long
def test_stated_errors_cover_the_truth_where_everything_unknown_is_drawn(drawn):
    """60 sweeps: coverage of one number is known to 3 %, of all six together to 2 %."""
    pulls = np.array([one.pulls for one in drawn])
    inside = np.mean(np.abs(pulls) < 1.96, axis=0)
    assert 0.90 <= inside.mean() <= 1.0
    assert inside.min() >= 0.86
    # A mean's standard deviation is 0.13 of a pull's, a standard deviation's 9 %.
    assert np.abs(pulls.mean(axis=0)).max() < 0.4
    np.testing.assert_allclose(pulls.std(axis=0), 1, atol=0.25)


def test_a_few_sweeps_are_fitted_to_their_noise_with_honest_errors(few):
    """The same in short: what is beyond chance in any one sweep, or in their mean."""
    chi2 = np.array([one.fit.residuals @ one.fit.residuals for one in few])
    expected = few[0].fit.readings - len(TABLE_4.names)
    assert chi2.max() < expected + 4.5 * np.sqrt(2 * expected)
    assert abs(chi2.mean() / expected - 1) < 4.5 * np.sqrt(2 / expected / FEW)
    pulls, stated = (np.array([getattr(one, n) for one in few]) for n in ("pulls", "stated_pulls"))
    assert np.abs(pulls).max() < 4.5
    assert 0.3 < np.sqrt(np.mean(pulls**2)) < 1.7
    assert np.abs(stated).max() < 4.5
    assert 0.6 < np.sqrt(np.mean(stated**2)) < 1.4


@pytest.mark.long
def test_no_sweep_is_left_behind(drawn):
    """The fit is at least as good as the truth: on average by as much as it has parameters."""
    chi2 = np.array([one.fit.residuals @ one.fit.residuals for one in drawn])
    data = drawn[0].fit.readings
    # Expected: as many as there are readings less the law's own four; the priors' rows pay for themselves.
    expected = data - len(TABLE_4.names)
    assert abs(chi2.mean() / expected - 1) < 0.05
    assert chi2.max() < expected + 4.5 * np.sqrt(2 * expected)


@pytest.mark.long
def test_stated_numbers_are_as_well_known_as_is_said(drawn):
    pulls = np.array([one.stated_pulls for one in drawn])
    inside = np.mean(np.abs(pulls) < 1.96, axis=0)
    assert 0.93 <= inside.mean() <= 0.97
    assert inside.min() >= 0.85


def test_what_the_sweep_does_not_feel_keeps_its_tolerance(few):
    by_name = {a.name: a for a in few[0].fit.adjusted}
    for name in ("core_poisson", "width"):
        one = by_name[name]
        assert one.standard_error == pytest.approx(one.tolerance, rel=0.05)
        assert abs(one.pull) < 0.5
    for one in by_name.values():
        moved = one.found / one.stated if one.stated else 1.0
        # Wider by what chi-square is flatter than its curvature says (`posterior`).
        assert one.standard_error <= 1.01 * one.tolerance * max(1.0, moved)


def test_an_exact_specimen_moves_nothing_and_does_not_bend(zn1):
    sweep = synthetic_sweep(zn1).take(np.arange(0, len(GRID_HZ), 5))
    ready = set_up(sweep, zn1, with_effects=False)
    begun = begin(ready.problem, ready.reduced, noise_of(sweep), None, zn1.core.law)
    fit = fit_of(begun)
    assert fit.law.kind == "fractional-zener"
    assert (fit.law.bend_count, fit.adjusted, len(begun.none.u)) == (0, (), 0)
    pulls = np.log(fit.law.values / TABLE_4.values) / np.sqrt(np.diag(fit.covariance))
    assert np.abs(pulls).max() < 4
    # The model's error is in the covariance beside the noise.
    noise = np.linalg.inv(begun.first.jacobian.T @ begun.first.jacobian)
    assert np.all(np.diag(fit.covariance) > np.diag(noise))


def test_a_fit_by_the_law_alone_that_ran_to_its_limits_is_not_where_the_joint_one_ends(ready):
    """The plate is off by as much as a laboratory's: the law alone takes a power law without end for it."""
    with threadpool_limits(1, "blas"):
        one = Drawn(ready, 56)
    assert one.begun.first.law.ginf_pa == pytest.approx(1e11)
    assert one.begun.none.law.plain.ginf_pa < 1e8
    assert np.abs(one.pulls).max() < 2.5


def test_a_fit_by_the_law_alone_that_ended_in_a_valley_of_its_own_is_begun_again_from_the_stated_law(
    ready, monkeypatch
):
    def astray(residuals, start):
        found = fit_direct(residuals, start)
        g0, ginf, tau, alpha = found.law.values
        return replace(found, law=FractionalZener(5 * g0, ginf / 5, tau, alpha))

    monkeypatch.setattr("fitting.diagnosis.inference.begin.fit_direct", astray)
    with threadpool_limits(1, "blas"):
        one = Drawn(ready, 3)
    assert one.begun.none.chi2_per_dof < 1.5
    assert np.abs(one.pulls).max() < 2.5


def test_a_law_within_the_ranges_that_are_searched_is_left_as_it_is():
    assert within_search(TABLE_4, OMEGA) is TABLE_4


def test_one_beyond_them_is_brought_in_by_its_modulus():
    far = FractionalZener(0.3e6, 1e11, 3.2e-10, 0.83)
    near = within_search(far, OMEGA)
    for value, q in zip(near.values, near.limits, strict=True):
        assert q.search[0] * (1 - 1e-6) <= value <= q.search[1] * (1 + 1e-6)
    np.testing.assert_allclose(near.modulus(OMEGA), far.modulus(OMEGA), rtol=0.02)


def test_one_far_beyond_them_keeps_its_modulus():
    """No usual law is as stiff as a free layer: a place to begin ten times softer is none."""
    stiff = FractionalZener(0.15e9, 1.3e9, 3e-5, 0.5)
    np.testing.assert_allclose(within_search(stiff, OMEGA).modulus(OMEGA), stiff.modulus(OMEGA), rtol=0.01)


def test_one_far_beyond_them_begins_off_its_limits():
    stiff = FractionalZener(0.15e9, 1e11, 3e-10, 0.5)
    near = within_search(stiff, OMEGA)
    assert near.ginf_pa < 0.5e11
    np.testing.assert_allclose(near.modulus(OMEGA), stiff.modulus(OMEGA), rtol=0.05)


def test_where_the_law_alone_began_from_does_not_matter_to_what_has_come_to_its_end(ready):
    begun = Drawn(ready, 0).begun
    cut_short = replace(begun, first=replace(begun.first, converged=False))
    assert fit_of(cut_short).converged
    assert not fit_of(replace(begun, none=replace(begun.none, converged=False))).converged
