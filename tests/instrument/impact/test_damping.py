from dataclasses import replace

import numpy as np
import pytest
from impact_cases import BARE_HZ, RATE, SECONDS, TABLE_3, clean_hit, hit_of, noisy_hits

from fitting.modal.frf import DampingEstimate, Refusal
from instrument.errors import BadInput
from instrument.impact.damping import damping_of_frfs, damping_of_hits
from instrument.impact.judge import judge
from instrument.impact.spectra import rolloff_hz, spectra


@pytest.fixture(scope="module")
def clean():
    return clean_hit()


def found_in(hits, **more):
    return damping_of_hits([judge(h) for h in hits], **more)


@pytest.mark.long
def test_the_papers_eight_ratios_over_100_seeds(clean):
    rational, half, refused = [], [], set()
    for seed in range(100):
        hits = noisy_hits(clean, np.random.default_rng(seed))
        found = found_in(hits, at_hz=tuple(BARE_HZ))
        assert len(found.modes) == 8
        rational.append([m.rational_fit.ratio for m in found.modes])
        half.append(
            [m.half_power.ratio if isinstance(m.half_power, DampingEstimate) else np.nan for m in found.modes]
        )
        refused |= {k for k, m in enumerate(found.modes) if isinstance(m.half_power, Refusal)}
    error = np.abs(np.array(rational) / TABLE_3 - 1)
    assert np.all(np.percentile(error, 95, axis=0) < 0.01), np.percentile(error, 95, axis=0)
    # refused only under one line in the bandwidth
    lines = 2 * TABLE_3 * BARE_HZ * SECONDS
    assert refused == set(np.flatnonzero(lines < 1)), (refused, lines)
    read = lines >= 1
    error = np.abs(np.array(half)[:, read] / TABLE_3[read] - 1)
    assert np.all(np.percentile(error, 95, axis=0) < 0.03), np.percentile(error, 95, axis=0)


def test_modes_are_found_without_being_named(clean):
    found = found_in(noisy_hits(clean, np.random.default_rng(1)))
    np.testing.assert_allclose([m.frequency_hz for m in found.modes], BARE_HZ, rtol=5e-4)
    assert all(m.accepted for m in found.modes)


@pytest.mark.parametrize("end", [0.001, 0.01, 0.05])
def test_exponential_windows_give_the_same_corrected_ratio(clean, end):
    found = found_in([hit_of(*clean)], at_hz=tuple(BARE_HZ[1:]), end_value=end)
    for mode, zeta in zip(found.modes, TABLE_3[1:], strict=True):
        assert mode.rational_fit.ratio == pytest.approx(zeta, rel=1e-2)
        if isinstance(mode.half_power, DampingEstimate):
            assert mode.half_power.ratio == pytest.approx(zeta, rel=1e-2)


@pytest.mark.parametrize("estimator", ["h1", "h2", "hv"])
def test_estimators_agree_on_clean_hits(clean, estimator):
    found = found_in(
        noisy_hits(clean, np.random.default_rng(2), noise=1e-5), at_hz=(110.12,), estimator=estimator
    )
    assert found.modes[0].damping_ratio == pytest.approx(TABLE_3[2], rel=5e-3)


@pytest.mark.parametrize("motion", ["displacement", "velocity", "acceleration"])
def test_every_kind_of_response(motion):
    force, response = clean_hit(motion=motion)
    found = found_in([hit_of(force, response, motion=motion)], at_hz=(110.12, 201.88))
    np.testing.assert_allclose([m.damping_ratio for m in found.modes], TABLE_3[2:4], rtol=1e-2)
    np.testing.assert_allclose([m.half_power.ratio for m in found.modes], TABLE_3[2:4], rtol=3e-2)


def test_close_modes_are_flagged_where_half_power_is_off():
    zeta = 0.002
    for apart in (2, 3, 5):
        f = np.array([200.0, 200.0 * (1 + 2 * zeta * apart)])
        force, response = clean_hit(f, np.full(2, zeta), np.array([1.0, 0.8]), seconds=16)
        found = found_in([hit_of(force, response)], at_hz=tuple(f))
        assert len(found.modes) == len(f)
        for mode in found.modes:
            assert mode.rational_fit.ratio == pytest.approx(zeta, rel=3e-2)
            half = mode.half_power
            off = isinstance(half, DampingEstimate) and abs(half.ratio / zeta - 1) > 0.1
            assert not off or "half power differs" in mode.why


