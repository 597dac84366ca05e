from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from paper_law import TABLE_4

from fitting.data.noise import Noise, noise_of
from fitting.errors import TooFewPoints
from fitting.identification import direct
from fitting.identification.model import SweepModel
from fitting.identification.residuals import Residuals
from fitting.identification.result import (
    differences_percent,
    summarise,
)
from fitting.identification.uncertainty import uncertainty_of
from fitting.identification.validation import Validation
from fitting.laws.constant import ConstantModulus
from fitting.laws.fractional_zener import FractionalZener
from fitting.laws.generalised_maxwell import GeneralisedMaxwell
from fitting.laws.isd112 import Isd112
from instrument.bench.sweeps import GRID_HZ, synthetic_sweep


def residuals_of(sweep, models, reads="relative", noise=None):
    model = SweepModel.of(sweep, models.rational(np.unique(sweep.omega)), reads)
    return Residuals.of(sweep, noise or noise_of(sweep), model)


@pytest.fixture(scope="module")
def nine(table5, zn1_models):
    return residuals_of(table5, zn1_models)


@pytest.fixture(scope="module")
def many(zn1):
    return synthetic_sweep(zn1, seed=0)


@pytest.fixture(scope="module")
def many_residuals(many, zn1_models):
    return residuals_of(many, zn1_models)


def rms_of(residuals, law):
    return 100 * np.sqrt(np.mean(residuals(law) ** 2))


def test_table_5_is_fitted_to_its_known_remainder(nine, zn1):
    fit = direct.fit_direct(nine, zn1.core.law)
    assert fit.converged
    assert rms_of(nine, fit.law) == pytest.approx(5.2, abs=0.2)


def test_table_5_leaves_its_known_error_one_point_out(nine, table5, zn1):
    law = direct.fit_direct(nine, zn1.core.law).law
    points = np.arange(9)
    left_out = [
        differences_percent(table5, nine.model.velocity(direct.refit(nine.take(points != k), law)))[k]
        for k in points
    ]
    assert np.sqrt(np.mean(np.square(left_out))) == pytest.approx(8.8, abs=0.3)


@given(
    st.floats(np.log(0.05), np.log(2)),
    st.floats(np.log(2), np.log(30)),
    st.floats(np.log(1e-5), np.log(1e-3)),
    st.floats(0.4, 1.0),
)
def test_table_5_gives_the_same_law_from_any_sane_start(nine, log_g0, log_ginf, log_tau, alpha):
    start = FractionalZener(1e6 * np.exp(log_g0), 1e6 * np.exp(log_ginf), float(np.exp(log_tau)), alpha)
    law = direct.fit_direct(nine, start).law
    assert rms_of(nine, law) == pytest.approx(5.1948, abs=1e-3)
    np.testing.assert_allclose(law.values, [2.930e5, 2.645e6, 2.826e-4, 0.9836], rtol=1e-2)


@pytest.mark.parametrize("data", ["phasors", "amplitudes"])
@pytest.mark.parametrize("reads", ["relative", "absolute"])
@pytest.mark.parametrize(
    "law",
    [TABLE_4, ConstantModulus(0.5e6, 0.7), GeneralisedMaxwell(0.2e6, (0.3e6, 1e6), (2e-3, 2e-4))],
    ids=lambda law: law.kind,
)
def test_jacobian_agrees_with_central_differences(many, zn1_models, law, data, reads):
    sweep = many
    if data == "amplitudes":
        sweep = replace(many, velocity_m_s=np.abs(many.velocity_m_s))
    residuals = residuals_of(sweep, zn1_models, reads)
    _, J = residuals.with_jacobian(law)
    h = 1e-5
    for k in range(len(law.values)):
        step = np.zeros(len(law.values))
        step[k] = h
        up, down = (residuals(law.with_logs(np.log(law.values) + s * step)) for s in (1, -1))
        difference = (up - down) / (2 * h)
        assert np.max(np.abs(J[:, k] - difference)) < 1e-6 * np.max(np.abs(J))


