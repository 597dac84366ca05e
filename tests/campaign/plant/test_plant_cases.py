"""Cases as the campaign draws them: noise as stated, effects where they belong, files that commands read."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from campaign.law import TrueLaw
from campaign.noise import DRIVE_PHASE_RAD, NoiseFigures, peaks
from campaign.plant.cases import KINDS, Truth, clean, draw, measured, nominal_specimen
from campaign.plant.channels import TrueChannels
from campaign.plant.materials import deviation, draw_strange_material, nearest_zener
from campaign.plant.response import Steady, steady
from campaign.plant.schedule import draw_schedule
from campaign.plant.severities import OF_THE_CHANNELS_ALONE, PLACES
from campaign.plant.visible import visible_chi2
from campaign.schedule import Schedule
from drivers.simulated.plant.effects import Effects
from fitting.data.noise import noise_of

ZENER = TrueLaw("fractional-zener", (0.27e6, 4.1e6, 1.21e-4, 0.83))
FIGURES = NoiseFigures(0.006, 0.002)


def dense(count: int = 120) -> Schedule:
    f = np.concatenate([np.linspace(14, 25, count), np.linspace(250, 305, count)])
    group = np.repeat([1, 2], count)
    return Schedule(f, group, group, np.ones(2 * count), np.arange(2.0 * count))


@pytest.fixture
def quick_plate(monkeypatch):
    """One resonance in place of the plate: for what does not depend on it."""

    def one_resonance(effects, modulus, frequency_hz, level_m_s2, time_s):
        omega = 2 * np.pi * frequency_hz
        v = 1j * omega / ((2 * np.pi * 19.0) ** 2 * (1 + 0.3j) - omega**2)
        return Steady(v, np.abs(v), modulus(omega))

    monkeypatch.setattr("campaign.plant.cases.steady", one_resonance)


def phasors(case):
    return np.concatenate([case.sweep.velocity_m_s, case.sweep.base_m_s2])


def test_a_seed_is_a_case():
    first, again, other = draw("spot_offset", 7), draw("spot_offset", 7), draw("spot_offset", 8)
    np.testing.assert_array_equal(phasors(first), phasors(again))
    assert first.truth == again.truth
    assert first.truth != other.truth


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_can_be_drawn(kind):
    case = draw(kind, 3)
    names = case.truth.names
    assert len(names) == {"none": 0, "pair": 2}.get(kind, 1)
    assert kind in ("none", "pair", *names)
    assert np.isfinite(phasors(case)).all()
    assert set(np.unique(case.sweep.segment)) == {1, 2, 3}


def test_an_unknown_kind_is_refused():
    with pytest.raises(ValueError, match="expected one of none"):
        draw("gremlins", 1)


@pytest.mark.usefixtures("quick_plate")
def test_pairs_come_from_two_places():
    pairs = [draw("pair", seed).truth.names for seed in range(1, 30)]
    assert len(set(pairs)) > 15
    for first, second in pairs:
        assert PLACES[first] != PLACES[second]
        assert not {first, second} & set(OF_THE_CHANNELS_ALONE)


@pytest.mark.usefixtures("quick_plate")
def test_about_half_have_a_hammer_and_most_one_level():
    cases = [draw("none", seed) for seed in range(60)]
    assert 18 <= sum(c.hammer is not None for c in cases) <= 42
    assert 1 <= sum(len(np.unique(c.sweep.commanded_m_s2)) == 3 for c in cases) <= 14


@pytest.mark.usefixtures("quick_plate")
def test_most_softening_cases_have_three_levels():
    schedules = [len(np.unique(draw("amplitude_softening", s).sweep.commanded_m_s2)) for s in range(12)]
    assert 4 <= schedules.count(3) <= 11
    assert set(schedules) == {1, 3}


@given(seed=st.integers(0, 10**6), levels=st.sampled_from([(1.0,), (0.25, 0.5, 1.0)]))
@settings(max_examples=50, deadline=None)
def test_a_schedule_holds_three_dense_resonances_one_after_the_other(seed, levels):
    s = draw_schedule(np.random.default_rng(seed), levels)
    assert len(np.unique(s.time_s)) == len(s.time_s)
    for number in np.unique(s.sweep):
        inside = s.sweep == number
        assert 60 <= inside.sum() <= 120
        assert len(np.unique(s.segment[inside])) == len(np.unique(s.level_g[inside])) == 1
        between = (s.time_s > s.time_s[inside].min()) & (s.time_s < s.time_s[inside].max())
        assert (s.sweep[between] == number).all()
    assert len(np.unique(s.sweep)) == 3 * len(levels)
    for segment, low, high in ((1, 14, 26), (2, 85, 115), (3, 250, 310)):
        f = s.frequency_hz[s.segment == segment]
        assert low <= f.min() < f.max() <= high


@pytest.mark.usefixtures("quick_plate")
def test_the_ratio_scatters_as_the_figures_say():
    truth, schedule = Truth({}, ZENER, FIGURES), dense()
    still = 9.81 * clean(truth, schedule, 9.81)
    draws = [measured(truth, schedule, 9.81, np.random.default_rng(seed)) for seed in range(80)]
    scatter = np.array([s.response_m_s - still for s in draws])
    white = np.hypot(0.006 * peaks(np.abs(still), schedule.sweep), 2e-5)
    expected = white**2 + 2 * (0.002 * np.abs(still)) ** 2
    found = np.mean(np.abs(scatter) ** 2, axis=0)
    assert np.mean(found / expected) == pytest.approx(1, abs=0.03)
    assert np.mean(scatter.real**2) == pytest.approx(np.mean(scatter.imag**2), rel=0.05)


@pytest.mark.usefixtures("quick_plate")
def test_the_drive_scatters_in_both_channels():
    truth, schedule = Truth({}, ZENER, replace(FIGURES, fraction_of_peak=1e-6, repeat_scatter=0.0)), dense()
    sweep = measured(truth, schedule, 9.81, np.random.default_rng(5))
    base = sweep.base_m_s2 / 9.81
    assert np.std(np.abs(base)) == pytest.approx(0.003, rel=0.2)
    assert np.std(np.angle(base)) == pytest.approx(DRIVE_PHASE_RAD, rel=0.2)
    size = np.abs(sweep.velocity_m_s)
    smooth = np.abs(sweep.response_m_s)
    big = smooth > 0.3 * peaks(smooth, schedule.sweep)
    assert np.corrcoef((size / smooth)[big], np.abs(base)[big])[0, 1] > 0.99


def test_the_noise_that_identification_sees_is_the_one_put_in():
    case = draw("none", 2)
    still = 9.81 * clean(case.truth, _schedule(case), 9.81)
    ratio = noise_of(case.sweep).std_m_s / case.truth.noise.std_m_s(still, case.sweep.sweep)
    assert np.median(ratio) == pytest.approx(1, abs=0.15)


@pytest.mark.usefixtures("quick_plate")
def test_a_level_error_shows_in_the_reference_and_not_in_the_ratio():
    schedule = dense()
    truth = Truth({"level_error": {"factor": 1.04}}, ZENER, FIGURES)
    off, true = (
        measured(t, schedule, 9.81, np.random.default_rng(1)) for t in (truth, Truth({}, ZENER, FIGURES))
    )
    assert np.abs(off.base_m_s2).mean() / 9.81 == pytest.approx(1.04, abs=1e-3)
    assert np.abs(off.velocity_m_s).sum() / np.abs(true.velocity_m_s).sum() == pytest.approx(1.04, abs=2e-3)


def test_hum_is_loud_at_multiples_of_the_mains_and_nowhere_else():
    f = np.array([49.0, 50.0, 75.2, 100.0, 100.3, 103.0, 300.0])
    size = np.abs(TrueChannels(hum_m_s=1.0).hum(f, np.random.default_rng(0)))
    assert (size[[1, 3, 6]] >= 0.5).all()
    assert (size[[0, 2, 5]] < 1e-9 + 0.03).all()
    assert 0.3 < size[4] < 1.5


def test_strange_laws_are_off_every_fractional_zener_and_plain_ones_are_not():
    omega = 2 * np.pi * np.concatenate([np.linspace(14, 25, 60), np.linspace(85, 310, 60)])
    rng = np.random.default_rng(4)
    strange = [draw_strange_material(rng, omega / (2 * np.pi)) for _ in range(6)]
    assert {law.kind for law in strange} == {"maxwell", "ghm"}
    assert all(deviation(law, omega) > 0.015 for law in strange)
    assert deviation(ZENER, omega) < 1e-6
    np.testing.assert_allclose(nearest_zener(ZENER, omega).values, ZENER.values, rtol=1e-4)


def test_softening_is_stated_at_the_first_mode_at_one_g():
    case = draw("amplitude_softening", 0)
    s = case.truth.effects["amplitude_softening"]
    f = np.unique(case.sweep.frequency_hz[case.sweep.segment == 1])
    hard = steady(Effects(), case.truth.law.modulus, f, np.full(len(f), 9.81), np.zeros(len(f)))
    assert hard.core_strain.max() == pytest.approx(s["reference_strain"], rel=1e-6)


def test_a_clean_sweep_shows_nothing_and_a_spot_offset_much():
    assert visible_chi2(coarse(draw("none", 1))) < 1e-6
    assert visible_chi2(coarse(draw("spot_offset", 1))) > 1000


def test_what_a_law_takes_up_does_not_count_as_visible():
    case = coarse(draw("core_thickness", 1))
    truth = replace(case.truth, effects={})
    plain = 9.81 * clean(truth, _schedule(case), 9.81)
    moved = 9.81 * clean(case.truth, _schedule(case), 9.81)
    raw = 2 * np.sum(np.abs((moved - plain) / case.truth.noise.std_m_s(plain, case.sweep.sweep)) ** 2) / 2
    assert 0 < visible_chi2(case) < 0.3 * raw


def test_the_specimen_is_the_published_one_whatever_is_hidden():
    assert draw("core_thickness", 1).specimen == nominal_specimen()


def coarse(case):
    """Every sixth point."""
    return replace(case, sweep=case.sweep.take(np.arange(0, len(case.sweep), 6)))


def _schedule(case) -> Schedule:
    s = case.sweep
    return Schedule(s.frequency_hz, s.segment, s.sweep, s.commanded_m_s2 / 9.81, s.time_s)
