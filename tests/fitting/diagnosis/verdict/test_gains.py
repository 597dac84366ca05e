"""What resampling, stages and predictions say, on fits drawn by hand."""

from types import SimpleNamespace

import numpy as np
import pytest
from fitted_by_hand import FittedByHand

from fitting.diagnosis.checks.prediction import over_noise
from fitting.diagnosis.executor import ALONE
from fitting.diagnosis.search.catalogue_search import Search
from fitting.diagnosis.verdict.resampling import REPEATS, SMALL, gain, nested_rms_percent, resampled_of
from fitting.diagnosis.verdict.stage import found_effects, mixture_of
from fitting.effects.gain_error import GainErrorEffect
from fitting.effects.tether import TetherEffect
from fitting.identification.known_curve import KnownCurve
from fitting.identification.result import LawBand


def quiet(fraction):
    """Nobody listens."""


def again(points, segments=1, parameters=4):
    """Without an effect the search gains 0, 1, 2, ...; a point left out is predicted 3 % off."""
    segment = np.arange(points) % segments
    return SimpleNamespace(
        case=SimpleNamespace(
            problem=SimpleNamespace(sweep=Sized(points, segment)),
            start=SimpleNamespace(names=["p"] * parameters),
        ),
        gain_without_effect=float,
        left_out=lambda held: np.full(held.sum(), 3.0),
    )


class Sized:
    has_phase = True

    def __init__(self, points, segment):
        self.points, self.segment = points, segment

    def __len__(self):
        return self.points


def test_the_best_gains_what_it_costs_less_and_nothing_found_gains_nothing():
    none, better, worse = (SimpleNamespace(cost=c) for c in (100.0, 88.0, 130.0))
    assert gain(none, [worse, better]) == 12.0
    assert gain(none, []) == -np.inf


def test_a_gain_is_counted_among_those_of_sweeps_without_effect():
    found = resampled_of(again(10), REPEATS - 2.0, None, ALONE, quiet)
    # Of nineteen, 0 to 18, two gain as much: one and these of twenty.
    assert found.p_value == pytest.approx(3 / 20)
    assert found.nested_rms_percent == pytest.approx(3.0)


def test_of_many_points_nobody_resamples_unasked():
    assert resampled_of(again(SMALL + 1), 5.0, None, ALONE, quiet).p_value is None
    assert resampled_of(again(SMALL + 1), 9.0, 4, ALONE, quiet).p_value == pytest.approx(1 / 5)


def test_what_cannot_be_learnt_without_a_part_is_not_left_out():
    assert nested_rms_percent(again(3, parameters=4), ALONE, quiet) is None
    assert nested_rms_percent(again(SMALL + 5, segments=1), ALONE, quiet) is None
    assert nested_rms_percent(again(SMALL + 5, segments=2), ALONE, quiet) == pytest.approx(3.0)


def test_a_prediction_s_error_is_over_the_noise_of_its_segment():
    held = [SimpleNamespace(rms_percent=r, noise_percent=n) for r, n in ((2.0, 1.0), (9.0, 3.0), (1.0, 10.0))]
    assert over_noise(SimpleNamespace(held_out=held)) == pytest.approx(2.0)
    assert np.isnan(over_noise(SimpleNamespace(held_out=[])))


@pytest.mark.parametrize(("segments", "off"), [([1, 1, 2], 2.0), ([1, 1, 1], np.nan)])
def test_no_verdict_goes_by_stretches_of_one_piece(segments, off):
    said = SimpleNamespace(held_out=[SimpleNamespace(rms_percent=2.0, noise_percent=1.0)])
    sweep = SimpleNamespace(segment=np.array(segments))
    search = SimpleNamespace(problem=SimpleNamespace(sweep=sweep), validation=lambda scored: said)
    assert Search.off_unseen(search, None) == pytest.approx(off, nan_ok=True)


def test_laws_that_disagree_widen_their_mixture():
    f, same = np.array([10.0, 100.0]), np.array([0.5, 0.6])
    bands = [LawBand(f, np.full(2, G), same, np.full(2, 3.0), np.full(2, 0.01)) for G in (100.0, 108.0)]
    mixed = mixture_of(bands, np.array([0.75, 0.25]))
    assert mixed.storage_modulus_pa == pytest.approx([102.0, 102.0])
    # Variances within, and that of two values eight apart: 0.75 * 0.25 * 64.
    assert mixed.storage_modulus_standard_error_pa == pytest.approx(np.sqrt(9 + 12) * np.ones(2))
    assert mixed.loss_factor_standard_error == pytest.approx([0.01, 0.01])