def test_noisy_sweep_gives_back_its_law(many_residuals, zn1):
    fit = direct.fit_direct(many_residuals, zn1.core.law)
    uncertainty = uncertainty_of(fit, noise_is_known=True)
    z = (np.log(fit.law.values) - np.log(TABLE_4.values)) / uncertainty.standard_errors
    assert np.all(np.abs(z) < 4)
    assert uncertainty.chi2_per_dof == pytest.approx(1, abs=0.15)


@pytest.mark.parametrize("noise", ["stated", "local scatter"])
def test_standard_errors_cover_the_truth_over_200_seeds(zn1, zn1_models, noise):
    frame = synthetic_sweep(zn1).take(np.arange(0, len(GRID_HZ), 2))
    clean = zn1_models.predict(TABLE_4, frame.frequency_hz)
    model = SweepModel.of(frame, zn1_models.rational(frame.omega), "relative")
    z, inside = [], []
    omega = 2 * np.pi * np.array([20.0, 100.0, 280.0])
    G_true, eta_true = TABLE_4.storage_and_loss(omega)
    for seed in range(200):
        rng = np.random.default_rng(seed)
        scatter = 0.005 * np.abs(clean) * (rng.normal(size=len(clean)) + 1j * rng.normal(size=len(clean)))
        sweep = replace(
            frame,
            velocity_m_s=clean + scatter,
            std_m_s=0.005 * np.abs(clean) if noise == "stated" else None,
        )
        fit_residuals = Residuals.of(sweep, noise_of(sweep), model)
        law = direct.refit(fit_residuals, TABLE_4)
        r, J = fit_residuals.with_jacobian(law)
        fit = direct.Fit(law, r, J, model.velocity(law), 1, 1, converged=True)
        u = uncertainty_of(fit, noise_is_known=True)
        z.append((np.log(law.values) - np.log(TABLE_4.values)) / u.standard_errors)
        (G, eta), (dG, deta) = law.storage_and_loss(omega), u.law_band(law, omega)
        inside.append([np.abs(G - G_true) < 1.96 * dG, np.abs(eta - eta_true) < 1.96 * deta])
    # 200 seeds: the standard deviation of z is known to 5 %, its mean to 7 %, coverage to 1.5 %
    np.testing.assert_allclose(np.std(z, axis=0), 1, atol=0.15)
    np.testing.assert_allclose(np.mean(z, axis=0), 0, atol=0.25)
    coverage = np.mean(inside, axis=0)
    assert np.all((coverage > 0.90) & (coverage <= 0.995)), coverage


def test_a_law_without_parameters_is_refused(nine):
    with pytest.raises(TooFewPoints, match="no parameter"):
        direct.fit_direct(nine, Isd112())


def test_one_point_is_refused(nine, zn1):
    with pytest.raises(TooFewPoints, match="1 point"):
        direct.fit_direct(nine.take(np.array([0])), zn1.core.law)


def warnings_of(sweep, residuals, start):
    fit = direct.fit_direct(residuals, start)
    return " ".join(summarise("direct", sweep, noise_of(sweep), fit, Validation()).warnings)


def test_too_few_points_are_warned_of_and_carry_no_standard_error(table5, nine, zn1):
    few = np.arange(4)
    sweep = table5.take(few)
    fit = direct.fit_direct(nine.take(few), zn1.core.law)
    result = summarise("direct", sweep, noise_of(sweep), fit, Validation())
    assert any("too few points" in w for w in result.warnings)
    assert all(np.isnan(v) for v in result.standard_errors.values())


def test_a_parameter_at_its_bound_is_named(many, zn1_models):
    # A core that follows a power faster than the law allows drives alpha to 1.
    steep = GeneralisedMaxwell(0.25e6, (3e6,), (1e-4,))
    model = SweepModel.of(many, zn1_models.rational(many.omega), "relative")
    sweep = replace(many, velocity_m_s=model.velocity(steep))
    said = warnings_of(sweep, Residuals.of(sweep, noise_of(many), model), TABLE_4)
    assert "alpha sits at its upper bound" in said


