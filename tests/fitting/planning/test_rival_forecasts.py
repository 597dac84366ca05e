"""What rivals expect of further readings of a shear pair, a gain and a mass both fitted to its first ones."""

from dataclasses import replace

import numpy as np
import pytest
from shear_pair_problem import GAIN, HIGH, MASS, ShearPairProblem

from fitting.diagnosis.inference.usual_law import polished
from fitting.diagnosis.inference.whitening import SHARE
from fitting.diagnosis.verdict.result import Rivals
from fitting.planning.further_readings import FurtherReadings
from fitting.planning.rival_forecasts import RivalForecasts
from fitting.planning.sensitivity import ReadingNoise

AT = np.arange(0, 60, 5)
NOISE = ReadingNoise(0.0, 2e-3)


@pytest.fixture(scope="module")
def expecting():
    begun = ShearPairProblem(HIGH).begun
    fits = [
        polished(begun.problem, [e], begun.evidence, begun.none.law, np.append(begun.problem.as_stated, u))
        for e, u in ((GAIN, HIGH), (MASS, 0.0))
    ]
    return RivalForecasts(Rivals(begun.problem, begun.evidence, ((fits[0], 0.8), (fits[1], 0.2))), 6)


@pytest.fixture(scope="module")
def again(expecting):
    """The same readings once more, half a second each."""
    return FurtherReadings(expecting.member, AT, np.full(len(AT), 0.5))


def phasors(expecting, forecast, further, v):
    """The mean of a forecast in m/s."""
    sigma = np.hypot(NOISE.std_m_s(v, further.dwell_s), SHARE * np.abs(v))
    return (forecast.mean[: len(AT)] + 1j * forecast.mean[len(AT) :]) * sigma


def spread(forecast):
    return np.linalg.norm(forecast.root, axis=1)


def test_rivals_are_asked_with_their_probabilities_the_likeliest_first(expecting):
    assert expecting.names == ("gain_error", "added_mass")
    assert expecting.of == [0, 1]
    np.testing.assert_allclose(expecting.probabilities, [0.8, 0.2])
    assert expecting.read_m == ()
    assert not expecting.in_time


def test_every_rival_expects_the_same_again_as_it_was_read(expecting, again):
    measured = expecting.evidence.measured_m_s[AT]
    v = expecting.learnt[0].fitted.velocity_m_s[AT]
    forecasts = expecting.forecasts(again, NOISE)
    assert len(forecasts) == len(expecting.names)
    expected = phasors(expecting, forecasts[0], again, v)
    assert np.sqrt(np.mean(np.abs(expected / measured - 1) ** 2)) < 4e-3
    np.testing.assert_allclose(expecting.velocity_m_s(again), np.abs(measured), rtol=0.02)


def errors(known):
    """Of what is fitted, then of the model's errors; and the first as the fit has them."""
    return np.sqrt(np.diag(known.root @ known.root.T)), np.sqrt(np.diag(known.fitted.covariance))


def test_a_rival_knows_its_numbers_as_well_as_its_fit_does(expecting):
    found, own = errors(expecting.learnt[0])
    assert len(found) == len(own) + expecting.evidence.B.shape[1]
    np.testing.assert_allclose(found[: len(own)], own, rtol=0.06)
    # The model's own errors are known no worse than beforehand.
    assert (found[len(own) :] < 1 + 1e-9).all()


def test_what_readings_leave_open_an_effect_s_usual_size_bounds(expecting):
    # A pair's mass hides in its law: the fit knows the ratio alone.
    found, own = errors(expecting.learnt[1])
    spread_kg = MASS.parameters[0].spread
    assert found[len(own) - 1] < 1.2 * spread_kg < own[-1] / 3


def test_the_same_again_is_known_but_for_its_noise(expecting, again):
    forecasts = expecting.forecasts(again, NOISE)
    assert len(forecasts) == len(expecting.names)
    for forecast in forecasts:
        assert forecast.known == forecast.root.shape[1]
        assert (spread(forecast) < 1).all()


def test_errors_made_anew_are_not_those_of_the_first_sweep(expecting, again):
    first, anew = (expecting.forecasts(replace(again, same_errors=same), NOISE)[0] for same in (True, False))
    v = expecting.learnt[0].fitted.velocity_m_s[AT]
    # Without what the first sweep showed of them the mean is the fit's own.
    np.testing.assert_allclose(phasors(expecting, anew, again, v), v, rtol=1e-9)
    assert np.abs(first.mean - anew.mean).max() > 1e-3
    assert anew.known == first.known < anew.root.shape[1]
    assert (spread(anew) > spread(first)).all()


def test_the_model_errs_as_it_does_under_the_likeliest_law_whatever_law_the_readings_were_judged_by(
    expecting, again
):
    evidence = replace(expecting.evidence, B=expecting.evidence.B[:, :-1])
    each = tuple((known.fitted, p) for known, p in zip(expecting.learnt, (0.8, 0.2), strict=True))
    other = RivalForecasts(Rivals(expecting.problem, evidence, each), 6)
    for found, forecast in zip(other.forecasts(again, NOISE), expecting.forecasts(again, NOISE), strict=True):
        np.testing.assert_allclose(found.mean, forecast.mean, rtol=1e-9)
        np.testing.assert_allclose(spread(found), spread(forecast), rtol=1e-9)


def test_a_channel_that_is_another_one_is_as_uncertain_as_it_is_stated(expecting, again):
    plain = replace(again, same_errors=False)
    anew = replace(plain, new=frozenset({"gain"}))
    same, other = (expecting.forecasts(f, NOISE)[0] for f in (plain, anew))
    assert other.root.shape[1] == same.root.shape[1] + 1
    fresh = other.root[:, other.known]
    v = expecting.learnt[0].fitted.velocity_m_s[AT]
    sigma = np.hypot(NOISE.std_m_s(v, again.dwell_s), SHARE * np.abs(v))
    moved = (fresh[: len(AT)] + 1j * fresh[len(AT) :]) * sigma / v
    # By its tolerance of half a percent, everywhere alike.
    np.testing.assert_allclose(moved, 0.005, rtol=2e-2, atol=1e-5)
    # And nothing is left of what the first sweep showed of its own, to him who takes no gain for the cause.
    z = expecting.learnt[1].fitted.z[[n.name for n in expecting.member.nuisances.each].index("gain")]
    first, fresh = (phasors(expecting, expecting.forecasts(f, NOISE)[1], f, v) for f in (plain, anew))
    np.testing.assert_allclose(first / fresh, 1 + 0.005 * z, rtol=1e-4)
    assert abs(z) > 1


def test_without_its_effect_a_rival_expects_the_channel_as_it_is_taken_for(expecting, again):
    plain = replace(again, same_errors=False)
    without = replace(plain, without=frozenset({"gain_error"}))
    found = expecting.velocity_m_s(plain) / expecting.velocity_m_s(without)
    np.testing.assert_allclose(found, expecting.learnt[0].fitted.of(GAIN)[0], rtol=1e-9)


def test_rows_of_some_points_are_both_their_parts(expecting):
    assert expecting.rows(np.array([1, 3]), 10).tolist() == [1, 3, 11, 13]