def test_laws_that_are_all_wrong_are_known_no_better_where_they_cross():
    f = np.geomspace(10.0, 1000.0, 41)
    slope, small = np.log10(f / 100.0), np.full(41, 1e-3)
    bands = [LawBand(f, 1e6 * (1 + s * slope), np.full(41, 0.3), 1e3 + 0 * f, small) for s in (0.1, -0.1)]
    shares = np.array([0.5, 0.5])
    plain, wrong = (mixture_of(bands, shares, all_wrong=one) for one in (False, True))
    assert plain.storage_modulus_standard_error_pa[20] == pytest.approx(1e3)
    # As far apart as an octave away: the mean square of 0.1 log10(f / 100 Hz), one ln 2 to either side.
    assert wrong.storage_modulus_standard_error_pa[20] == pytest.approx(1e5 * np.log10(2.0), rel=0.05)
    assert np.all(wrong.storage_modulus_standard_error_pa >= plain.storage_modulus_standard_error_pa)
    assert wrong.storage_modulus_pa == pytest.approx(plain.storage_modulus_pa)
    assert wrong.loss_factor_standard_error == pytest.approx(small)


def test_a_curve_over_laws_that_are_all_wrong_is_known_no_better_than_their_band():
    f, small = np.geomspace(10.0, 1000.0, 41), np.full(41, 1e-3)
    known = KnownCurve(f, np.zeros((82, 82)), np.zeros((82, 82)), np.zeros((82, 0)))
    slope = 0.1 * np.log10(f / 100.0)
    bands = [LawBand(f, np.exp(s * slope), small, small, small, known) for s in (1, -1)]
    wrong = mixture_of(bands, np.array([0.5, 0.5]), all_wrong=True)
    at = np.sqrt(f[1:] * f[:-1])
    errors = np.sqrt(np.diag(wrong.known.at(at).covariance)[:40])
    np.testing.assert_allclose(errors, np.interp(at, f, wrong.storage_modulus_standard_error_pa), rtol=0.02)
    near = wrong.known.covariance[20, 21] / wrong.known.covariance[20, 20]
    assert near == pytest.approx(1.0, abs=0.05)
    np.testing.assert_array_equal(wrong.known.of_another_measurement, wrong.known.covariance)


def test_effects_are_told_with_errors_unless_they_end_at_a_limit():
    gain_error, tether = GainErrorEffect(), TetherEffect()
    plate = SimpleNamespace(length_m=0.3, width_m=0.2)
    size = len(gain_error.parameters)
    u = np.array([*[q.typical for q in gain_error.parameters], 60.0, 2.0, 0.2, 0.2])
    errors = np.array([0.01] * size + [5.0, 0.1, 0.01, 0.02])
    fitted = FittedByHand(
        law=SimpleNamespace(names=["g_pa"]),
        covariance=np.diag(np.append(1.0, errors**2)),
        u=u,
        free=np.ones(len(u), bool),
        stated=0,
        effects=(gain_error, tether),
    )
    first, second = found_effects(fitted, plate, temper=4.0)
    # An error wider than where it may be at all says nothing either.
    wide = FittedByHand(**{**vars(fitted), "covariance": np.diag(np.append(1.0, (1e4 * errors) ** 2))})
    assert np.isnan(found_effects(wide, plate)[1].parameters["x"].standard_error)
    assert (first.name, second.name) == (gain_error.name, "tether")
    assert second.parameters["k"].standard_error == pytest.approx(10.0)
    assert second.parameters["k"].unit == "N/m"
    # The loss factor and y stand at their limits: a first-order error would say nothing.
    assert np.isnan(second.parameters["loss_factor"].standard_error)
    assert np.isnan(second.parameters["y"].standard_error)
    assert second.parameters["x"].standard_error == pytest.approx(0.02)


def test_what_is_done_of_both_only_grows():
    heard = []
    assert resampled_of(again(10), 5.0, 4, ALONE, heard.append).nested_rms_percent is not None
    assert heard == sorted(heard)
    assert heard[-1] == 1.0
    assert max(x for x in heard if x <= 0.5) == 0.5