def test_correlated_parameters_are_named(many, zn1_models):
    low = many.take(many.segment == 1)
    residuals = residuals_of(replace(low), zn1_models)
    assert "correlated" in warnings_of(low, residuals, TABLE_4)


def test_misfit_beyond_the_noise_is_named_and_widens_the_errors(many, zn1_models):
    bent = replace(many, velocity_m_s=many.velocity_m_s * (1 + 0.03 * np.sin(many.frequency_hz)))
    residuals = residuals_of(bent, zn1_models)
    assert "the model lacks something" in warnings_of(bent, residuals, TABLE_4)
    fit = direct.fit_direct(residuals, TABLE_4)
    wide = uncertainty_of(fit, noise_is_known=True)
    assert wide.chi2_per_dof > 2
    plain = np.linalg.inv(fit.jacobian.T @ fit.jacobian)
    np.testing.assert_allclose(wide.standard_errors, np.sqrt(np.diag(plain) * wide.chi2_per_dof), rtol=1e-6)


def test_levels_scale_the_prediction(many, zn1_models):
    doubled = replace(
        many, commanded_m_s2=2 * many.commanded_m_s2, velocity_m_s=2 * many.velocity_m_s, std_m_s=None
    )
    noise = Noise(2 * many.std_m_s, "stated")
    residuals = residuals_of(doubled, zn1_models, noise=noise)
    law = direct.refit(residuals, TABLE_4)
    np.testing.assert_allclose(
        law.values, direct.refit(residuals_of(many, zn1_models), TABLE_4).values, rtol=1e-6
    )


def test_equal_weights_change_nothing(many, zn1_models, zn1):
    weighted = replace(many, weight=np.full(353, 0.06))
    plain, alike = (
        summarise(
            "direct",
            s,
            noise_of(s),
            direct.fit_direct(residuals_of(s, zn1_models), zn1.core.law),
            Validation(),
        )
        for s in (many, weighted)
    )
    np.testing.assert_allclose(alike.law.values, plain.law.values, rtol=1e-6)
    assert alike.standard_errors == pytest.approx(plain.standard_errors, rel=1e-4)
    assert alike.uncertainty.chi2_per_dof == pytest.approx(plain.uncertainty.chi2_per_dof, rel=1e-6)


def test_unequal_weights_choose_and_pay_for_it(many, zn1_models):
    # A weight of almost nothing on a segment: the rest decides, the errors are those of the rest.
    weight = np.where(many.segment == 1, 1e-4, 1.0)
    weighted = residuals_of(replace(many, weight=weight), zn1_models)
    rest = many.segment != 1
    alone = residuals_of(many, zn1_models).take(rest)
    found, expected = (direct.fit_direct(r, TABLE_4) for r in (weighted, alone))
    np.testing.assert_allclose(found.law.values, expected.law.values, rtol=1e-3)
    errors = [uncertainty_of(f, noise_is_known=True).standard_errors for f in (found, expected)]
    np.testing.assert_allclose(errors[0], errors[1], rtol=0.1)


def test_a_lossless_start_is_lifted_off_zero(many, zn1_models):
    fit = direct.fit_direct(
        residuals_of(many.take(many.segment == 1), zn1_models), ConstantModulus(0.4e6, 0.0)
    )
    assert fit.law.loss_factor == pytest.approx(0.35, abs=0.05)


def test_all_parameters_at_their_bounds_leave_no_covariance(many, zn1_models):
    residuals = residuals_of(many, zn1_models)
    law = ConstantModulus(1e2, 1e-6)
    r, J = residuals.with_jacobian(law)
    u = uncertainty_of(
        direct.Fit(law, r, J, residuals.model.velocity(law), 1, 1, converged=True), noise_is_known=True
    )
    assert set(u.at_bound.values()) == {"lower"}
    assert not u.covariance.any()


def test_a_parameter_the_data_leave_open_is_named(table5, nine, zn1):
    sweep = table5.take(np.array([0, 1, 3, 4, 5]))
    said = warnings_of(sweep, nine.take(np.array([0, 1, 3, 4, 5])), zn1.core.law)
    assert "bound" in said or "not fixed" in said
