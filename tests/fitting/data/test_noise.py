from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA

from fitting.data.noise import around, noise_of, noises_of, scatter_of_left
from fitting.sweep import Sweep, resonance_points, segments_by_gap
from instrument.files.sweep_file import read_sweep


def peak(f, resonance=19.0, loss=0.1):
    return 0.1 / ((1 - (f / resonance) ** 2) + 1j * loss)


def sweep_of(f, v, **more):
    n = len(f)
    ones = np.ones(n, dtype=int)
    return Sweep(f, v, np.full(n, 9.81), segment=ones, sweep=ones, **more)


def test_scatter_recovers_a_floor_and_a_share():
    rng = np.random.default_rng(0)
    f = np.linspace(14, 26, 121)
    v = peak(f)
    true = np.hypot(0.002, 0.004 * np.abs(v))
    ratios = []
    for _ in range(40):
        noisy = v + true * (rng.normal(size=121) + 1j * rng.normal(size=121))
        ratios.append(noise_of(sweep_of(f, noisy)).std_m_s / true)
    assert np.median(ratios) == pytest.approx(1, abs=0.05)
    assert np.all(np.abs(np.mean(ratios, axis=0) - 1) < 0.15)


@pytest.mark.parametrize("power", [-1, 0, 1])
def test_over_a_wide_band_a_floor_may_be_flat_in_acceleration_velocity_or_displacement(power):
    rng = np.random.default_rng(1)
    f = np.geomspace(20, 800, 441)
    v = sum(peak(f, resonance, 0.2) for resonance in (40.0, 150.0, 500.0))
    true = np.hypot(0.004 * (f / 120) ** power, 0.003 * np.abs(v))
    ratios = []
    for _ in range(20):
        noisy = v + true * (rng.normal(size=len(f)) + 1j * rng.normal(size=len(f)))
        ratios.append(noise_of(sweep_of(f, noisy)).std_m_s / true)
    # By a floor that is flat in velocity alone a third to three times the truth at the ends.
    assert np.all(np.abs(np.mean(ratios, axis=0) - 1) < 0.2)


def test_twenty_points_do_not_make_readings_far_from_the_peak_sure():
    rng = np.random.default_rng(4)
    f = np.linspace(14, 26, 20)
    v = peak(f)
    true = np.hypot(0.004 * np.abs(v).max(), 0.002 * np.abs(v))
    weakest = np.argsort(np.abs(v))[:5]
    ratios, square = [], []
    for _ in range(150):
        noise = true * (rng.normal(size=20) + 1j * rng.normal(size=20))
        seen = noise_of(sweep_of(f, v + noise)).std_m_s
        ratios.append(seen[weakest[0]] / true[weakest[0]])
        square.append(np.abs(noise / seen) ** 2 / 2)
    # Of the likeliest split of each sweep they are 0.26, 1.6 and 1.15.
    assert np.quantile(ratios, 0.02) > 0.5
    assert np.mean(np.array(square)[:, weakest]) < 1.3
    assert np.mean(square) == pytest.approx(1, abs=0.1)


@pytest.mark.parametrize("points", [121, 61, 31])
def test_a_noiseless_peak_is_not_taken_for_noise(points):
    f = np.linspace(14, 26, points)
    v = peak(f) + 0.03 * f
    assert noise_of(sweep_of(f, v)).std_m_s.max() < 1e-5 * np.abs(v).max()


def test_a_noiseless_peak_of_amplitudes_is_hardly_taken_for_noise():
    f = np.linspace(14, 26, 121)
    v = np.abs(peak(f))
    assert noise_of(sweep_of(f, v)).std_m_s.max() < 1e-4 * v.max()


