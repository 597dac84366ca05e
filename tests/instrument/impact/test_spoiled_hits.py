"""What spoils a hit without showing at first sight: a channel cut before its noise, a faint second blow."""

import numpy as np
import pytest
from impact_cases import BARE_HZ, TABLE_3, clean_hit, hit_of, noisy_hits

from instrument.impact.damping import damping_of_hits
from instrument.impact.judge import judge
from instrument.impact.spectra import force_window

LOW = clean_hit(BARE_HZ[:3], TABLE_3[:3], np.array([1.0, -0.9, 0.8]))


def cut(share, noise, seed=0):
    force, response = LOW
    rng, top = np.random.default_rng(seed), share * np.abs(response).max()
    response = np.clip(response, -top, top) + noise * top * rng.normal(size=len(response))
    return hit_of(force + 0.02 * rng.normal(size=len(force)), response)


@pytest.mark.parametrize("noise", [1e-4, 5e-4, 2e-3])
@pytest.mark.parametrize("share", [0.35, 0.5])
def test_a_response_cut_before_its_noise_came_is_overloaded(share, noise):
    assert "pile up at its extremes" in judge(cut(share, noise)).why


@pytest.mark.parametrize("seed", range(8))
def test_a_response_that_is_not_cut_is_not(seed):
    rng = np.random.default_rng(seed)
    f, zeta = np.sort(rng.uniform(15, 400, 5)), rng.uniform(3e-4, 2e-2, 5)
    whole = clean_hit(f, zeta, rng.uniform(0.5, 1.5, 5), motion=["displacement", "velocity"][seed % 2])
    (hit,) = noisy_hits(whole, rng, 1)
    assert judge(hit).accepted


def test_a_plate_that_moves_off_as_a_whole_is_not_overloaded():
    """A free plate's velocity stays where the blow has put it."""
    force, response = clean_hit(BARE_HZ[:2], TABLE_3[:2], np.array([1.0, -0.9]), motion="velocity")
    step = np.cumsum(force) / np.sum(force) * 20 * np.abs(response).max()
    assert judge(hit_of(force, response + step, motion="velocity")).accepted


def twice(share, after_s=0.08):
    """The blow, and a share of it again."""
    force, response = LOW
    shift = round(after_s * 2048)
    return tuple(x + share * np.concatenate([np.zeros(shift), x[:-shift]]) for x in (force, response))


@pytest.mark.parametrize("share", [0.02, 0.045])
def test_a_faint_second_blow_is_part_of_the_force(share):
    off = []
    for seed in range(3):
        hits = noisy_hits(twice(share), np.random.default_rng(seed))
        found = damping_of_hits([judge(hit) for hit in hits], at_hz=tuple(BARE_HZ[:3]))
        off += [
            (m.damping_ratio - z) / m.rational_fit.standard_error
            for m, z in zip(found.modes, TABLE_3[:3], strict=True)
        ]
    assert np.sqrt(np.mean(np.square(off))) < 3


def test_of_a_single_blow_the_rest_of_the_force_is_noise():
    (hit,) = noisy_hits(LOW, np.random.default_rng(1), 1)
    assert np.count_nonzero(force_window(judge(hit))) < 0.03 * len(hit.force_n)
