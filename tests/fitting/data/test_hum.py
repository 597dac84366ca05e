from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA

from fitting.data.hum import mains_hum
from fitting.data.noise import Noise, noise_of
from fitting.sweep import Sweep
from instrument.files.sweep_file import read_sweep

REGIONS_HZ = ((14, 26), (90, 112), (258, 300))
NOISE = 0.005
"""White on the velocity, of the largest response of a region."""


def response(f):
    modes = ((19.0, 0.25, 0.012), (101.0, 0.45, 0.005), (281.0, 0.6, 0.003))
    return sum(size / (1 - (f / at) ** 2 + 1j * loss) for at, loss, size in modes)


def measured(rng, *, points=60, levels=(1.0,), regions=REGIONS_HZ, base=True):
    """Phasors with noise as a rig has it: a share of the peak, a scatter of repeats, and of the drive."""
    grids = [np.linspace(*region, points) for _ in levels for region in regions]
    f = np.concatenate(grids)
    segment = np.tile(np.repeat(np.arange(len(regions)) + 1, points), len(levels))
    level = np.repeat(levels, points * len(regions))
    v = response(f) * level
    peak = np.repeat([np.abs(part).max() for part in np.split(v, len(grids))], points)
    count = len(f)

    def scatter():
        return rng.normal(size=count) + 1j * rng.normal(size=count)

    drive = (1 + 0.003 * rng.normal(size=count)) * np.exp(0.005j * rng.normal(size=count))
    noise = np.hypot(NOISE / np.sqrt(2) * peak, 0.002 * np.abs(v)) * scatter()
    return Sweep(
        frequency_hz=f,
        velocity_m_s=v * (drive if base else 1) + noise,
        commanded_m_s2=9.81 * level,
        segment=segment,
        sweep=np.ones(count, dtype=int),
        base_m_s2=9.81 * level * drive if base else None,
    )


def hum(rng, f, size, mains_hz=50.0, dwell_s=1.0, multiples=None):
    """What a sine fit of `dwell_s` takes in, its phase another at every point."""
    k = np.maximum(np.round(f / mains_hz), 1)
    there = np.isin(k, multiples) if multiples else np.ones(len(f), dtype=bool)
    phase = np.exp(2j * np.pi * rng.uniform(size=len(f)))
    return there * size * np.sinc((f - k * mains_hz) * dwell_s) * phase


def found(sweep):
    return mains_hum(sweep, noise_of(sweep))


def test_300_clean_sweeps_raise_no_alarm():
    # Longer runs, 1500 sweeps or more of each of twelve kinds (levels, densities, amplitudes, peaks a few
    # points wide): 1 alarm in 19400, at a peak of 1 % loss one hertz from 300 Hz.
    alarms = [found(measured(np.random.default_rng(seed))) for seed in range(300)]
    assert not any(alarms)


@pytest.mark.parametrize("base", [True, False])
@pytest.mark.parametrize("dwell_s", [0.7, 1.0, 2.5])
def test_hum_of_ten_noises_is_found_and_named(dwell_s, base):
    for seed in range(5):
        rng = np.random.default_rng(seed)
        sweep = measured(rng, base=base)
        size = 10 * NOISE * 0.02
        sweep = replace(
            sweep, velocity_m_s=sweep.velocity_m_s + hum(rng, sweep.frequency_hz, size, 50.0, dwell_s)
        )
        seen = found(sweep)
        assert seen is not None
        assert (seen.mains_hz, seen.channel) == (50.0, "velocity")
        assert set(seen.multiples) <= {2, 6}
        assert 0.4 * size < seen.size_m_s < 2 * size


def test_all_points_at_a_multiple_are_set_aside_at_every_level_and_few_others():
    rng = np.random.default_rng(0)
    sweep = measured(rng, levels=(0.25, 0.5, 1.0))
    f = sweep.frequency_hz
    sweep = replace(sweep, velocity_m_s=sweep.velocity_m_s + hum(rng, f, 1e-3, dwell_s=2.0))
    seen = found(sweep)
    assert seen.multiples == (2, 6)
    near = np.minimum(np.abs(f - 100), np.abs(f - 300))
    assert np.all(seen.points[near <= 0.3])
    assert not np.any(seen.points[near > 10])
    assert seen.points.mean() < 0.12