def test_frf_of_another_instrument_gives_the_same_modes(clean):
    plain = spectra([judge(hit_of(*clean))]).frfs
    found = damping_of_frfs(plain, at_hz=(110.12,))
    assert found.modes[0].damping_ratio == pytest.approx(TABLE_3[2], rel=5e-3)


def test_coherence_is_one_only_where_hits_agree(clean):
    judged = [judge(h) for h in noisy_hits(clean, np.random.default_rng(3))]
    s = spectra(judged)
    (coherence,) = s.coherence.values()
    at_mode = np.argmin(np.abs(s.frequency_hz - BARE_HZ[3]))
    assert coherence[at_mode] > 0.99
    assert coherence.min() < 0.9
    assert np.all(coherence <= 1 + 1e-9)
    assert spectra(judged[:1]).coherence is None


def test_pulse_rolls_off_where_a_half_sine_does(clean):
    # a half sine of 1 ms falls by 20 dB near 1.2 kHz: beyond this record's band
    assert rolloff_hz(spectra([judge(hit_of(*clean))])) > 900


def faulty(clean, fault):
    force, response = (x.copy() for x in clean)
    peak = int(np.argmax(force))
    if fault == "double hit":
        force[peak + 40 : peak + 42] += 0.5 * force[peak]
    elif fault == "force overload":
        force[peak - 2 : peak + 4] = force[peak]
    elif fault == "response overload":
        response = np.clip(response, -0.3 * np.abs(response).max(), 0.3 * np.abs(response).max())
        top = int(np.argmax(response))
        response[top : top + 6] = response[top]
    elif fault == "no pre-trigger":
        force, response = force[peak:].copy(), response[peak:]
        force[:6] = force.max() * np.cos(np.arange(6) * np.pi / 12)  # the second half of a softer blow
    elif fault == "silent response":
        response[:] = 0.0
    elif fault == "silent force":
        force = 1e-3 * np.random.default_rng(0).normal(size=len(force))
    elif fault == "swapped, soon over":
        force, response = response * np.exp(-np.arange(len(response)) / 60.0), force
    elif fault == "swapped":
        force, response = response, force
    return hit_of(force, response)


@pytest.mark.parametrize(
    ("fault", "said"),
    [
        ("double hit", "double hit"),
        ("force overload", "overloaded"),
        ("response overload", "overloaded"),
        ("no pre-trigger", "no pre-trigger"),
        ("silent response", "silent"),
        ("silent force", "silent"),
        ("swapped", "swapped"),
        ("swapped, soon over", "swapped"),
    ],
)
def test_a_spoilt_hit_is_named_and_the_good_ones_are_used(clean, fault, said):
    spoilt = faulty(clean, fault)
    judged = judge(spoilt)
    assert not judged.accepted
    assert said in judged.why
    assert "\n" not in judged.why
    good = noisy_hits(clean, np.random.default_rng(4), count=2)
    found = damping_of_hits([judged, *(judge(h) for h in good)], at_hz=(110.12,))
    assert found.modes[0].damping_ratio == pytest.approx(TABLE_3[2], rel=2e-2)
    assert any("left out" in w and said in w for w in found.warnings)


def test_no_good_hit_is_refused(clean):
    with pytest.raises(BadInput, match="no good hit"):
        damping_of_hits([judge(faulty(clean, "double hit"))])


def test_offset_and_inverted_force_are_set_right_and_noted(clean):
    force, response = clean
    judged = judge(hit_of(-force - 5.0, response + 3.0))
    assert judged.accepted
    assert any("inverted" in n for n in judged.notes)
    assert any("offset" in n for n in judged.notes)
    assert judged.hit.force_n.max() == pytest.approx(force.max(), rel=1e-6)


def test_short_record_is_advised_to_be_longer(clean):
    n = int(2 * RATE)
    found = found_in([hit_of(clean[0][:n], clean[1][:n])], at_hz=(59.84,))
    assert isinstance(found.modes[0].half_power, Refusal)
    assert any("record" in w and "instead of 2 s" in w for w in found.warnings)
    assert any("one hit" in w for w in found.warnings)