def test_stated_noise_is_taken_and_carried_to_the_response():
    f = np.array([10.0, 20.0])
    stated = sweep_of(f, np.array([1.0, 2.0]), std_m_s=np.array([0.1, 0.2]))
    assert noise_of(stated).source == "stated"
    halved = replace(stated, base_m_s2=np.array([2 * 9.81, 2 * 9.81], dtype=complex))
    np.testing.assert_allclose(halved.response_m_s, [0.5, 1.0])
    np.testing.assert_allclose(noise_of(halved).std_m_s, [0.05, 0.1])


def test_few_points_leave_the_noise_unknown(table5):
    noise = noise_of(table5)
    assert noise.source == "unknown"
    assert not noise.is_known


@pytest.mark.parametrize(("each", "source"), [(12, "local scatter"), (8, "local scatter"), (7, "unknown")])
def test_short_segments_share_one_floor_and_one_share(each, source):
    rng = np.random.default_rng(2)
    f = np.concatenate([np.linspace(r * 0.85, r * 1.15, each) for r in (19.0, 60.0, 101.0, 180.0, 280.0)])
    # A sharper one leaves more in its windows than noise.
    v = peak(f, np.repeat((19.0, 60.0, 101.0, 180.0, 280.0), each), loss=0.4)
    true, number, ratios = 0.006 * np.abs(v), np.repeat(np.arange(5), each), []
    for _ in range(40):
        noisy = v + true * (rng.normal(size=len(f)) + 1j * rng.normal(size=len(f)))
        found = noise_of(replace(sweep_of(f, noisy), segment=number))
        assert found.source == source
        ratios.append(found.std_m_s / true)
    if source != "unknown":
        assert np.median(ratios) == pytest.approx(1, abs=0.1)
        assert np.all(np.abs(np.mean(ratios, axis=0) - 1) < 0.45)


@pytest.mark.parametrize(("segments", "source"), [(3, "local scatter"), (2, "unknown")])
def test_twelve_numbers_left_tell_it_and_eight_do_not(segments, source):
    f = np.concatenate([np.linspace(r * 0.85, r * 1.15, 8) for r in (19.0, 60.0, 101.0)[:segments]])
    short = replace(sweep_of(f, peak(f, 60.0)), segment=np.repeat(np.arange(segments), 8))
    assert noise_of(short).source == source
    # Amplitudes are half as many.
    assert noise_of(replace(short, velocity_m_s=np.abs(short.velocity_m_s))).source == "unknown"


def test_levels_and_passes_are_judged_apart():
    rng = np.random.default_rng(1)
    f = np.tile(np.linspace(14, 26, 61), 2)
    level = np.repeat([9.81, 98.1], 61)
    v = peak(f) * level + 0.01 * (rng.normal(size=122) + 1j * rng.normal(size=122))
    ones = np.ones(122, dtype=int)
    noise = noise_of(Sweep(f, v, level, segment=ones, sweep=ones))
    assert np.median(noise.std_m_s) == pytest.approx(0.01, rel=0.2)


def test_reference_channel_removes_the_scatter_of_the_drive():
    sweep = read_sweep(DATA / "practice-002.csv").sweep(9.81)
    without = replace(sweep, base_m_s2=None)
    assert np.median(noise_of(without).std_m_s / noise_of(sweep).std_m_s) > 1.02


def test_segments_are_told_apart_by_their_gaps(table5):
    order = np.array([4, 0, 8, 1, 5, 2, 6, 3, 7])
    np.testing.assert_array_equal(segments_by_gap(table5.frequency_hz), table5.segment)
    np.testing.assert_array_equal(segments_by_gap(table5.frequency_hz[order]), table5.segment[order])


def test_resonance_points_are_the_papers(table5):
    assert list(table5.frequency_hz[resonance_points(table5)]) == [19.3, 100.5, 281.1]