def test_noise_without_these_points_is_nearly_that_of_the_clean_sweep():
    # Measured over six seeds: 2.5 to 3.4 times the clean noise with them, 1.17 to 1.31 without; what is left
    # is hum below the noise of single points.
    rng = np.random.default_rng(1)
    clean = measured(rng)
    hums = hum(rng, clean.frequency_hz, 2e-3, dwell_s=2.5)
    spoilt = replace(clean, velocity_m_s=clean.velocity_m_s + hums)
    kept = spoilt.take(~found(spoilt).points)

    def typical(sweep):
        return np.median(noise_of(sweep).std_m_s[sweep.segment == 2])

    assert np.sum(kept.segment == 2) > 50
    assert typical(spoilt) > 2 * typical(clean)
    assert typical(kept) < 1.4 * typical(clean)


def test_sixty_hertz_is_told_from_fifty():
    for seed in range(5):
        rng = np.random.default_rng(seed)
        sweep = measured(rng, regions=((40, 65), (105, 130), (285, 310)))
        sweep = replace(sweep, velocity_m_s=sweep.velocity_m_s + hum(rng, sweep.frequency_hz, 2e-3, 60.0))
        seen = found(sweep)
        assert seen.mains_hz == 60.0
        assert 5 in seen.multiples
        assert set(seen.multiples) <= {1, 2, 5}


def test_hum_in_the_reference_channel_is_found_and_named():
    for seed in range(5):
        rng = np.random.default_rng(seed)
        sweep = measured(rng)
        added = hum(rng, sweep.frequency_hz, 0.06 * 9.81, dwell_s=1.5)
        seen = found(replace(sweep, base_m_s2=sweep.base_m_s2 + added))
        assert seen is not None
        assert seen.channel == "base"


def test_a_base_that_truly_moves_more_at_a_multiple_is_no_hum():
    for seed in range(20):
        sweep = measured(np.random.default_rng(seed))
        more = 1 + 0.05 * (np.abs(sweep.frequency_hz - 100) < 0.4)
        moved = replace(sweep, velocity_m_s=sweep.velocity_m_s * more, base_m_s2=sweep.base_m_s2 * more)
        assert found(moved) is None


def test_amplitudes_show_hum_too():
    rng = np.random.default_rng(0)
    sweep = measured(rng)
    velocity = sweep.velocity_m_s + hum(rng, sweep.frequency_hz, 3e-3, dwell_s=2.0)
    assert found(replace(sweep, velocity_m_s=np.abs(velocity))).mains_hz == 50.0
    assert found(replace(sweep, velocity_m_s=np.abs(sweep.velocity_m_s))) is None


def test_outliers_elsewhere_are_not_hum():
    sweep = measured(np.random.default_rng(0))
    off = np.abs(sweep.frequency_hz - 104) < 0.3
    assert off.any()
    assert found(replace(sweep, velocity_m_s=sweep.velocity_m_s + 5e-3 * off)) is None


@pytest.mark.parametrize("loss", [0.02, 0.05, 0.2])
def test_a_resonance_at_a_multiple_is_not_hum(loss):
    for seed in range(10):
        sweep = measured(np.random.default_rng(seed))
        resonance = 1 + 0.03 / (1 - (sweep.frequency_hz / 100.1) ** 2 + 1j * loss)
        assert found(replace(sweep, velocity_m_s=sweep.velocity_m_s * resonance)) is None


def test_the_stated_scale_of_the_noise_does_not_matter():
    sweep = measured(np.random.default_rng(0))
    assert mains_hum(sweep, Noise(1e-3 * noise_of(sweep).std_m_s, "stated")) is None


def test_few_points_and_noiseless_ones_say_nothing(table5):
    assert found(table5) is None
    f = np.linspace(90, 112, 60)
    ones = np.ones(60, dtype=int)
    assert found(Sweep(f, response(f), 9.81 * ones, segment=ones, sweep=ones)) is None


def test_a_clean_practice_sweep_has_none():
    assert found(read_sweep(DATA / "practice-002.csv").sweep(9.81)) is None