def test_truncated_record_is_named_and_still_read(clean):
    n = int(3 * RATE)
    found = found_in([hit_of(clean[0][:n], clean[1][:n])], at_hz=(17.71, 110.12))
    assert any("cut off" in w for w in found.warnings)
    assert found.modes[0].damping_ratio == pytest.approx(TABLE_3[0], rel=2e-2)


def test_an_impulse_may_begin_the_record():
    force = np.zeros(4096)
    force[0] = 1.0
    t = np.arange(4096) / 1024
    response = np.exp(-0.003 * 2 * np.pi * 100 * t) * np.sin(2 * np.pi * 100 * t)
    found = found_in([hit_of(force, response, motion="displacement", rate=1024.0)], at_hz=(100.0,))
    assert found.modes[0].damping_ratio == pytest.approx(0.003, rel=1e-2)


def test_coarse_digits_are_no_overload(clean):
    force, response = clean
    step = np.abs(response).max() / 2000
    assert judge(hit_of(force, np.round(response / step) * step)).accepted
    slow = np.abs(response).max() * 2 * np.sin(2 * np.pi * 2 * np.arange(len(response)) / RATE)
    assert judge(hit_of(force, np.round((response + slow) / step) * step)).accepted


def test_a_named_mode_that_is_not_there_is_refused_not_replaced(clean):
    (mode,) = found_in([hit_of(*clean)], at_hz=(30.0,)).modes
    assert not mode.accepted
    assert np.isnan(mode.damping_ratio)
    assert mode.frequency_hz == 30.0


def test_a_named_mode_beyond_the_data_is_bad_input(clean):
    with pytest.raises(BadInput, match="beyond the data"):
        found_in([hit_of(*clean)], at_hz=(5000.0,))


def test_an_empty_band_says_so(clean):
    found = found_in([hit_of(*clean)], band_hz=(1.0, 3.0))
    assert found.modes == ()
    assert any("no mode found" in w for w in found.warnings)


def test_a_band_without_lines_says_where_they_are(clean):
    with pytest.raises(BadInput, match=rf"lies above half the sampling rate, expected below {RATE / 2:g} Hz"):
        found_in([hit_of(*clean)], band_hz=(RATE, 2 * RATE))
    frfs = found_in([hit_of(*clean)]).plain
    last = next(iter(frfs.values())).frequency_hz[-1]
    with pytest.raises(BadInput, match=rf"holds 0 lines, expected .* more: they go from 0 to {last:g} Hz"):
        damping_of_frfs(frfs, band_hz=(RATE, 2 * RATE))


@pytest.mark.parametrize("motion", ["displacement", "velocity"])
def test_modes_are_found_in_noise_whatever_is_measured(motion):
    clean = clean_hit(BARE_HZ[:6], TABLE_3[:6], np.ones(6), motion=motion)
    hits = [
        replace(h, responses=(replace(h.responses[0], motion=motion),))
        for h in noisy_hits(clean, np.random.default_rng(0))
    ]
    np.testing.assert_allclose([m.frequency_hz for m in found_in(hits).modes], BARE_HZ[:6], rtol=1e-3)


def test_a_strongly_damped_mode_is_found():
    clean = clean_hit(np.array([100.0]), np.array([0.03]), np.ones(1))
    (mode,) = found_in(noisy_hits(clean, np.random.default_rng(0))).modes
    assert mode.damping_ratio == pytest.approx(0.03, rel=1e-2)


@pytest.mark.parametrize("lines", [1.1, 1.5])
def test_half_power_counts_what_the_end_of_a_short_record_does_to_it(lines):
    """Without noise its ratio is off by nothing but that, and the error says so."""
    seconds, f = 4.0, 110.0
    zeta = lines / (2 * f * seconds)
    clean = clean_hit((f,), (zeta,), (1.0,), seconds=seconds)
    (mode,) = damping_of_hits([judge(hit_of(*clean))], at_hz=(f,)).modes
    off = mode.half_power.ratio - zeta
    assert off > 5e-4 * zeta
    assert mode.half_power.standard_error == pytest.approx(off, rel=0.05)