def test_noise_in_proportion_is_seen_as_such_over_many_resonances_in_one_segment():
    f = np.geomspace(20.0, 2000.0, 300)
    v = sum(1 / (p**2 * (1 + 0.1j) - f**2) for p in (45.0, 280.0, 780.0)) * f
    assert np.ptp(np.log10(np.abs(v))) > 2
    rng, at_peak, at_least = np.random.default_rng(7), [], []
    for _ in range(8):
        noise = 3e-3 * (rng.normal(size=300) + 1j * rng.normal(size=300))
        share = noise_of(sweep_of(f, v * (1 + noise))).std_m_s / np.abs(v) / 3e-3
        at_peak.append(share[np.argmax(np.abs(v))])
        at_least.append(share[np.argmin(np.abs(v))])
    # A floor a fiftieth of the peak's, the least that was tried, made them 0.45 and 14.
    assert np.median(at_peak) == pytest.approx(1.0, abs=0.06)
    assert np.median(at_least) == pytest.approx(1.0, abs=0.25)


def test_what_is_left_around_follows_where_it_grows_and_not_what_is_off():
    grows = np.linspace(1.0, 3.0, 201)
    left = grows * np.abs(np.random.default_rng(0).normal(size=201)) / 0.6745
    left[100:108] = 1e3
    found = around(left, 207)
    assert found.shape == (207,)
    assert found[[40, 104, 166]] == pytest.approx([1.4, 2.0, 2.6], rel=0.45)
    assert found[0] == found[3]
    assert not around(left[:50], 56).any()


def test_of_a_resonance_with_a_few_points_what_a_fit_leaves_says_what_readings_do_not():
    rng = np.random.default_rng(6)
    f = np.geomspace(25, 1200, 40)
    v = sum(peak(f, resonance, 0.06) for resonance in (40.0, 150.0, 500.0))
    true = 0.004 * np.abs(v)
    ratios, local = [], []
    for _ in range(20):
        noise = true * (rng.normal(size=40) + 1j * rng.normal(size=40))
        read = sweep_of(f, v + noise)
        # The fit is off by as much as the noise is, smoothly.
        left = noise + 0.004 * np.median(np.abs(v)) * np.sin(np.log(f))
        ratios.append(np.median(scatter_of_left(read, left) / true))
        local.append(np.median(noise_of(read).std_m_s / true))
    # A peak's readings, noisier than its neighbours', are in their jumps too.
    assert 0.9 < np.mean(ratios) < 1.5
    assert np.mean(local) > 1.4 * np.mean(ratios)


def test_a_frequency_read_again_scatters_as_the_sweep_does():
    """A sentinel is a pass of one frequency: it leaves the noise of all others as it is."""
    rng = np.random.default_rng(4)
    f = np.linspace(14, 26, 61)
    v = peak(f, loss=0.3)
    noisy = v + 0.004 * np.abs(v) * (rng.normal(size=61) + 1j * rng.normal(size=61))
    plain = sweep_of(f, noisy)
    again = np.repeat(19.0, 5)
    more = sweep_of(np.append(f, again), np.append(noisy, peak(again, loss=0.3)))
    more = replace(more, sweep=np.repeat([1, 2], [61, 5]))
    found = noise_of(more)
    assert found.source == "local scatter"
    assert np.array_equal(found.std_m_s[:61], noise_of(plain).std_m_s)
    assert found.std_m_s[61:] / np.abs(peak(19.0, loss=0.3)) == pytest.approx(0.004, rel=0.25)


def test_a_sweep_of_few_points_scatters_as_the_others_of_its_laboratory_do(table5):
    rng = np.random.default_rng(6)
    f = np.linspace(14, 26, 61)
    v = peak(f, loss=0.3)
    long = sweep_of(f, v + 0.004 * np.abs(v) * (rng.normal(size=61) + 1j * rng.normal(size=61)))
    few = long.take(np.arange(0, 61, 12))
    assert not any(n.is_known for n in noises_of([few, table5]))
    known, lent = noises_of([long, few])
    assert np.array_equal(known.std_m_s, noise_of(long).std_m_s)
    assert (known.source, lent.source) == ("local scatter", "local scatter")
    assert lent.std_m_s / np.abs(few.response_m_s) == pytest.approx(0.004, rel=0.25)