def test_a_resonance_just_beyond_a_coarse_sweep_is_no_hum():
    # The last point lies at a multiple, 56 Hz from its neighbour, below a peak of 12 % loss at 1563 Hz.
    f = np.geomspace(15, 1500, 120)
    v = sum(1 / (1 - (f / at) ** 2 + 1j * loss) for at, loss in ((330.0, 0.2), (840.0, 0.17), (1563.0, 0.12)))
    ones = np.ones(len(f), dtype=int)
    for seed in range(10):
        rng = np.random.default_rng(seed)
        noise = 0.002 * np.abs(v) * (rng.normal(size=len(f)) + 1j * rng.normal(size=len(f)))
        sweep = Sweep(f, v + noise, 9.81 * ones, ones, ones, base_m_s2=9.81 * ones + 0j)
        assert found(sweep) is None


@pytest.mark.parametrize("off", [(0,), (-1,), (0, -1)])
def test_the_first_and_last_line_of_a_swept_sine_alone_are_no_hum(off):
    """A swept sine begins and ends with a jump: its lines at 100 and 500 Hz have neighbours on one side."""
    for seed in range(5):
        sweep = measured(np.random.default_rng(seed), points=401, regions=((100, 500),), base=False)
        velocity = sweep.velocity_m_s.copy()
        velocity[list(off)] *= 1.3
        assert found(replace(sweep, velocity_m_s=velocity)) is None


def test_hum_at_a_sweeps_end_is_set_aside_where_it_shows_inside_too():
    rng = np.random.default_rng(0)
    sweep = measured(rng, points=401, regions=((100, 500),), base=False)
    f = sweep.frequency_hz
    seen = found(replace(sweep, velocity_m_s=sweep.velocity_m_s + hum(rng, f, 5e-2, dwell_s=2.0)))
    assert {2, 10} < set(seen.multiples)
    assert seen.points[[0, -1]].all()


def test_noise_of_blows_that_grows_along_the_band_is_no_hum():
    """The force of a blow fades: the upper lines scatter by twelve times as much as the lower ones."""
    f = np.linspace(60.0, 900.0, 700)
    ones = np.ones(len(f), dtype=int)
    grows = np.exp(2.5 * ((f - f[0]) / np.ptp(f)) ** 4)
    damped = ((150.0, 0.08, 0.3), (330.0, 0.05, 0.2), (620.0, 0.05, 0.1))
    v = sum(size / (1 - (f / at) ** 2 + 1j * loss) for at, loss, size in damped)
    for seed in range(60):
        rng = np.random.default_rng(seed)
        noise = 2e-3 * grows * (rng.normal(size=len(f)) + 1j * rng.normal(size=len(f)))
        data = Sweep(f, v + noise, 9.81 * ones, segment=ones, sweep=ones)
        assert found(data) is None
    loud = hum(rng, f, 0.2, multiples=[8, 10])
    assert found(replace(data, velocity_m_s=data.velocity_m_s + loud)).multiples == (8, 10)


def test_one_point_alone_near_a_multiple_is_no_hum_and_two_at_two_multiples_are():
    """A sparse grid with a point of its own at 100 and at 300 Hz."""
    f = np.sort(np.append(np.geomspace(60.5, 580.0, 60), [100.1, 300.2]))
    f = f[
        (np.abs(f - 100.1) < 0.01) | (np.abs(f - 300.2) < 0.01) | (np.abs(f / 50 - np.round(f / 50)) > 0.03)
    ]
    ones, rng = np.ones(len(f), dtype=int), np.random.default_rng(0)
    v = sum(size / (1 - (f / at) ** 2 + 0.3j) for at, size in ((90.0, 0.3), (400.0, 0.2)))
    v = v * (1 + 2e-3 * (rng.normal(size=len(f)) + 1j * rng.normal(size=len(f))))

    def off_at(*lines_hz):
        off = np.any([np.abs(f - line) < 0.5 for line in lines_hz], axis=0)
        return found(Sweep(f, v * (1 + 0.2j * off), 9.81 * ones, ones, ones))

    assert off_at(100) is None
    assert off_at(300) is None
    assert off_at(100, 300).multiples == (2, 6)
