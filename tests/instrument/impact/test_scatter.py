import numpy as np
import pytest
from impact_cases import clean_hit, noisy_hits

from instrument.impact.curves import fit_curve, half_power_at
from instrument.impact.damping import damping_of_hits
from instrument.impact.judge import judge
from instrument.impact.scatter import scatter_over_hits

BAND_HZ = (10.0, 150.0)


def found_in(hits):
    return damping_of_hits([judge(hit) for hit in hits], band_hz=BAND_HZ)


@pytest.fixture(scope="module")
def found():
    return found_in(noisy_hits(clean_hit(), np.random.default_rng(1), count=6, noise=0.01))


def test_single_hits_scatter_more_than_their_average_errs(found):
    assert found.modes
    for mode, scatter in zip(found.modes, scatter_over_hits(found), strict=True):
        assert scatter.hits == 6
        # The average of six has about 1/sqrt(6) of a single hit's error.
        assert 0.8 < scatter.ratio / mode.rational_fit.standard_error < 8


def test_scatter_grows_with_the_noise(found):
    rng = np.random.default_rng(1)
    quiet = found_in(noisy_hits(clean_hit(), rng, count=6, noise=0.001))
    assert quiet.modes
    for less, more in zip(scatter_over_hits(quiet), scatter_over_hits(found), strict=True):
        assert less.ratio < 0.4 * more.ratio
        assert less.frequency_hz < 0.4 * more.frequency_hz


def test_one_hit_has_no_scatter():
    one = found_in(noisy_hits(clean_hit(), np.random.default_rng(1), count=1))
    assert scatter_over_hits(one) == (None,) * len(one.modes)


def test_the_fit_is_drawn_through_its_own_lines(found):
    fit = found.modes[0].fit
    assert fit_curve(fit, fit.frequency_hz) == pytest.approx(fit.H, rel=1e-9)


def test_half_power_is_marked_where_the_response_is_down_by_3_db(found):
    mode = found.modes[1]
    fine = found.fine[mode.channel]
    marks = half_power_at(fine, mode)
    assert marks.low_hz < mode.frequency_hz < marks.high_hz
    peak = np.abs(fine.between(marks.low_hz, marks.high_hz).H).max()
    assert marks.level == pytest.approx(peak / np.sqrt(2), rel=0.02)
