"""Results read off fits: a core band by band, a law over temperatures, causes of what modes show."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from beam_tables import BEAM, FACE, LAW, read
from result_cases import identification
from shear_pair_cases import G_0, transmissibility
from shear_pair_temperatures import LOG_A, PAIR, REFERENCE, T, alone, fitted, shifted

from fitting.diagnosis.verdict.result import FoundEffect, ParameterEstimate
from fitting.identification.doubt import Doubt
from fitting.identification.pointwise import PointwiseLaw
from fitting.identification.result import LawBand
from fitting.mode_tables.build import member_of
from fitting.mode_tables.diagnose import diagnose_modes
from fitting.mode_tables.problem import ModalProblem
from fitting.mode_tables.standing import standing
from fitting.temperature.simple import Verdict
from instrument.finding.modal import TablesDiagnosed
from instrument.finding.pointwise import Pointwise
from instrument.results.modal_diagnosis_from import modal_diagnosis_from
from instrument.results.pointwise_from import bands_from, causality_from, with_second_look
from instrument.results.shifted_from import shifted_from
from instrument.temperatures.shifted import AtTemperature, Shifted

# Band by band


def core():
    """Two bands, the second of which is felt by nothing."""
    return PointwiseLaw(
        np.array([10.0, 30.0]),
        np.array([2e6 * (1 + 0.5j), np.nan]),
        np.array([np.diag([1e8, 4e8]), np.full((2, 2), np.nan)]),
        np.zeros((0, 2, 2)),
        np.array([0.005, np.nan]),
        np.array([True, False]),
        ("", "nothing is felt here"),
        np.array([5, 2]),
        np.zeros(2),
    )


CAUSAL = SimpleNamespace(
    consistent=np.bool_(False), p_value=1e-6, chi2_per_dof=4.0, frequency_hz=np.ones(7), words="refuted"
)


def test_a_band_is_a_row_with_its_errors_or_with_why_it_has_none():
    first, second = bands_from(core())
    assert (first.frequency_hz, first.points, first.determined, first.reason) == (10.0, 5, True, None)
    assert (first.storage_modulus_pa, first.loss_factor) == pytest.approx((2e6, 0.5))
    assert first.storage_modulus_standard_error_pa == pytest.approx(1e4)
    # Of G''/G': both parts' errors, the second by eta.
    assert first.loss_factor_standard_error == pytest.approx(np.hypot(2e4, 0.5e4) / 2e6)
    assert second.as_json() == {
        "frequency_hz": 30.0,
        "storage_modulus_pa": None,
        "loss_factor": None,
        "storage_modulus_standard_error_pa": None,
        "loss_factor_standard_error": None,
        "points": 2,
        "determined": False,
        "reason": "nothing is felt here",
    }


def test_causality_is_said_with_its_sentence_where_it_could_be_judged():
    found = causality_from(CAUSAL)
    assert (found.consistent, found.bands, found.words) == (False, 7, "refuted")
    both, bands = (with_second_look(identification(), Pointwise(core(), c, "")) for c in (CAUSAL, None))
    assert both.kramers_kronig == found
    assert bands.kramers_kronig is None
    assert len(bands.pointwise) == 2
    assert bands.parameters == identification().parameters


# Temperatures


def at_temperatures(*, vertical=False, cause=None, remarks=()):
    _, fit, each = fitted(shifted((1.1, 1.0, 0.95)) if vertical else shifted(), vertical=vertical)
    band = LawBand(*(np.array([50.0, 4000.0]) for _ in range(5)))
    verdict = Verdict(True, 0.4, 1.2, "simple")
    sweeps = [AtTemperature(b.problem.sweep, t, f"{t:g}.csv") for b, t in zip(each, T.tolist(), strict=True)]
    found = Shifted(fit, verdict, band, alone(each), cause, 2.0, remarks)
    return fit, shifted_from(found, sweeps)


def test_shifts_are_decades_with_their_errors_in_the_order_of_the_files():
    fit, result = at_temperatures()
    assert [one.name for one in result.temperatures] == ["10.csv", "20.csv", "30.csv"]
    np.testing.assert_allclose(
        [one.log10_shift for one in result.temperatures], LOG_A / np.log(10), atol=0.01
    )
    errors = [one.log10_shift_standard_error for one in result.temperatures]
    np.testing.assert_allclose(errors, fit.log_shift_errors / np.log(10))
    assert [(one.vertical, one.vertical_standard_error) for one in result.temperatures] == 3 * [(1.0, 0.0)]
    assert (result.shift, result.reference_c, result.simple) == ("free", REFERENCE, True)
    assert set(result.shift_parameters) == {"ln_shift at 10 degC", "ln_shift at 30 degC"}
    assert (result.p_value, result.wicket_percent, result.words) == (0.4, 1.2, "simple")
    assert result.chi2 == fit.chi2 > result.chi2_each_alone
    assert result.common_cause is None


def test_what_one_law_leaves_of_a_sweep_is_of_its_own_amplitudes():
    fit, result = at_temperatures()
    sweeps = [m.sweep for m in fit.joined.problem.members]
    law = [fit.joint.at(k) for k in range(3)]
    for one, sweep, own in zip(result.temperatures, sweeps, law, strict=True):
        T_mass = transmissibility(PAIR, sweep.frequency_hz, own.modulus(sweep.omega))
        off = np.abs(T_mass * G_0 / sweep.omega / sweep.velocity_m_s) - 1
        assert one.rms_percent == pytest.approx(100 * np.sqrt(np.mean(off**2)), rel=0.01)


def test_what_a_law_over_temperatures_says_against_itself_is_told_apart():
    _, result = at_temperatures(remarks=("a remark", Doubt("a doubt")))
    assert result.warnings[-2:] == ("a remark", "a doubt")
    assert result.doubts == ("a doubt",)


def test_a_vertical_shift_is_a_factor_with_its_error():
    fit, result = at_temperatures(vertical=True)
    factors = np.array([one.vertical for one in result.temperatures])
    errors = np.array([one.vertical_standard_error for one in result.temperatures])
    np.testing.assert_allclose(factors, np.exp(fit.log_vertical))
    np.testing.assert_allclose(errors[[0, 2]], (factors * fit.log_vertical_errors)[[0, 2]])
    assert errors[1] == 0.0


def test_parameters_have_the_errors_of_their_logarithms_times_their_size():
    fit, result = at_temperatures()
    relative = np.sqrt(np.diag(fit.law_covariance))
    for name, value, error in zip(fit.law.names, fit.law.values, relative, strict=True):
        assert result.parameters[name] == pytest.approx(value)
        assert result.standard_errors[name] == pytest.approx(value * error)


def test_a_cause_that_all_sweeps_have_is_named_with_its_size():
    estimate = ParameterEstimate(1.03, 0.01, "1")
    effect = FoundEffect("gain_error", {"factor": estimate})
    cause = SimpleNamespace(effect=SimpleNamespace(name="gain_error"), found=effect)
    _, result = at_temperatures(cause=cause)
    assert result.common_cause.name == "gain_error"
    assert result.common_cause.parameters["factor"].value == 1.03


# Tables of modes


FORMS = {e.name: e for e in standing([BEAM])}


SAID = ("a remark", Doubt("a doubt"))


def diagnosed(table, *names):
    effects = tuple(FORMS[name] for name in names)
    found = diagnose_modes(ModalProblem.of([member_of(table, BEAM)]), effects, LAW)
    return modal_diagnosis_from(TablesDiagnosed(found, effects, 0.5, 1.5, SAID), [table], ["a.csv"])


@pytest.fixture(scope="module")
def stiffer():
    table = read(replace(BEAM, substrate=replace(FACE, young_pa=1.35 * 70e9)), 4)
    return table, diagnosed(table, "substrate_stiffness")


def test_a_named_effect_has_its_size_and_each_mode_what_is_left_before_and_after(stiffer):
    table, result = stiffer
    assert (result.verdict, result.equivalent) == (
        "effect",
        {"substrate_stiffness": ("substrate_stiffness",)},
    )
    (effect,) = result.effects
    (factor,) = effect.parameters.values()
    assert abs(factor.value - 1.35) < 3 * factor.standard_error
    assert [m.mode for m in result.modes] == [1, 2, 3, 4]
    assert [m.frequency_hz for m in result.modes] == table.frequency_hz.tolist()
    off = [
        [getattr(m, f"{when}_hz") / m.frequency_hz - 1 for m in result.modes] for when in ("before", "after")
    ]
    assert result.before.rms_percent == pytest.approx(100 * np.sqrt(np.mean(np.square(off[0]))))
    assert result.after.max_percent == pytest.approx(100 * np.abs(off[1]).max())
    assert result.after.rms_percent < result.before.rms_percent


def test_the_json_of_tables_has_the_keys_of_a_sweep_s(stiffer):
    written = stiffer[1].as_json()
    assert [written[key] for key in ("p_value", "nested_held_out_rms_percent", "unseen")] == [None, None, []]
    for stage in ("before", "after"):
        assert written[stage]["held_out"] == []
        assert written[stage]["held_out_rms_percent"] is None


def test_candidates_carry_their_probability_and_the_story_says_what_was_found(stiffer):
    _, result = stiffer
    assert [c.name for c in result.candidates] == ["substrate_stiffness", "unlisted", "none"]
    assert result.candidates[0].delta_bic == 0.0 < result.candidates[1].delta_bic
    assert sum(c.probability for c in result.candidates) == pytest.approx(1.0)
    first, likely, left = result.explanation
    assert first.startswith("One law leaves")
    assert likely.startswith("Most likely ")
    assert left == f"With it {result.after.rms_percent:.2g} % is left."
    assert (result.files, result.warnings, result.seconds) == (("a.csv",), ("a remark", "a doubt"), 1.5)
    assert result.doubts == ("a doubt",)


def test_of_a_beam_as_stated_no_effect_is_called_for():
    result = diagnosed(read(BEAM, 4), "substrate_stiffness")
    assert (result.verdict, result.effects) == ("none", ())
    assert result.explanation[-1] == "That is what the modes' errors leave: no effect is called for."
    assert result.after.rms_percent == result.before.rms_percent


def test_every_candidate_of_tables_has_its_own_law(stiffer):
    _, result = stiffer
    named, akin, none = (c.law for c in result.candidates)
    wide = [np.array([row.storage_modulus_standard_error_pa for row in law]) for law in (named, akin)]
    assert (wide[1] > wide[0]).all()
    at_100 = [next(row for row in law if row.frequency_hz == 100.0) for law in (named, none)]
    off = [abs(row.storage_modulus_pa / 3e6 - 1) for row in at_100]
    assert off[0] < off[1]


def test_what_tables_show_and_no_catalogue_has_makes_a_band_that_holds_the_law():
    table = read(replace(BEAM, substrate=replace(FACE, young_pa=1.35 * 70e9)))
    other = replace(table, frequency_hz=table.frequency_hz * (1 + 0.01 * (-1) ** table.mode))
    result = diagnosed(other, "substrate_stiffness")
    assert (result.verdict, result.effects) == ("unknown", ())
    assert "nothing that was tried explains it" in " ".join(result.explanation)
    assert result.candidates[0].name == "unlisted"
    for row in result.after.law:
        off = np.array([row.storage_modulus_pa - 3e6, row.loss_factor - 0.5])
        known = [row.storage_modulus_standard_error_pa, row.loss_factor_standard_error]
        assert (np.abs(off) < 2 * np.array(known)).all()


def test_that_it_may_be_something_like_it_is_said():
    table = read(replace(BEAM, substrate=replace(FACE, young_pa=1.35 * 70e9)))
    other = replace(table, frequency_hz=table.frequency_hz * (1 - 0.002 * (-1) ** table.mode))
    result = diagnosed(other, "substrate_stiffness")
    assert result.equivalent == {"substrate_stiffness": ("substrate_stiffness", "unlisted")}
    assert "That it is something of its kind, in no catalogue, has " in " ".join(result.explanation)
