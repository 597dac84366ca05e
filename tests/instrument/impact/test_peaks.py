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


def softly(clean, blow_s=3e-3):
    """The same struck with a softer tip: both channels by a blow so much longer."""
    blow = np.sin(np.pi * np.arange(0, blow_s, 1 / RATE) * 1 / blow_s)
    return tuple(np.convolve(x, blow)[: len(x)] for x in clean)


def test_a_mode_beyond_the_blows_band_is_named():
    f, zeta = np.array([*BARE_HZ[:3], 560.0]), np.array([*TABLE_3[:3], 0.002])
    soft = softly(clean_hit(f, zeta, np.array([1.0, -0.9, 0.8, 4.0])))
    hits = [judge(hit) for hit in noisy_hits(soft, np.random.default_rng(2), noise=2e-4)]
    found = damping_of_hits(hits)
    low, high = found.band_hz
    assert high < 560
    assert damping_from(found).band_hz == (low, high)
    assert len(found.modes) == 3
    (said,) = (w for w in found.warnings if "not looked at" in w)
    assert "peak at 560 Hz" in said
    asked = damping_of_hits(hits, band_hz=(low, float(said.split(":")[-1])))
    assert abs(asked.modes[-1].frequency_hz - 560) < 0.1
    assert not any("not looked at" in w for w in asked.warnings)


def test_a_mode_says_how_well_its_frequency_is_known_and_how_coherent_it_is():
    for mode, true in zip(damping_from(found_in()).modes, BARE_HZ, strict=False):
        assert 0 < mode.frequency_standard_error_hz < 1e-3 * true
        assert abs(mode.frequency_hz - true) < max(6 * mode.frequency_standard_error_hz, 1e-5 * true)
        assert 0.9 < mode.coherence <= 1


def test_channels_see_one_peak_a_little_apart():
    assert merged([(100.0, 8.0), (100.1, 20.0), (130.0, 7.0)], 0.5) == [100.1, 130.0]
