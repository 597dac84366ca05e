"""No mode is lost without a word: peaks that no pole explains, those beyond where modes are looked for."""

import numpy as np
from impact_cases import BARE_HZ, RATE, TABLE_3, clean_hit, hit_of, noisy_hits

from instrument.impact.damping import damping_of_hits
from instrument.impact.judge import judge
from instrument.impact.peaks import merged
from instrument.impact.result import damping_from


def found_in(response=None, **how):
    rng = np.random.default_rng(2)
    hits = noisy_hits(clean_hit(**how), rng)
    if response is not None:
        hits = [hit_of(h.force_n, h.responses[0].samples + response(h, rng), h.source) for h in hits]
    return damping_of_hits([judge(hit) for hit in hits])


def mains(hit, rng):
    samples = hit.responses[0].samples
    t = np.arange(len(samples)) / RATE
    return 0.1 * np.abs(samples).max() * np.sin(2 * np.pi * 50.0 * t + rng.uniform(0, 6))


def test_mains_is_said_to_be_no_mode():
    found = found_in(mains)
    (said,) = (w for w in found.warnings if "no pole explains" in w)
    assert "at 50 Hz" in said
    assert not any(abs(m.frequency_hz - 50) < 1 for m in found.modes)


def test_where_every_peak_has_its_mode_nothing_is_said():
    assert not any("no pole" in w or "not looked at" in w for w in found_in().warnings)


def test_a_mode_beyond_the_blows_band_is_named():
    f = np.array([*BARE_HZ[:3], 905.0])
    found = found_in(f=f, zeta=np.array([*TABLE_3[:3], 0.002]), amplitudes=np.array([1.0, -0.9, 0.8, 4.0]))
    low, high = found.band_hz
    inside = any(abs(m.frequency_hz - 905) < 2 for m in found.modes)
    assert inside == (high > 905)
    said = damping_from(found)
    assert said.band_hz == (low, high)
    if not inside:
        assert any("not looked at: peak at 905" in w for w in found.warnings)


def test_a_mode_says_how_well_its_frequency_is_known_and_how_coherent_it_is():
    for mode, true in zip(damping_from(found_in()).modes, BARE_HZ, strict=False):
        assert 0 < mode.frequency_standard_error_hz < 1e-3 * true
        assert abs(mode.frequency_hz - true) < max(6 * mode.frequency_standard_error_hz, 1e-5 * true)
        assert 0.9 < mode.coherence <= 1


def test_channels_see_one_peak_a_little_apart():
    assert merged([(100.0, 8.0), (100.1, 20.0), (130.0, 7.0)], 0.5) == [100.1, 130.0]
