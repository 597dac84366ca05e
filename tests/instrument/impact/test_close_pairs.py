"""Two modes under one peak are two; what only looks like a pair is none, and is known so much worse."""

import numpy as np
import pytest
from impact_cases import clean_hit, noisy_hits

from instrument.impact.close_pairs import pairs_among
from instrument.impact.damping import damping_of_hits
from instrument.impact.judge import judge
from instrument.impact.spectra import spectra

OTHERS = (30.0, 200.0)
CENTRE, RATIO = 90.0, 0.004


def pair(bandwidths, sign, ratios=(RATIO, RATIO)):
    """Frequencies, ratios, amplitudes: two so many bandwidths apart, beside two that are far."""
    f = np.array([OTHERS[0], CENTRE, CENTRE * (1 + bandwidths * 2 * RATIO), OTHERS[1]])
    return f, np.array([0.006, *ratios, 0.003]), np.array([1.0, 1.0, sign, -0.8])


def found_in(f, ratio, amplitude, seed, noise=0.002):
    hits = noisy_hits(clean_hit(f, ratio, amplitude), np.random.default_rng(seed), noise=noise)
    return damping_of_hits([judge(hit) for hit in hits])


def about(found):
    return [m for m in found.modes if abs(m.frequency_hz - CENTRE) < 5]


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("bandwidths", [0.7, 1.0])
def test_a_pair_less_than_a_bandwidth_apart_is_two_modes(bandwidths, sign):
    off = []
    for seed in range(3):
        f, ratio, amplitude = pair(bandwidths, sign)
        two = about(found_in(f, ratio, amplitude, seed))
        assert len(two) == 2
        for mode, true_hz, true in zip(two, f[1:3], ratio[1:3], strict=True):
            off += [
                (mode.damping_ratio - true) / mode.rational_fit.standard_error,
                (mode.frequency_hz - true_hz) / mode.rational_fit.frequency_error_hz,
            ]
    assert np.sqrt(np.mean(np.square(off))) < 2.5


@pytest.mark.parametrize(("bandwidths", "sign"), [(1.9, -1.0), (1.9, -0.5), (3.5, -0.25)])
def test_a_pair_of_opposite_sign_that_has_one_peak_is_two_modes(bandwidths, sign):
    f, ratio, amplitude = pair(bandwidths, sign, (RATIO, 1.3 * RATIO))
    two = about(found_in(f, ratio, amplitude, 0))
    assert len(two) == 2
    for mode, true_hz, true in zip(two, f[1:3], ratio[1:3], strict=True):
        assert abs(mode.damping_ratio - true) < 3 * mode.rational_fit.standard_error
        assert abs(mode.frequency_hz - true_hz) < 3 * mode.rational_fit.frequency_error_hz


@pytest.mark.parametrize("seed", range(6))
def test_a_single_mode_is_one(seed):
    f, ratio, amplitude = pair(1.0, 0.0)
    (one,) = about(found_in(f, ratio, amplitude, seed))
    assert abs(one.damping_ratio - RATIO) < 4 * one.rational_fit.standard_error
    assert "one pole" not in one.why


def test_hits_of_plates_with_other_frequencies_are_no_pair():
    f, ratio, amplitude = pair(1.0, 0.0)
    rng = np.random.default_rng(4)
    alike = [noisy_hits(clean_hit(f * by, ratio, amplitude), rng, 1)[0] for by in (1.0, 1.0, 1 + 2 * RATIO)]
    assert len(about(damping_of_hits([judge(hit) for hit in alike]))) == 1


def test_what_one_pole_does_not_follow_is_known_so_much_worse():
    """Half a bandwidth apart, nearly opposite, in noise of 3 %: two modes, or one whose ratio is nobody's."""
    f, ratio, amplitude = pair(0.5, -0.97)
    hits = [judge(h) for h in noisy_hits(clean_hit(f, ratio, amplitude), np.random.default_rng(3), 3, 0.03)]
    frfs = spectra(hits).frfs
    found = pairs_among([*OTHERS, CENTRE], frfs, [spectra([h]).frfs for h in hits], 2e-3)
    assert len(found.centres) == 4 or CENTRE in found.doubts


@pytest.mark.parametrize("noise", [1e-4, 2e-3])
def test_heavily_damped_modes_are_within_their_errors(noise):
    f, ratio = np.array([30.0, 80.0, 160.0, 300.0]), np.array([0.05, 0.06, 0.05, 0.04])
    off = []
    for seed in range(3):
        found = found_in(f, ratio, np.array([1.0, -1.0, 0.8, 1.0]), seed, noise)
        assert len(found.modes) == 4
        off += [
            (m.damping_ratio - z) / max(m.rational_fit.standard_error, 2e-3 * z)
            for m, z in zip(found.modes, ratio, strict=True)
        ]
    assert np.sqrt(np.mean(np.square(off))) < 2.0
