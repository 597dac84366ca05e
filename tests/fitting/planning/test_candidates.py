"""Where a step may be made."""

import numpy as np

from fitting.planning.candidates import candidate_frequencies, regions

POLES = np.array([20 + 0.6j, 95 + 3j, 102 + 3j, 280 + 10j])


def test_both_ends_of_the_band_are_candidates_and_all_lie_between():
    f = candidate_frequencies(POLES, 15.0, 300.0)
    assert f[0] == 15.0
    assert f[-1] == 300.0
    assert np.all(np.diff(f) > 0)


def test_a_resonance_has_a_candidate_within_a_fraction_of_its_bandwidth():
    f = candidate_frequencies(POLES, 15.0, 300.0)
    for p in POLES:
        near = np.sort(np.abs(f - p.real))
        assert near[0] < 0.25 * p.imag
        assert np.sum(near < p.imag) >= 4


def test_between_resonances_candidates_are_few():
    f = candidate_frequencies(POLES, 15.0, 300.0)
    assert np.sum((f > 30) & (f < 80)) < np.sum((f > 18) & (f < 30)) + np.sum((f > 80) & (f < 120))


def test_a_band_without_resonances_is_covered_all_the_same():
    f = candidate_frequencies(np.empty(0, complex), 100.0, 110.0)
    assert len(f) >= 3
    assert f[0] == 100.0
    assert f[-1] == 110.0


def test_resonances_that_stand_apart_have_regions_and_close_ones_share():
    f = candidate_frequencies(POLES, 15.0, 300.0)
    number = regions(f, POLES)
    assert set(number) == {1, 2, 3}
    assert number[np.argmin(np.abs(f - 95))] == number[np.argmin(np.abs(f - 102))] == 2
    assert np.all(np.diff(number) >= 0)


def test_without_a_resonance_all_is_one_region():
    assert set(regions(np.array([10.0, 20.0]), np.empty(0, complex))) == {1}
